#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/pantograph_wall.svg: the pen on a floor of 50 N/m at 1 kHz, without filters and
behind them, from the rows of two runs.

  ./feltgate run pantograph_wall --engine twin --every 1000 --csv as_it_is.csv
  ./feltgate run pantograph_wall_filtered --engine twin --every 1000 --csv filtered.csv
  scripts/pantograph_wall_picture.py as_it_is.csv filtered.csv
"""

import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
BLUE, RED, GREY = "#1f6fb4", "#c0392b", "#888888"


def pen_of(path):
    """Times in s, heights in mm."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [float(r["time_s"]) for r in rows], [1e3 * float(r["pen_y_m"]) for r in rows]


def main(as_it_is, filtered):
    plt.rcParams.update({"svg.hashsalt": "feltgate", "font.size": 8})
    figure, axes = plt.subplots(figsize=(7.0, 2.6), constrained_layout=True)
    axes.axhline(110, color=GREY, lw=0.8, ls="--")
    axes.text(1.4, 110.2, "floor", color=GREY, ha="right")
    axes.plot(*pen_of(as_it_is), color=BLUE, lw=1.0, label="speed and force as they are")
    axes.plot(*pen_of(filtered), color=RED, lw=1.0, label="behind the filters")
    axes.annotate("0.5 N before, 0.6 N after", (0.41, 107.6), color=GREY)
    axes.axvline(0.4, color=GREY, lw=0.6, ls=":")
    axes.set(xlabel="time [s]", ylabel="pen [mm]", xlim=(0, 1.4))
    axes.legend(loc="lower left", frameon=False)
    figure.savefig(ROOT / "docs/images/pantograph_wall.svg", metadata={"Date": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
