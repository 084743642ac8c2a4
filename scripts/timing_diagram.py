#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws a WaveDrom timing diagram as SVG, without WaveDrom.

  timing_diagram.py docs/images/tick.json             writes docs/images/tick.svg
  timing_diagram.py --check docs/images/tick.json     status 1 when that file is stale

It supports the part of WaveDrom that our diagrams use: lanes with name, wave (0 1 . x = 2 to 9) and
data; empty lanes; head.text, head.tock, foot.text; config.hscale. config.wrap, which WaveDrom ignores,
breaks a long diagram into rows of that many periods.
"""

import argparse
import json
import sys
from pathlib import Path
from xml.sax.saxutils import escape

CELL, LANE, HIGH, NAMES, MARGIN = 36, 26, 18, 110, 8
FILL = dict(zip("=23456789", "#fff #fff #ffffb4 #ffe0b9 #b9e0ff #ccfdfe #cdfdc5 #f0c1fb #f5c2c0".split()))


def segments(lane):
    """(start, end, level, label) of a lane; a dot goes on with what is before it."""
    found, data = [], iter(lane.get("data", []))
    for at, level in enumerate(lane.get("wave", "")):
        if level == "." and found:
            found[-1][1] = at + 1
        elif level in FILL or level in "01x":
            found.append([at, at + 1, level, next(data, "") if level in FILL else ""])
        else:
            raise ValueError(f"lane {lane.get('name')!r}: unknown level {level!r} in its wave")
    return found


def text(x, y, words, size=10, anchor="middle", more=""):
    return (
        f'<text x="{x:g}" y="{y:g}" font-size="{size}" text-anchor="{anchor}" {more}>'
        f"{escape(str(words))}</text>"
    )


def draw_lane(lane, y, first, last, names, cell):
    """One lane of one row, periods first to last."""
    out = [text(names - 8, y + HIGH / 2 + 4, lane.get("name", ""), 11, "end")]
    before = None
    for start, end, level, label in segments(lane):
        start, end = max(start, first), min(end, last)
        if start >= end:
            continue
        left, width = names + (start - first) * cell, (end - start) * cell
        if level in "01":
            edge = y if level == "1" else y + HIGH
            if before not in (None, edge):
                out.append(f'<path d="M{left} {y}v{HIGH}" stroke="#000"/>')
            out.append(f'<path d="M{left} {edge}h{width}" stroke="#000"/>')
            before = edge
            continue
        fill = "url(#x)" if level == "x" else FILL[level]
        out.append(
            f'<rect x="{left}" y="{y}" width="{width}" height="{HIGH}" fill="{fill}" '
            f'stroke="{"#bbb" if level == "x" else "#000"}"/>'
        )
        if label:
            out.append(text(left + width / 2, y + HIGH / 2 + 4, label))
    return out


def svg(diagram):
    lanes = diagram["signal"]
    total = max(len(lane.get("wave", "")) for lane in lanes)
    for lane in lanes:
        if lane and len(lane["wave"]) != total:
            raise ValueError(f"lane {lane['name']!r}: {len(lane['wave'])} periods, not {total}")
    wrap = diagram.get("config", {}).get("wrap", total)
    head, foot = diagram.get("head", {}), diagram.get("foot", {})
    cell = CELL * diagram.get("config", {}).get("hscale", 1)
    names = max(NAMES, MARGIN + 6 * max(len(lane.get("name", "")) for lane in lanes))
    out, y = [], MARGIN
    if "text" in head:
        out.append(text(names, y + 12, head["text"], 13, "start", 'font-weight="bold"'))
        y += 24
    for first in range(0, total, wrap):
        last, top = min(first + wrap, total), y
        if "tock" in head:
            for at in range(first, last):
                x = names + (at - first + 0.5) * cell
                out.append(text(x, y + 11, head["tock"] + at, 9, more='fill="#555"'))
            y += 18
        bottom = y + LANE * len(lanes) - (LANE - HIGH)
        grid = "".join(
            f"M{names + at * cell} {top + 14}V{bottom}" for at in range(last - first + 1)
        )
        out.append(f'<path d="{grid}" stroke="#ddd" stroke-dasharray="2 2"/>')
        for lane in lanes:
            if lane:
                out += draw_lane(lane, y, first, last, names, cell)
            y += LANE
        y += 14
    if "text" in foot:
        out.append(text(names, y + 4, foot["text"], 10, "start", 'fill="#555"'))
        y += 14
    words = 5 * max(len(foot.get("text", "")), len(head.get("text", "")))
    width, height = names + max(min(wrap, total) * cell, words) + MARGIN, y
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" font-family="Helvetica, Arial, sans-serif">\n'
        '<pattern id="x" width="5" height="5" patternUnits="userSpaceOnUse" '
        'patternTransform="rotate(45)"><path d="M0 0V5" stroke="#ccc"/></pattern>\n'
        f'<rect width="{width}" height="{height}" fill="#fff"/>\n' + "\n".join(out) + "\n</svg>\n"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only compare")
    parser.add_argument("json", type=Path, help="WaveDrom source")
    arguments = parser.parse_args()
    target = arguments.json.with_suffix(".svg")
    try:
        drawn = svg(json.loads(arguments.json.read_text(encoding="utf-8")))
    except (OSError, ValueError, KeyError) as error:
        print(f"{arguments.json}: {error}", file=sys.stderr)
        return 2
    if not arguments.check:
        target.write_text(drawn, encoding="utf-8")
    elif not target.exists() or target.read_text(encoding="utf-8") != drawn:
        print(f"{target}: stale; run scripts/timing_diagram.py {arguments.json}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
