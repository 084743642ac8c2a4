#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""All RTL is in the subset of docs/boards/quartus.md, and each rule finds what it is there for.

quartus_test.py VENV: the folder into which scripts/build.sh has fetched pyslang.
"""

import os
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, ran

VENV = Path(sys.argv.pop(1))

# What stands in a module, in which of its lines, and what is said.
IN_A_MODULE = (
    ("if (1) begin : g\nend", 1, "outside generate"),
    ("generate\nif (1) begin\nend\nendgenerate", 2, "without a name"),
    ("generate\nif (1) begin : g\nend else begin\nend\nendgenerate", 3, "without a name"),
    ("generate\nfor (genvar i = 0; i < 2; i = i + 1) begin : g\nend\nendgenerate", 2, "genvar"),
    ("generate\ncase (1)\n1: begin : g\nend\nendcase\nendgenerate\n"
     "case (1) 1: begin : h end endcase", 7, "outside generate"),
    ("import p::*;", 1, "import"),
    ("enum {A, B} state;", 1, "enumeration without a type"),
    ("enum logic [1:0] {A = 1, B} state;", 1, "without a width"),
    ("logic a;\nalways_comb unique0 case (a)\n default: ;\nendcase", 2, "unique0"),
    ("logic a;\nalways_comb case (a) inside\n 1'b0: ;\nendcase", 2, "case inside"),
    ("logic a;\nalways_comb case (1'b1)\n a: ;\nendcase", 2, "case of a constant"),
    ("logic a;\nalways_comb unique if (a) ;", 2, "before if"),
    ("initial $display(1);", 1, "$display"),
    ("int x = $urandom;", 1, "$urandom"),
    ("function automatic int f(int a);\nreturn a;\nendfunction\n"
     "function automatic int g(int a);\nreturn f(a);\nendfunction", 5, "called in a function"),
    ("function automatic int f(int a);\nreturn f(a);\nendfunction", 2, "called in a function"),
    ("wire a = 3 inside {1, 2};", 1, "inside"),
    ("wire a = 3 ==? 2;", 1, "==?"),
    ("wire [1:0] a = {<<{2'b01}};", 1, "streaming"),
    ("wire a;;", 1, "semicolon"),
    ("initial begin\nforce x.a = 1;\nend", 2, "force"),
    ("int a[2];\ninitial foreach (a[i]) a[i] = 0;", 2, "foreach"),
    ("initial do ; while (0);", 1, "do;"),
    ("initial wait (0);", 1, "wait"),
    ("real a;", 1, "real"),
    ("wire [11:0] a;\nwire [15:0] b = {8'd0, 8'(a) | 8'd1};", 2, "cast beside an operator"),
    ("m u_m (.a_i(1'b0), .b_i('0));", 1, "'0 at a port"),
    ("typedef union packed {logic a; logic b;} u;", 1, "union"),
)  # fmt: skip
ELSEWHERE = (
    ("module m (input logic a, b);\nendmodule", 1, "port without"),
    ("module m (input a);\nendmodule", 1, "port without"),
    ("module m #(parameter type T = logic) ();\nendmodule", 1, "parameter that is a type"),
    ("interface i;\nendinterface", 1, "interface"),
    ("class c;\nendclass", 1, "class"),
)
GOOD = """module m #(parameter int W = 2) (input logic [W-1:0] a_i, output logic b_o);
  enum logic [1:0] {Idle = 2'd0, Run = 2'd1} state;
  function automatic logic [1:0] twice(input logic [1:0] x);
    twice = x << 1;
  endfunction
  generate
  genvar i;
  for (i = 0; i < 2; i = i + 1) begin : g_bit
    if (W > 1) begin : g_wide
      wire x = twice(a_i) != 2'd0;
    end
  end
  endgenerate
  wire [3:0] c = {2'd0, 2'(a_i)} | 4'(a_i + 2'd1);
  always_comb begin
    unique case (a_i)
      2'd0: b_o = 1'b0;
      default: b_o = p::ONE;
    endcase
  end
`ifndef SYNTHESIS
  initial $display("simulation only");
`endif
endmodule
"""


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

    def test_good(self):
        self.assertEqual(self.said([GOOD]), (0, [[]]))

    def test_bad(self):
        cases = [(f"module m;\n{text}\nendmodule", line + 1, said)
                 for text, line, said in IN_A_MODULE]
        cases += ELSEWHERE
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
