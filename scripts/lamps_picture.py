#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/lamps.svg: what the eight lamps of a board mean, from the table of docs/boards/panel.md.

  lamps_picture.py           fails when the picture is stale
  lamps_picture.py --write   draws it again
"""

import argparse
import re
import sys
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/boards/panel.md"
PICTURE = ROOT / "docs/images/lamps.svg"
STEP, RADIUS, WORD = 104, 15, 15
GREEN, RED, YELLOW = "#2f9e44", "#e03131", "#f08c00"
COLOURS = ((GREEN, RED, YELLOW, *[GREEN] * 5), (GREEN, RED, YELLOW, *[GREEN] * 5))


def rows(text):
    """(number, normal, all switches on) as the table has them."""
    found = re.findall(r"^\| (\d) \| (.+?) \| (.+?) \|$", text, re.M)
    if [int(row[0]) for row in found] != list(range(8)):
        raise ValueError(f"{PAGE}: the table of the lamps has not the rows 0 to 7; correct it")
    return found


def wrapped(words, width=WORD):
    lines = [""]
    for word in words.split():
        if lines[-1] and len(lines[-1]) + len(word) >= width:
            lines.append("")
        lines[-1] += f" {word}" if lines[-1] else word
    return lines


def drawn(table):
    width = 8 * STEP + 24
    parts = []
    y = 0
    for k, title in enumerate(("switches 0 to 14", "all four switches on: the encoder")):
        y += 30
        parts.append(f'<text x="16" y="{y}" class="t">{title}</text>')
        y += 36
        deepest = 0
        for number, *words in table:
            # Lamp 7 is on the left, as it is in a number.
            x = 12 + STEP * (7 - int(number)) + STEP / 2
            colour = COLOURS[k][int(number)]
            parts.append(f'<circle cx="{x:g}" cy="{y}" r="{RADIUS}" fill="{colour}"/>')
            parts.append(f'<text x="{x:g}" y="{y + 5}" class="n">{number}</text>')
            said = words[0] if words[k] == "the same" else words[k].replace("; the same", "")
            for n, line in enumerate(wrapped(said)):
                parts.append(f'<text x="{x:g}" y="{y + 34 + 14 * n}" class="w">{escape(line)}</text>')
                deepest = max(deepest, n)
        y += 34 + 14 * (deepest + 1)
    style = (
        "text{font-family:sans-serif;fill:#222}.t{font-size:14px;font-weight:bold}"
        ".n{font-size:14px;fill:#fff;text-anchor:middle}.w{font-size:12px;text-anchor:middle}"
    )
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{y}" role="img" '
            'aria-label="Lamps 7 to 0 of a board, with the table of docs/boards/panel.md as words">',
            f"<style>{style}</style>",
            f'<rect width="{width}" height="{y}" fill="#fff"/>',
            *parts,
            "</svg>",
            "",
        ]
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="draw it again")
    options = parser.parse_args()
    wanted = drawn(rows(PAGE.read_text(encoding="utf-8")))
    if options.write:
        PICTURE.write_text(wanted, encoding="utf-8")
    elif not PICTURE.exists() or PICTURE.read_text(encoding="utf-8") != wanted:
        print(f"{PICTURE}: stale; run scripts/lamps_picture.py --write")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
