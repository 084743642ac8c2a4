#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""All RTL is in the subset of docs/boards/quartus.md, and rules find what they are there for.

quartus_test.py VENV: the folder into which scripts/build.sh has fetched pyslang.
"""

import os
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, ran

VENV = Path(sys.argv.pop(1))

# What stands in a module, in which of its lines, and what is said.
BAD = (
    ("if (1) begin : g\nend", 1, "outside generate"),
    ("generate\nif (1) begin\nend\nendgenerate", 2, "without a name"),
    ("import p::*;", 1, "import"),
    ("enum logic [1:0] {A = 1, B} state;", 1, "without a width"),
    ("initial $display(1);", 1, "$display"),
    ("function automatic int f(int a);\nreturn f(a);\nendfunction", 2, "called in a function"),
    ("wire [11:0] a;\nwire [15:0] b = {8'd0, 8'(a) | 8'd1};", 2, "cast beside an operator"),
    ("m u_m (.a_i(1'b0), .b_i('0));", 1, "'0 at a port"),
)

def check(*files):
    return ran(VENV / "bin/python", "-B", ROOT / "scripts/quartus_subset.py", *files)


@unittest.skipUnless(
    (VENV / "bin/python").exists() or os.environ.get("CI"), "no pyslang; ./feltgate test fetches it"
)
class Quartus(Scratch):
    def said(self, texts):
        """(status, [lines of each]) of one start with a file for each text."""
        paths = [self.put(f"{number}.sv", text) for number, text in enumerate(texts)]
        done = check(*paths)
        self.assertEqual(done.stderr, "")
        rows = done.stdout.splitlines()
        return done.returncode, [[r for r in rows if r.startswith(f"{p}:")] for p in paths]

    def test_all_rtl(self):
        files = sorted((ROOT / "rtl").rglob("*.sv"))
        self.assertGreater(len(files), 30)
        done = check(*files)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))

    def test_bad(self):
        cases = [(f"module m;\n{text}\nendmodule", line + 1, said) for text, line, said in BAD]
        status, answers = self.said([text for text, _, _ in cases])
        self.assertEqual(status, 1)
        for (text, line, said), rows in zip(cases, answers):
            with self.subTest(said, text=text):
                hits = [row for row in rows if said in row]
                self.assertTrue(hits, rows)
                self.assertIn(f".sv:{line}: ", hits[0])

    def test_no_file(self):
        self.assertEqual(check("none.sv").returncode, 2)


if __name__ == "__main__":
    unittest.main()
