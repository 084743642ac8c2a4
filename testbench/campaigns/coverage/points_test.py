#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Every file of cover points fits its block: the signals it names are there. Builds nothing."""

import unittest
from pathlib import Path

from testing import ROOT, ran
import rtl_sources

FOLDER = Path(__file__).resolve().parent
DESIGNS = ("lever", "paper")
QUIET = ("-Wno-SYNCASYNCNET", "-Wno-UNUSEDSIGNAL", "-Wno-MULTITOP", "-Wno-DECLFILENAME")


def complaints(points, design):
    block = points.stem.removesuffix("_cover")
    names = [name for name in rtl_sources.core_files(ROOT)
             if block == "feltgate_core" or Path(name).stem != "feltgate_core"]
    package = ROOT / f"rtl/generated/{design}/feltgate_pkg.sv"
    command = ["verilator", "--lint-only", "--coverage", "-Wall", *QUIET, "--top-module", block,
               FOLDER / "coverage.vlt", package, *(ROOT / "rtl" / name for name in names), points]
    done = ran(*command)
    return done.stderr if done.returncode else ""


class Points(unittest.TestCase):
    def test_each_file_fits_its_block(self):
        files = sorted(FOLDER.glob("*_cover.sv"))
        self.assertTrue(files)
        for points in files:
            for design in DESIGNS:
                with self.subTest(points.name, design=design):
                    block = points.stem.removesuffix("_cover")
                    self.assertTrue(list(ROOT.glob(f"rtl/**/{block}.sv")))
                    self.assertEqual(complaints(points, design), "")


if __name__ == "__main__":
    unittest.main()
