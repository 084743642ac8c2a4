#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws the picture of docs/speed-for-accuracy.md, speed against error, from the JSON of feltgate bench.

  feltgate bench --json docs/images/bench.json
  scripts/bench_picture.py docs/images/bench.json docs/images/bench.svg
"""

import sys

from outputs import write_whole
from reports import plots

TITLE = "For the RTL's bits twin_event or twin_tick; without quantisation double"


def draw(data, options):
    """A dot for each back-end; those without an error stand on the floor, 300 times below the least error."""
    engines = [(name, e["simulated_s_per_s"], e.get("torque_error_nm", {}).get("max"), e["arithmetic"])
               for name, e in data["engines"].items()]
    floor = min((error for _, _, error, _ in engines if error), default=3e-16) / 300
    figure, (axes,) = plots.stacked(TITLE, [3.6], width=8)
    taken = {}
    for name, speed, error, arithmetic in sorted(engines, key=lambda e: e[1]["median"]):
        colour = plots.COLOURS["motor" if arithmetic == "integer" else "quad"]
        at = error or floor
        axes.plot([speed["min"], speed["max"]], [at, at], color=colour, lw=2.5, alpha=0.35)
        axes.plot(speed["median"], at, "o", color=colour)
        row, before = taken.get(at, (0, 0))  # labels of neighbours stand above one another
        row = row + 1 if speed["median"] < 4 * before else 1
        taken[at] = row, speed["median"]
        axes.annotate(name, (speed["median"], at), xytext=(4, 1 + 10 * row), textcoords="offset points", fontsize=8,
                      arrowprops={"arrowstyle": "-", "lw": 0.5})
    axes.axvline(1, color=plots.COLOURS["reference"], lw=0.8, ls=":", label="real time")
    for kind, text in (("motor", "the RTL's integers, equal in every bit"), ("quad", "real arithmetic, the same laws")):
        axes.plot([], [], "o", color=plots.COLOURS[kind], label=text)
    axes.set(xscale="log", yscale="log", xlabel="simulated seconds per second of one core",
             ylabel="largest torque error against 113 bits, Nm")
    axes.margins(x=0.12, y=0.35)
    axes.legend(loc="center left")
    axes.set_title(f"{data['machine']}, {data['compiler']}, {data['date']}, simulation", fontsize=7)
    write_whole(options.to, plots.finish(figure, "bench").svg)


if __name__ == "__main__":
    sys.exit(plots.main(__doc__, "bench", ["feltgate-bench/1"], draw))
