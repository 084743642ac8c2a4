#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""defects.py must refuse what is no defect: each test gives it a file of them in a small tree."""

import difflib
import tempfile
import unittest
from pathlib import Path

from seeded_defects import block, headers, patches

TOP = """module top #(
    parameter int Width = 8  // bits, (even)
) (
    input  logic             clk_i,
    input  logic [Width-1:0] a_i,  // one, two
    output logic [Width-1:0] y_o
);
  child #(.Width(Width)) u_child (.clk_i(clk_i), .a_i(a_i), .y_o(y_o));
endmodule
"""
CHILD = """module child #(parameter int Width = 1) (
    input logic clk_i,
    input logic [Width-1:0] a_i,
    output logic [Width-1:0] y_o
);
  always_ff @(posedge clk_i) y_o <= a_i;  // late
endmodule
"""
SOURCES = (Path("rtl/child.sv"), Path("rtl/top.sv"))


class Defects(unittest.TestCase):
    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.file = self.root / "defects.diff"
        self.defects = {}
        (self.root / "rtl").mkdir()
        for path, text in zip(SOURCES, (CHILD, TOP)):
            (self.root / path).write_text(text, encoding="utf-8")

    def patch(self, old, new, path="rtl/child.sv", first="It is inverted.\n", name="inverted"):
        text = (self.root / path).read_text(encoding="utf-8")
        self.assertIn(old, text)
        lines = [t.splitlines(True) for t in (text, text.replace(old, new))]
        body = "".join(difflib.unified_diff(*lines, f"a/{path}", f"b/{path}", n=1))
        return self.put(name, first + body)

    def put(self, name, text):
        """Writes the file with this defect beside those before; the defect."""
        self.defects[name] = f"== {name}\n{text}"
        self.file.write_text("\n".join(["# A head.\n", *self.defects.values()]), encoding="utf-8")
        return self.file / name

    def refused(self, patch, *words):
        with self.assertRaises(patches.DefectError) as caught:
            patches.patched(patch, self.root)
        for word in (patch.name, *words):
            self.assertIn(word, str(caught.exception))

    def test_a_copy_has_the_defect_and_the_source_has_not(self):
        patch = self.patch("<= a_i", "<= ~a_i")
        (written,) = patches.write_copies(patch, self.root / "out", self.root)
        self.assertEqual(written, self.root / "out/rtl/child.sv")
        self.assertEqual(written.read_text(), CHILD.replace("<= a_i", "<= ~a_i"))
        self.assertEqual((self.root / "rtl/child.sv").read_text(), CHILD)

    def test_no_longer_applies(self):
        patch = self.patch("<= a_i", "<= ~a_i")
        for line in ("  always_ff @(negedge clk_i) y_o <= a_i;  // late", ");\n\n"):
            with self.subTest(line):
                late = "  always_ff @(posedge clk_i) y_o <= a_i;  // late"
                old = late if "neg" in line else ");\n"
                (self.root / "rtl/child.sv").write_text(CHILD.replace(old, line))
                self.refused(patch, "does not apply", "rtl/child.sv")

    def test_changes_nothing(self):
        self.refused(self.patch("// late", "// a clock later"), "changes no code of rtl/child.sv")
        self.refused(self.patch("y_o <= a_i", "y_o  <=  a_i"), "changes no code")
        self.refused(self.put("empty", "It breaks nothing.\n"), "changes no file")

    def test_does_not_say_what_it_breaks(self):
        self.refused(self.patch("<= a_i", "<= ~a_i", first=""), "first line")
        self.refused(self.patch("<= a_i", "<= ~a_i", first="diff --git a/x b/x\n"), "first line")

    def test_block_holds_a_copy_for_each(self):
        one = self.patch("<= a_i", "<= ~a_i", name="inverted")
        two = self.patch(".a_i(a_i)", ".a_i('0)", path="rtl/top.sv", name="dead")
        text = block.block_of_defects("top", [one, two], SOURCES, self.root)
        modules = [line.split()[1] for line in text.splitlines() if line.startswith("module ")]
        self.assertEqual(
            modules, ["top", "top_none", "top_dead", "child_inverted", "top_inverted"]
        )
        self.assertEqual(text.count("  child_inverted #("), 1)
        self.assertEqual(text.count("  child #("), 2)  # of those without and with the other one
        self.assertIn("top_dead #(.Width(Width)) u_dead (.clk_i(clock_1), .a_i(a_i)", text)
        self.assertIn("assign clock_2 = clk_i && chosen[2];", text)
        self.assertIn("chosen[1] ? out_1_y_o : chosen[2] ? out_2_y_o : out_0_y_o", text)

    def header(self, changes, text):
        """The text of a header with the statements of these patches, without its first line."""
        (self.root / "model").mkdir()
        (self.root / "model/a.hpp").write_text(text)
        (self.root / "model/b.hpp").write_text("// as it is\n")
        made = [
            self.patch(*change, path="model/a.hpp", name=name) for name, change in changes.items()
        ]
        headers.write_headers(made, self.root / "out", self.root)
        self.assertTrue((self.root / "out/model/b.hpp").is_symlink())
        return (self.root / "out/model/a.hpp").read_text().partition("\n")[2]

    def test_header_holds_the_statements_of_all(self):
        text = self.header(
            {"late": ("return x;", "return x + 1;"), "odd": ("return x;", "return x | 1;")},
            "int f(int x) {\n  return x;\n}\n",
        )
        self.assertEqual(
            text.split(),
            "int f(int x) { if (feltgate_seeded::is(1)) { return x + 1; } else "
            "if (feltgate_seeded::is(2)) { return x | 1; } else { return x; } }".split(),
        )
        choice = (self.root / "out/seeded_choice.hpp").read_text()
        self.assertIn('feltgate_chosen_defect("none late odd")', choice)

    def test_classes(self):
        one, other = self.root / "one.h", self.root / "other.h"
        one.write_text('#include "a.h"\nclass V { int a, b; };\n')
        other.write_text('#include "b.h"\nclass V { int a, b; };\n')
        block.check_same_class(one, other)
        other.write_text("class V { int b, a; };\n")
        with self.assertRaisesRegex(patches.DefectError, "differ"):
            block.check_same_class(one, other)


if __name__ == "__main__":
    unittest.main()
