# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate texture: what it writes is proven; bad input is one line, code 2, nothing written."""

import unittest

from PIL import Image

from law_making import ROOT, LawMaking

IMAGES = ROOT / "vectors/textures"


class Texture(LawMaking):
    COMMAND = "texture"

    def image(self, name, size, mode="L", pixel=None):
        """A PNG in the folder, whose pixels are `pixel(i)`."""
        made = Image.new(mode, size)
        made.putdata([(pixel or (lambda i: 40 * i % 256))(i) for i in range(size[0] * size[1])])
        made.save(self.folder / name)
        return name

    def test_the_shipped_law(self):
        """rtl/laws/texture.law is what the command of its page writes."""
        done = self.run_it(
            "texture", IMAGES / "ripples.png", "--depth", "4mm", "-o", "texture.law"
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("proven: no instruction saturates", done.stdout)
        written = (self.folder / "texture.law").read_text()
        self.assertEqual(written, (ROOT / "rtl/laws/texture.law").read_text())

    def test_a_field(self):
        words = ("--field", "--texel", "2mm", "--depth", "8mm", "-o", "valley.law")
        for normals in ("interpolated", "facets"):
            done = self.ended(self.run_it("texture", IMAGES / "valley.png", *words, "--normals", normals))
            self.assertIn("50000 Hz", done.stdout)
            self.assertIn("torque[2]", done.stdout)
        self.refused("--row", IMAGES / "valley.png", "--field", "--row", "1")

    def test_table(self):
        """As firm with every texel by the split, and not by planes."""
        done = self.run_it("texture", IMAGES / "ripples.png", "--depth", "1mm", "--table")
        rows = [line.split() for line in done.stdout.splitlines()]
        rows = [[float(word) for word in row] for row in rows if len(row) == 4 and "." in row[0]]
        self.assertEqual([row[0] for row in rows], [10, 3, 1, 0.3, 0.1], done.stdout)
        for row in rows:
            self.assertLess(abs(row[2] - 1), 0.05)
        self.assertGreater(rows[0][3], 0.9)
        self.assertLess(rows[-1][3], 0.2)
        self.refused("say --depth 1mm", IMAGES / "ripples.png", "--depth", "1.5mm", "--table")

    def test_colours_and_rows(self):
        """Luminance is height; another row is another law."""
        steps = (0, 60, 120, 180, 255, 0, 0, 90)
        grey = self.image("grey.png", (4, 2), pixel=lambda i: steps[i])
        colour = self.image("colour.png", (4, 2), "RGB", lambda i: (steps[i],) * 3)
        laws = []
        for name, row in ((grey, 0), (colour, 0), (grey, 1)):
            self.ended(self.run_it("texture", name, "--row", row, "--depth", "1mm", "-o", "a.law"))
            laws.append((self.folder / "a.law").read_text().splitlines()[1:])
        self.assertEqual(laws[0], laws[1])
        self.assertNotEqual(laws[0], laws[2])
        self.assertIn("through [0, 0.235294118, 0.470588235, 0.705882353]", "\n".join(laws[0]))

    def test_refused(self):
        self.refused("1 x 1 pixels", self.image("one.png", (1, 1)))
        self.refused("16 bits", self.image("deep.png", (4, 4), "I;16"))
        whole = (IMAGES / "ripples.png").read_bytes()
        (self.folder / "half.png").write_bytes(whole[: len(whole) // 2])
        self.refused("half.png:1: ", "half.png")
        (self.folder / "head.png").write_bytes(whole[:20])
        self.refused("head.png:1: ", "head.png")
        (self.folder / "text.png").write_text("not an image\n", encoding="utf-8")
        self.refused("no PNG", "text.png")
        self.refused("none.png", "none.png")
        self.refused("a law holds 240", self.image("long.png", (241, 2)))
        steep = self.image("steep.png", (8, 2), pixel=lambda i: 255 if i % 4 < 2 else 0)
        self.refused("say --depth 4mm", steep, "--depth", "5mm")
        self.refused("alike", self.image("flat.png", (8, 8), pixel=lambda i: 7))
        self.refused("16 along", self.image("wide.png", (17, 16)), "--field")
        self.refused("no row 8", IMAGES / "ripples.png", "--row", "8")
        self.refused("--stiffness", IMAGES / "ripples.png", "--stiffness", "nan")
        far = (IMAGES / "ripples.png", "--depth", "1mm", "--surface")
        self.refused("the pen reaches 40 to 190 mm", *far, "200mm", "--path", "way.csv")
        self.refused("the pen reaches 40 to 190 mm", *far, "42mm", "--table")
        self.assertFalse((self.folder / "way.csv").exists())


if __name__ == "__main__":
    unittest.main()
