#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A number that a block cannot work with is refused by every front end, with what must hold in the
message. docs/designs.md

elaboration_test.py VERILATOR VENV: VENV has pyslang or is not there.
"""

import os
import re
import shutil
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, ran, week

import rtl_sources

RTL = ROOT / "rtl"
VERILATOR, VENV = sys.argv.pop(1), Path(sys.argv.pop(1))
PACKAGES = ["generated/lever/cfg.sv", *rtl_sources.CORE_PACKAGES,
            *(f"generated/{name}.sv" for name in rtl_sources.PACKAGES.values())]

# Block, its parameter or a constant of cfg, what is given, and what must hold.
BAD = (
    ("pwm", "Period", 5001, "PWM_PERIOD_must_be_even_and_4_to_4094"),
    ("pwm", "DeadClocks", 0, "DEAD_CLOCKS_must_be_1_to_64"),
    ("pwm", "ShortestClocks", 256, "SHORTEST_CLOCKS_must_be_1_to_255"),
    ("quad_decoder", "IndexCounts", 4095, "INDEX_COUNTS_must_be_a_power_of_two"),
    ("current_sense", "CLOCK_HZ", 39_000_000, "an_over_current_must_be_latched_within_5_us_and"),
    ("absolute_encoder", "HalfClocks", 3, "a_parameter_is_out_of_its_range"),
    ("space_vector", "Period", 999, "PERIOD_must_be_even_and_4_to_4094"),
    ("pwm_three_phase", "DeadClocks", 0, "a_parameter_of_pwm_three_phase_is_out_of_its_range"),
    ("uart_rx", "Baud", 7_000_000, "a_bit_must_last_eight_clocks"),
    ("uart_rx", "Baud", 300, "the_baud_rate_is_too_low_for_the_phase"),
    ("uart_tx", "Baud", 7_000_000, "a_bit_must_last_eight_clocks"),
    ("uart_tx", "Baud", 300, "the_baud_rate_is_too_low_for_the_phase"),
    ("link_view", "AxisCount", 4, "AXES_must_be_1_to_3"),
    ("link_capture", "Rows", 3, "Rows_must_be_a_power_of_two_that_fits_the_window"),
    ("feltgate_axes", "AxisCount", 4, "AXES_must_be_1_to_3"),
)
WHOLE = "FELTGATE_WHOLE" in os.environ  # not a share of them


def front_ends(top, files):
    """{name: command} of those that are here."""
    files = [str(file) for file in files]
    include = f"-I{RTL / 'tops'}"
    found = {"verilator": [VERILATOR, "--lint-only", "-Wall", include, "--top-module", top, *files]}
    if shutil.which("yosys"):
        read = " ".join(f'"{file}"' for file in files)
        script = f"read_verilog -sv {include} {read}; hierarchy -check -top {top}"
        found["yosys"] = ["yosys", "-q", "-p", script]
    if (VENV / "bin/python").exists():
        python = [str(VENV / "bin/python"), "-B", str(ROOT / "scripts/slang_lint.py")]
        found["slang"] = [*python, include, "--top", top, *files]
    return found


class Elaboration(Scratch):
    def changed(self, block, constant, value):
        """The packages and all modules, with the constant changed in a package or in the block itself."""
        modules = rtl_sources.module_files(ROOT)
        files, changed = [], 0
        for path in (*PACKAGES, *modules.values()):
            source = RTL / path
            if path not in (PACKAGES[0], modules[block]):
                files.append(source)
                continue
            text, count = re.subn(
                rf"((?:localparam|parameter) [^=;]*\b{constant} *= )[^;,\n]+?( *(?:[;,]|//|\n))", rf"\g<1>{value}\2",
                source.read_text(encoding="utf-8"),
            )
            files.append(self.put(source.name, text))
            changed += count
        self.assertTrue(changed, f"no constant {constant}")
        return files

    def test_bad(self):
        for block, constant, value, wanted in BAD if WHOLE else BAD[week() % 5 :: 5]:
            files = self.changed(block, constant, value)
            for name, command in front_ends(block, files).items():
                with self.subTest(f"{block}: {constant} = {value} by {name}"):
                    done = ran(*command, cwd=self.folder)
                    self.assertNotEqual(done.returncode, 0)
                    self.assertIn(wanted, done.stdout + done.stderr)

    def test_every_check_is_tried(self):
        names = set()
        for path in RTL.rglob("*.sv"):
            if "boards" not in path.parts:  # their clocks: testbench/flow/lint/slang_test.py
                names |= set(re.findall(r"^\s*(\w+) missing \(\);", path.read_text(encoding="utf-8"), re.M))
        tried = {name for name in names for bad in BAD if name.startswith(bad[3])}
        self.assertEqual(sorted(names - tried), [])


if __name__ == "__main__":
    unittest.main()
