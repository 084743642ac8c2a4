#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The parts of `feltgate synth` that need no tool: the budget, and the ports that a measurement leaves open."""

import unittest

from testing import ROOT, Scratch

import synth_budget
import synth_measure

ROW = {"lut4_equivalents": 200, "ff": 100, "mult18": 2, "bram": 1, "fmax_mhz": 150.0}
TOOLS = {"yosys": "yosys 0.70", "nextpnr": "nextpnr 0.11"}


class Budget(Scratch):
    def grown(self, **changes):
        budget = {"measured": TOOLS, "figures": {"lever": {"observer": ROW}}}
        return synth_budget.compare(budget, {"lever": {"observer": ROW | changes}}, TOOLS)

    def test_same_figures_pass(self):
        self.assertEqual(self.grown(), [])

    def test_each_figure_past_its_margin_fails(self):
        for key, within, past in (
            ("lut4_equivalents", 210, 211),
            ("ff", 107, 108),
            ("mult18", 2, 3),
            ("bram", 1, 2),
            ("fmax_mhz", 135.0, 134.9),
        ):
            with self.subTest(key):
                self.assertEqual(self.grown(**{key: within}), [])
                self.assertIn(key, self.grown(**{key: past})[0])

    def test_written_and_read_again(self):
        path = self.folder / "areas.json"
        measured = {"lever": {"core without read-back": ROW}}
        merged = synth_budget.merge(synth_budget.read(path), measured, TOOLS)
        synth_budget.write(path, merged)
        self.assertEqual(synth_budget.read(path), merged)
        # A later run of another row keeps this one.
        again = synth_budget.merge(synth_budget.read(path), {"lever": {"observer": ROW}}, TOOLS)
        self.assertEqual(set(again["figures"]["lever"]), {"observer", *measured["lever"]})


class Wrapper(unittest.TestCase):
    def test_every_open_port_is_a_port_of_the_core(self):
        core = (ROOT / "rtl/tops/lever_top.sv").read_text(encoding="utf-8")
        for port in synth_measure.SNAPSHOT_PORTS:
            self.assertRegex(core, rf"\boutput logic [^;]*\b{port}\b")


if __name__ == "__main__":
    unittest.main()
