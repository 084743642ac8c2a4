#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""slang finds nothing in any device or board, and does find what it is there for. docs/testing.md

slang_test.py VENV: the folder into which scripts/build.sh has fetched pyslang.
"""

import os
import sys
import unittest
from pathlib import Path

from testing import BUILD, ROOT, Scratch, ran

import rtl_sources

RTL = ROOT / "rtl"
TOPS = RTL / "tops"
# The top of each device, and a design of it.
DEVICES = {"lever": "paper", "lever_absolute": "lever_absolute", "lever_current": "lever_current",
           "hall_motor": "hall_motor", "gimbal_motor": "gimbal_motor", "gimbal_current": "gimbal_current"}
VENV = Path(sys.argv.pop(1))


def sources(*tops):
    """The files of these modules and of all that they contain, packages first."""
    paths = rtl_sources.module_files(ROOT)
    wanted, found = list(tops), set()
    while wanted:
        name = wanted.pop()
        if name not in found:
            found.add(name)
            wanted += rtl_sources.instantiated((RTL / paths[name]).read_text(encoding="utf-8"), paths)
    packages = [*rtl_sources.CORE_PACKAGES, *(f"generated/{name}.sv" for name in rtl_sources.PACKAGES.values())]
    return [RTL / path for path in (*packages, *(paths[name] for name in paths if name in found))]


def package(design):
    return BUILD / "designs" / design / "cfg.sv"


def lint(top, *words):
    """What slang says, empty where it finds nothing."""
    words = ("-I", TOPS, *words)
    done = ran(VENV / "bin/python", "-B", ROOT / "scripts/slang_lint.py", "--top", top, *words)
    return done.stdout + done.stderr if done.returncode else ""


def device(name):
    return f"-DFELTGATE_{name.upper()}"


@unittest.skipUnless(
    (VENV / "bin/python").exists() or os.environ.get("CI"), "no pyslang; ./feltgate test fetches it"
)
class Slang(Scratch):
    def test_every_device(self):
        self.assertEqual({path.stem for path in TOPS.glob("*_top.sv")}, {f"{name}_top" for name in DEVICES})
        for name, design in DEVICES.items():
            with self.subTest(name):
                self.assertEqual(lint(f"{name}_top", package(design), *sources(f"{name}_top")), "")

    def test_every_device_with_its_link(self):
        pins = ROOT / "model/host/board/board_pins.sv"
        for name, design in (*DEVICES.items(), ("lever", "pantograph_law")):
            with self.subTest(name, design=design):
                files = [package(design), *sources(f"{name}_top", "feltgate_linked"), pins]
                self.assertEqual(lint("board_pins", device(name), *files), "")

    def board(self, board, design, name="lever"):
        files = [package(design), *sources(f"{name}_top", "feltgate_linked")]
        files += sorted([*RTL.glob("boards/panel/*.sv"), *RTL.glob(f"boards/{board}/*.sv")])
        return lint(board, device(name), *files, *sorted(ROOT.glob("testbench/boards/boards/stub/*PLL*.sv")))

    def test_every_board(self):
        for board in ("de0_nano", "ulx3s"):
            for name, design in DEVICES.items():
                with self.subTest(board, design=design):
                    self.assertEqual(self.board(board, design, name), "")

    def test_the_tang_nano_wants_its_own_clock(self):
        self.assertIn("the_clock_of_the_design", self.board("tang_nano_9k", "lever"))

    def test_bus_ports(self):
        for path in sorted(RTL.glob("bus/*.sv")):
            with self.subTest(path.stem):
                self.assertEqual(lint(path.stem, RTL / "generated/map.sv", path), "")


if __name__ == "__main__":
    unittest.main()
