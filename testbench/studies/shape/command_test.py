# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate shape and texture: what they write is proven; bad input is one line, code 2, nothing written."""

import unittest

from PIL import Image

from law_making import ROOT, LawMaking

FISH, VALLEY = ROOT / "vectors/shapes/fish.svg", ROOT / "vectors/textures/valley.png"


class Shape(LawMaking):
    COMMAND = "shape"

    def test_written_and_proven(self):
        words = ("--vertices", 40, "--radius", "2mm", "-o", "fish.law")
        done = self.ended(self.run_it("shape", FISH, *words))
        self.assertIn("proven: no instruction saturates", done.stdout)
        self.ended(self.run_it("law", "./fish.law", "--json", "fish.json"))
        self.assertIn('"unproven": 0', (self.folder / "fish.json").read_text())

    def test_refused(self):
        path = '<path d="{}"/></svg>'.format
        begun = '<svg xmlns="http://www.w3.org/2000/svg">\n'
        many = " ".join(f"L{i} {i % 5}" for i in range(10_000))
        for said, text in {
            "drawn.svg:1: no SVG; write <svg xmlns=": "<svg><text>x</text></svg>",
            "drawn.svg:1: no path": begun + "<text>x</text></svg>",
            "crosses or touches itself; unite": begun + path("M0 0 L9 9 L9 0 L0 9 Z"),
            "crosses or touches": begun + path("M0 0 H9 V9 H5 L4 0 L3 9 H0 Z"),
            "open; close it": begun + path("M0 0 L60 0 L60 60"),
            "2 outlines; unite": begun + path("M0 0 H60 V60 Z M1 1 H2 V2 Z"),
            "no area": begun + path("M0 0 L1 0 L2 0 Z"),
            "more than 2000 corners": begun + path("M0 0 " + many + " Z"),
            "drawn.svg:2: no whole XML": begun + path("M0 0 L9 0")[:-9],
            '"M0 0 L60 ? Z"': begun + path("M0 0 L60 \x01 Z"),
            "save the drawing as plain SVG": begun + path("M0 0 L60 nothing Z"),
            "no element": "",
            "ungroup": begun + "<g>" * 30_000,
        }.items():
            (self.folder / "drawn.svg").write_text(text, encoding="utf-8")
            self.refused(said, "drawn.svg")
        self.refused("no.svg", "no.svg")
        for said, *words in (
            ("too short for a radius of 20.00 mm", "--radius", "20mm"),
            ("--radius", "--radius", "-1mm"),
            ("--centre", "--centre", "nan", "0.12"),
            ("out of the pen's reach", "--size", "300mm"),
            ("out of the pen's reach", "--centre", "0", "0.18"),
        ):
            self.refused(said, FISH, *words)


class Texture(LawMaking):
    COMMAND = "texture"

    def image(self, name, size, mode="L", pixel=lambda i: 40 * i % 256):
        """A PNG in the folder, whose pixels are `pixel(i)`."""
        made = Image.new(mode, size)
        made.putdata([pixel(i) for i in range(size[0] * size[1])])
        made.save(self.folder / name)
        return name

    def test_proven(self):
        """Luminance is height."""
        steps = (0, 60, 120, 180, 255, 0, 0, 90)
        grey = self.image("grey.png", (4, 2), pixel=lambda i: steps[i])
        colour = self.image("colour.png", (4, 2), "RGB", lambda i: (steps[i],) * 3)
        heights = "[0, 0.235294118, 0.470588235, 0.705882353, 1, 0, 0, 0.352941176]"
        for name in (grey, colour):
            words = ("--depth", "1mm", "--normals", "facets", "-o", "a.law")
            done = self.ended(self.run_it("texture", name, *words))
            self.assertIn("proven: no instruction saturates", done.stdout)
            text = (self.folder / "a.law").read_text()
            self.assertIn("table height(q) on [0, 7] through " + heights, text)

    def test_refused(self):
        whole = VALLEY.read_bytes()
        for name, size in (("half", len(whole) // 2), ("head", 20), ("none", 0)):
            (self.folder / f"{name}.png").write_bytes(whole[:size])
        steep = self.image("steep.png", (8, 2), pixel=lambda i: 255 if i % 4 < 2 else 0)
        for said, *words in (
            ("1 x 1 pixels", self.image("one.png", (1, 1))),
            ("16 bits", self.image("deep.png", (4, 4), "I;16")),
            ("half.png:1: the image is broken", "half.png"),
            ("head.png:1: no PNG", "head.png"),
            ("none.png:1: no PNG", "none.png"),
            ("2 to 16 along each side", self.image("wide.png", (17, 16))),
            ("say --depth 4mm", steep, "--depth", "5mm"),
            ("say --depth 2mm", steep, "--depth", "3mm", "--normals", "facets"),
            ("alike", self.image("flat.png", (8, 8), pixel=lambda i: 7)),
            ("--texel", VALLEY, "--texel", "1"),
            ("--damping", VALLEY, "--damping", "nan"),
        ):
            self.refused(said, *words)


if __name__ == "__main__":
    unittest.main()
