#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""In an optimised program the twin's steps are inlined in its unrolled loop: as a function each of
them would look for its step again, and TwinDevice::tick_to would take twice the time.

inlined_test.py COMPILER
"""

import sys
import unittest

from testing import ROOT, Scratch, ran

COMPILER = sys.argv.pop(1)


class Inlined(Scratch):
    def test_no_step_is_a_function(self):
        built = ran(COMPILER, "-std=c++17", "-O2", "-I", ROOT / "model/include", "-c",
                    ROOT / "docs/examples/tick_loop.cpp", "-o", self.folder / "tick_loop.o")  # fmt: skip
        self.assertEqual((built.returncode, built.stderr), (0, ""))
        symbols = ran("nm", "-C", self.folder / "tick_loop.o").stdout.splitlines()
        self.assertTrue([s for s in symbols if "FeltgateCore" in s and "::pass" in s])
        self.assertEqual([s for s in symbols if "{lambda(feltgate::Map::Step)" in s], [])


if __name__ == "__main__":
    unittest.main()
