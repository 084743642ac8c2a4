#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws the picture of docs/speed-for-accuracy.md, speed against error, from the JSON of feltgate bench.

  feltgate bench --json docs/images/bench.json
  scripts/bench_picture.py docs/images/bench.json docs/images/bench.svg
"""

import math
import sys

from matplotlib.figure import Figure
from outputs import write_whole
from reports import plots

# What a user takes each back-end for, and where its label stands.
PURPOSE = {
    "rtl": "the check: every pin of the RTL",
    "twin_clock": "pins, without Verilator",
    "twin_event": "closed loops, recordings",
    "twin_tick": "exact signals, parameter studies",
    "double": "the law without quantisation",
    "float": "what a microcontroller would do",
    "quad": "the reference",
}
SENTENCE = (
    "For the RTL's bits use twin_event (closed loop) or twin_tick (signals);\n"
    "rtl checks that they are. For the law without quantisation use double. "
    "The others check these."
)


def engines(data):
    """(name, times real time, max torque error or None), fastest first."""
    rows = []
    for name, engine in data["engines"].items():
        error = engine.get("torque_error_nm", {}).get("max")
        rows.append((name, engine["simulated_s_per_s"]["median"], error))
    return sorted(rows, key=lambda row: -row[1])


def colour(name, data):
    if data["engines"][name]["arithmetic"] == "integer":
        return plots.COLOURS["motor"]
    return plots.COLOURS["quad"]


def label_offsets(rows, floor):
    """Engines of the same error stand in one row: each label takes the lowest line above it that is
    free for most of a decade to its left."""
    offsets, taken = {}, {}
    for name, speed, error in sorted(rows, key=lambda row: row[1]):
        row = round(3 * math.log10(error or floor))
        step = 0
        while speed / taken.get((row, step), 1e-30) < 8:
            step += 1
        taken[row, step] = speed
        offsets[name] = step
    return offsets


def picture(data):
    rows = engines(data)
    errors = [error for _, _, error in rows if error]
    floor = min(errors) / 300 if errors else 1e-18
    figure = Figure(figsize=(8.6, 4.6), layout="constrained")
    axes = figure.subplots()
    offsets = label_offsets(rows, floor)
    for name, speed, error in rows:
        y = error or floor
        spread = data["engines"][name]["simulated_s_per_s"]
        axes.plot([spread["min"], spread["max"]], [y, y], color=colour(name, data), lw=2.5, alpha=0.35)
        axes.plot([speed], [y], "o", color=colour(name, data), ms=7)
        axes.annotate(
            f"{name}\n{PURPOSE.get(name, '')}",
            (speed, y),
            xytext=(0, 9 + 24 * offsets[name]),
            textcoords="offset points",
            ha="center",
            fontsize=7.5,
            bbox={"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.85},
            arrowprops={"arrowstyle": "-", "lw": 0.5, "color": plots.COLOURS["reference"]},
        )
    axes.axvline(1, color=plots.COLOURS["reference"], lw=0.8, ls=":")
    axes.text(1, floor / 8, " real time", fontsize=7.5, color=plots.COLOURS["reference"])
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="simulated seconds per second of one core",
        ylabel="largest torque error against 113 bits, Nm",
    )
    axes.set_ylim(floor / 20, max(errors, default=1) * 1e7)
    low, high = min(r[1] for r in rows), max(r[1] for r in rows)
    axes.set_xlim(low / 4, high * 6)
    axes.set_title(SENTENCE, fontsize=8.5)
    for kind, text in (("motor", "the RTL's integers, all equal in every bit"), ("quad", "real arithmetic, the same laws")):
        axes.plot([], [], "o", color=plots.COLOURS[kind], label=text)
    axes.legend(loc="center left", fontsize=8)
    figure.text(
        0.995,
        0.005,
        f"{data['machine']}, {data['compiler']}, {data['date']}, simulation",
        ha="right",
        fontsize=6.5,
        color=plots.COLOURS["reference"],
    )
    return plots.finish(figure, "bench", SENTENCE).svg


def draw(data, options):
    write_whole(options.svg, picture(data))


if __name__ == "__main__":
    sys.exit(plots.main(__doc__, "bench", ["feltgate-bench/1"], draw))
