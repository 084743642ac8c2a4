# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws the images of vectors/textures, in 8-bit grey: docs/devices/shapes.md.

ripples.png: a sine with 16 pixels per period, seven periods long. valley.png: 16 x 16, two walls of
four pixels that meet in column 8, and flat areas beside them.
"""

import argparse
import math
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[1]


def ripples(column, _row):
    """Height of a sine, 0 to 1."""
    return 0.5 + 0.5 * math.sin(2 * math.pi * column / 16)


def valley(column, _row):
    """Height of a V whose bottom, at 0.4, is the column 8."""
    return 0.4 + 0.6 * min(abs(column - 8) / 4, 1)


def main():
    """Writes both."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--to", type=Path, default=ROOT / "vectors/textures", help="folder")
    folder = parser.parse_args().to
    for height, (width, rows) in ((ripples, (113, 8)), (valley, (16, 16))):
        image = Image.new("L", (width, rows))
        pixels = [round(255 * height(x, y)) for y in range(rows) for x in range(width)]
        image.putdata(pixels)
        image.save(folder / f"{height.__name__}.png", optimize=True)


if __name__ == "__main__":
    main()
