#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""slang finds nothing in any design or board, and does find what it is there for. docs/testing.md

slang_test.py VENV: the folder into which scripts/build.sh has fetched pyslang.
"""

import os
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, ran

RTL = ROOT / "rtl"
BOARDS = ("de0_nano", "ulx3s", "tang_nano_9k")
DESIGNS = sorted(path.parent.name for path in RTL.glob("generated/*/cfg.sv"))
VENV = Path(sys.argv.pop(1))


def core(name="feltgate_core"):
    listed = (RTL / f"{name}.f").read_text(encoding="utf-8").splitlines()
    return [RTL / line for line in listed if line and not line.startswith("//")]


def package(design):
    return RTL / "generated" / design / "cfg.sv"


def lint(top, *files):
    """What slang says, empty where it finds nothing."""
    done = ran(VENV / "bin/python", "-B", ROOT / "scripts/slang_lint.py", "--top", top, *files)
    return done.stdout + done.stderr if done.returncode else ""


@unittest.skipUnless(
    (VENV / "bin/python").exists() or os.environ.get("CI"), "no pyslang; ./feltgate test fetches it"
)
class Slang(Scratch):
    def test_every_design(self):
        self.assertIn("lever", DESIGNS)
        for design in DESIGNS:
            with self.subTest(design):
                self.assertEqual(lint("feltgate_core", package(design), *core()), "")

    def test_the_core_with_its_link(self):
        pins = ROOT / "model/host/board/board_pins.sv"
        for design in DESIGNS:
            with self.subTest(design):
                files = [package(design), *core("feltgate_linked"), pins]
                self.assertEqual(lint("board_pins", *files), "")

    def test_axes(self):
        for design in ("lever", "lever_law"):
            with self.subTest(design=design):
                files = [package(design), *core("feltgate_axes")]
                self.assertEqual(lint("feltgate_axes", *files), "")

    def test_a_multiplier_for_each_block(self):
        text = package("lever").read_text(encoding="utf-8")
        self.assertIn("PARALLEL_MULTIPLIERS = 0;", text)
        text = text.replace("PARALLEL_MULTIPLIERS = 0;", "PARALLEL_MULTIPLIERS = 1;")
        parallel = self.put("cfg.sv", text)
        self.assertEqual(lint("feltgate_core", parallel, *core()), "")

    def test_every_board(self):
        for board in BOARDS:
            packages = [RTL / f"generated/feltgate_{name}_pkg.sv" for name in ("engine", "link")]
            files = [*packages, *sorted(RTL.glob("link/*.sv"))]
            files += sorted([*RTL.glob("boards/panel/*.sv"), *RTL.glob(f"boards/{board}/*.sv")])
            files += sorted(ROOT.glob("testbench/boards/boards/stub/*PLL*.sv"))
            with self.subTest(board):
                text = package("lever").read_text(encoding="utf-8")
                hz = "54000000" if board == "tang_nano_9k" else "50000000"
                text = text.replace("CLOCK_HZ = 50000000;", f"CLOCK_HZ = {hz};")
                changed = self.put("cfg.sv", text)
                self.assertEqual(lint(board, changed, *core(), *files), "")

    def test_the_tang_nano_refuses_what_does_not_fit(self):
        packages = [RTL / f"generated/feltgate_{name}_pkg.sv" for name in ("engine", "link")]
        files = [*packages, *sorted(RTL.glob("link/*.sv")), ROOT / "testbench/boards/boards/stub/rPLL.sv"]
        files += sorted([*RTL.glob("boards/panel/*.sv"), *RTL.glob("boards/tang_nano_9k/*.sv")])
        for design in ("gimbal_motor", "lever_current"):
            self.assertIn("do_not_fit_this_board", lint("tang_nano_9k", package(design), *core(), *files))

    def test_bus_ports(self):
        shared = RTL / "generated/map.sv"
        for path in sorted(RTL.glob("bus/*.sv")):
            with self.subTest(path.stem):
                self.assertEqual(lint(path.stem, shared, path), "")

    def test_cells_of_the_ecp5(self):
        cell = ROOT / "testbench/flow/synth/mult18x18d_model.sv"
        files = [package("lever"), RTL / "core/wave/mult18_ecp5.sv", cell, *core()]
        # The cell's third operand stays open, as its manual says.
        options = ["-DFELTGATE_ECP5", "-Wno-unconnected-input-port"]
        self.assertEqual(lint("feltgate_core", *options, *files), "")


if __name__ == "__main__":
    unittest.main()
