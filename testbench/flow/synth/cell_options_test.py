#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The model of MULT18X18D elaborates with the options of rtl/core/wave/mult18_ecp5.sv and with no others.
docs/synthesis.md"""

import re
import unittest

from testing import ROOT, Scratch, ran, text_of

MODEL = ROOT / "testbench/flow/synth/mult18x18d_model.sv"
# What the cell does is the same with either.
ANY = {"GSR", "CLK1_DIV", "CLK2_DIV", "CLK3_DIV", "REG_INPUTC_CE", "REG_INPUTC_RST"}
# A register more or less, which the model has.
REGISTERS = {"REG_INPUTA_CLK", "REG_INPUTB_CLK", "REG_PIPELINE_CLK", "REG_OUTPUT_CLK"}


class CellOptions(Scratch):
    def setUp(self):
        super().setUp()
        self.source = text_of("rtl/core/wave/mult18_ecp5.sv")
        self.options = re.findall(r'\.(\w+)\("(\w+)"\)', self.source)

    def refused(self, wrapper):
        """What Yosys says of this wrapper around the model, or nothing."""
        source = self.put("mult18_ecp5.sv", wrapper)
        script = f"read_verilog -sv {MODEL} {source}; hierarchy -check -top mult18_ecp5"
        done = ran("yosys", "-q", "-p", script)
        return done.stderr + done.stdout if done.returncode else ""

    def test_the_project_uses_what_is_modelled(self):
        self.assertEqual(self.refused(self.source), "")

    def test_every_option_is_looked_at(self):
        self.assertGreater(len(self.options), 20)
        for name, value in self.options:
            if name in ANY:
                continue
            for other in {"NONE", "CLK0", "CLK1"} - {value} if name in REGISTERS else {"OTHER"}:
                with self.subTest(f"{name}: {value}, {other}"):
                    changed = self.source.replace(f'.{name}("{value}")', f'.{name}("{other}")')
                    self.assertNotEqual(changed, self.source)
                    if other in ("NONE", "CLK0"):
                        self.assertEqual(self.refused(changed), "")
                    else:
                        self.assertIn("this_use_of_the_cell_is_not_modelled", self.refused(changed))


if __name__ == "__main__":
    unittest.main()
