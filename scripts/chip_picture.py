#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/axis.svg, the block diagram of an axis: each box has the name of its file in rtl/, and below it the
clock after the sample in which its result is new. Documentation: docs/architecture.md"""

from matplotlib.patches import Rectangle

from outputs import write_whole
from reports import plots, runs

BLUE, GREEN, ORANGE, GREY, INK = "#dcecf8", "#d9f0e6", "#fbe7cf", "#6b7580", plots.COLOURS["ideal"]

# name: left, bottom, width, height, colour, text under the name
BOXES = {
    "quadrature": (0.9, 3.4, 2.2, 1.2, ORANGE, "encoder socket"),
    "velocity_estimator": (4.0, 3.4, 2.5, 1.2, BLUE, "5"),
    "observer": (7.4, 4.6, 1.9, 1.0, BLUE, "13"),
    "scene": (7.4, 2.4, 1.9, 1.0, BLUE, "9; a charge 26"),
    "ramp": (9.9, 2.4, 1.1, 1.0, BLUE, "12"),
    "torque_law": (11.6, 3.4, 1.7, 1.2, BLUE, "current 17\nvoltage 21, duty 25"),
    "h_bridge": (14.4, 3.4, 1.7, 1.2, ORANGE, "bridge socket"),
    "safety": (4.0, 6.35, 9.3, 0.75, GREEN,
               "one file for each cause of fault, fault_latch, arming, stop_latch, self_test, hold_timer"),
    "host": (4.0, 0.85, 9.3, 0.75, GREEN, "registers, params, snapshot"),
}
# from, to, text, its place, angles at both ends of a line with a corner
ARROWS = (
    ((0.2, 4.0), (0.9, 4.0), "A, B, Z", (0.12, 4.15), None),
    ((3.1, 4.0), (4.0, 4.0), "travel", (3.12, 4.12), None),
    ((2.0, 3.05), (7.4, 2.7), "position", (4.0, 2.8), (-90, 180)),
    ((6.5, 4.2), (7.4, 4.9), "", None, None),
    ((6.5, 3.8), (7.4, 3.1), "velocity", (6.62, 3.93), None),
    ((9.3, 2.9), (9.9, 2.9), "torque", (9.3, 3.05), None),
    ((11.0, 2.9), (11.6, 3.6), "tau_ref", (11.1, 2.72), None),
    ((9.3, 5.1), (11.6, 4.3), "tau_hat", (10.35, 4.92), None),
    ((11.6, 3.9), (9.3, 4.75), "current of the tick before", (9.0, 3.82), None),
    ((13.3, 4.0), (14.4, 4.0), "duty", (13.77, 4.12), None),
    ((16.1, 4.0), (16.7, 4.0), "gates", (16.15, 4.15), None),
    ((2.0, 4.6), (4.0, 6.7), "edges, errors", (2.0, 6.82), (90, 180)),
    ((13.3, 6.7), (15.25, 4.6), "gates_enable, gates_clear", (13.8, 6.82), (0, 90)),
    ((8.65, 1.6), (8.65, 2.0), "words p, control", (8.8, 1.72), None),
    ((1.2, 1.2), (4.0, 1.2), "register port, panel", (1.2, 1.35), None),
)


def picture():
    made = plots.figure((10, 4.7))
    axes = made.add_subplot()
    axes.set(xlim=(0, 17), ylim=(0.2, 7.6))
    axes.axis("off")
    axes.add_patch(Rectangle((3.6, 0.5), 10.1, 6.95, fill=False, edgecolor=GREY, linewidth=0.9, linestyle=(0, (5, 3))))
    axes.text(13.6, 7.52, "axis", fontsize=9, color=GREY, ha="right")
    for name, (x, y, width, height, colour, text) in BOXES.items():
        axes.add_patch(Rectangle((x, y), width, height, facecolor=colour, edgecolor=INK, linewidth=0.9))
        bar = height < 1
        axes.text(x + (0.15 if bar else width / 2), y + height / 2, name, fontsize=9, fontweight="bold",
                  ha="left" if bar else "center", va="center", color=INK)
        axes.text(*((x + 1.5, y + height / 2) if bar else (x + width / 2, y - 0.12)), text, fontsize=7.5, color=GREY,
                  ha="left" if bar else "center", va="center" if bar else "top", linespacing=1.1)
    for begin, end, text, place, corner in ARROWS:
        axes.annotate("", end, begin, arrowprops={
            "arrowstyle": "-|>", "color": INK, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0,
            "connectionstyle": "angle,angleA={},angleB={}".format(*corner) if corner else None})
        if text:
            axes.text(*place, text, fontsize=7.5, color=INK)
    return made


if __name__ == "__main__":
    write_whole(runs.ROOT / "docs/images/axis.svg", plots.finish(picture(), "axis").svg)
