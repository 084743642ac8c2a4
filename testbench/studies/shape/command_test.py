# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate shape: laws that feltgate law proves; bad input is one line, code 2, nothing written."""

import unittest

from law_making import ROOT, LawMaking

SHAPES = ROOT / "vectors/shapes"


class Shape(LawMaking):
    COMMAND = "shape"

    def drawing(self, name, text):
        """An SVG file in the folder."""
        (self.folder / name).write_text(text, encoding="utf-8")
        return name

    def test_written_and_proven(self):
        words = ("--vertices", 40, "--radius", "2mm", "-o", "fish.law")
        done = self.ended(self.run_it("shape", SHAPES / "fish.svg", *words))
        self.assertIn("proven: no instruction saturates", done.stdout)
        self.ended(self.run_it("law", "./fish.law", "--json", "fish.json"))
        self.assertIn('"unproven": 0', (self.folder / "fish.json").read_text())

    def test_seven_shapes_are_the_shipped_law(self):
        """rtl/laws/hidden_shapes.law is what the command of its page writes."""
        names = ("square", "bell", "banana", "fish", "horseshoe", "mushroom", "duck")
        files = [SHAPES / f"{name}.svg" for name in names]
        options = ("--radius", "2mm", "--vertices", 27, "-o", "hidden_shapes.law")
        done = self.ended(self.run_it("shape", *files, *options))
        written = (self.folder / "hidden_shapes.law").read_text()
        self.assertEqual(written, (ROOT / "rtl/laws/hidden_shapes.law").read_text())
        self.assertIn("shape 4: ", done.stdout)
        self.refused("say --vertices 27", *files, "--radius", "2mm", "--vertices", 28)
        self.refused("bell.svg:1: ", *files, "--vertices", 27)
        for option in (("--texture",), ("--path", "way.csv")):
            self.refused("one", *files, "--vertices", 27, *option)
        self.refused("holds 7", *files, files[0])

    def test_refused(self):
        path = '<svg xmlns="http://www.w3.org/2000/svg"><path d="{}"/></svg>'
        self.refused("no SVG; write <svg xmlns=", self.drawing("a.svg", "<svg><text>x</text></svg>"))
        text = "<svg xmlns='http://www.w3.org/2000/svg'><text>x</text></svg>"
        self.refused("no path", self.drawing("a.svg", text))
        self.refused("crosses", self.drawing("b.svg", path.format("M0 0 L9 9 L9 0 L0 9 Z")))
        many = " ".join(f"L{i} {i % 5}" for i in range(10_000))
        self.refused("simplify", self.drawing("c.svg", path.format("M0 0 " + many + " Z")))
        self.refused("whole XML", self.drawing("d.svg", path.format("M0 0 L9 0")[:-9]))
        self.refused("too short", SHAPES / "fish.svg", "--radius", "20mm")
        self.refused("--radius", SHAPES / "fish.svg", "--radius", "-1mm")
        self.refused("--centre", SHAPES / "fish.svg", "--centre", "nan", "0.12")
        self.refused("say --vertices 80", SHAPES / "fish.svg", "--texture", "--vertices", 81)
        self.refused("out of the pen", SHAPES / "fish.svg", "--size", "300mm")


if __name__ == "__main__":
    unittest.main()
