#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/pantograph_wall.svg: the pen on a floor of 50 N/m at 1 kHz, without and
with filters, from the rows of two runs.

  ./feltgate run pantograph_wall --engine twin --every 1000 --csv as_it_is.csv
  ./feltgate run pantograph_wall_filtered --engine twin --every 1000 --csv filtered.csv
  scripts/pantograph_wall_picture.py as_it_is.csv filtered.csv
"""

from docs_picture import BLUE, GREY, RED, columns, draw, plt


def pen_of(path):
    """Times in s, heights in mm."""
    time_s, height_m = columns(path, ("time_s", "pen_y_m")).values()
    return time_s, 1e3 * height_m


def picture(as_it_is, filtered):
    figure, axes = plt.subplots(figsize=(7.9, 2.9), layout="constrained")
    axes.axhline(110, color=GREY, lw=0.8, ls="--")
    axes.text(1.4, 110.2, "floor", color=GREY, ha="right")
    axes.plot(*pen_of(as_it_is), color=BLUE, lw=1.0, label="speed and force as they are")
    axes.plot(*pen_of(filtered), color=RED, lw=1.0, label="behind the filters")
    axes.annotate("0.5 N before, 0.6 N after", (0.41, 107.6), color=GREY)
    axes.axvline(0.4, color=GREY, lw=0.6, ls=":")
    axes.set(xlabel="time [s]", ylabel="pen [mm]", xlim=(0, 1.4))
    axes.legend(loc="lower left", frameon=False)
    return figure


if __name__ == "__main__":
    draw(__doc__, pantograph_wall=picture)
