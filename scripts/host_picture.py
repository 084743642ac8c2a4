#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws what feltgate host capture or record has written, each quantity over time in seconds, or one
over another.

  scripts/host_picture.py wall.csv wall.svg
  scripts/host_picture.py push.csv push.png --xy angle,tau_ref
"""

import argparse
import csv
import sys
from pathlib import Path

from outputs import write_whole
from reports import plots

UNITS = {"_rad_s": "rad/s", "_rad": "rad", "_nm": "Nm", "_a": "A", "_v": "V", "_s": "s"}
BITS = ("status", "faults", "encoder")  # words of bits: no curve


def unit_of(column):
    return next((unit for end, unit in UNITS.items() if column.endswith(end)), "")


def name_of(column):
    return next((column[: -len(end)] for end in UNITS if column.endswith(end)), column)


def read(path):
    """{column: values}, in the order of the file."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    if len(rows) < 2 or rows[0][:1] != ["time_s"]:
        raise ValueError("is no table with time_s first; give what --csv of feltgate host wrote")
    return dict(zip(rows[0], ([float(v) for v in column] for column in zip(*rows[1:]))))


def column_of(table, name):
    for column in table:
        if name in (column, name_of(column)):
            return column
    raise ValueError(f"has no column {name}; choose from {', '.join(map(name_of, table))}")


def over_time(table, title):
    columns = [c for c in table if c != "time_s" and name_of(c) not in BITS]
    if not columns:
        raise ValueError("has only words of bits; capture a value to draw")
    figure, axes = plots.stacked(title, [1.25] * len(columns), width=7.2)
    for ax, column in zip(axes, columns):
        ax.plot(table["time_s"], table[column], color=plots.COLOURS["motor"], lw=1.1)
        ax.axvline(0, color=plots.COLOURS["reference"], lw=0.8, ls=":")
        unit = unit_of(column)
        ax.set_ylabel(f"{name_of(column)}{f' [{unit}]' if unit else ''}")
    axes[-1].set_xlabel("time [s]")
    return figure


def one_over_another(table, names, title):
    if len(names) != 2:
        raise ValueError("--xy takes two names with a comma between them, such as angle,tau_ref")
    x, y = (column_of(table, name) for name in names)
    figure, (ax,) = plots.stacked(title, [4.2], width=5.6)
    ax.plot(table[x], table[y], color=plots.COLOURS["motor"], lw=1.1)
    ax.set(xlabel=f"{name_of(x)} [{unit_of(x)}]", ylabel=f"{name_of(y)} [{unit_of(y)}]")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("csv", type=Path, help="what --csv wrote")
    parser.add_argument("picture", type=Path, help=".svg or .png")
    parser.add_argument("--xy", metavar="X,Y", help="Y over X instead of all over time")
    parser.add_argument("--title", default="")
    parser.add_argument("--simulated", action="store_true", help="say so in the picture")
    options = parser.parse_args()
    try:
        kind = options.picture.suffix[1:]
        if kind not in ("svg", "png"):
            raise ValueError(f"{options.picture} is no .svg and no .png; choose one of them")
        table = read(options.csv)
        split = options.xy.split(",") if options.xy else None
        title = ("SIMULATED, no board: " if options.simulated else "") + options.title
        figure = one_over_another(table, split, title) if split else over_time(table, title)
        drawn = plots.finish(figure, "host", png=kind == "png")
        write_whole(options.picture, drawn.png or drawn.svg)
    except (OSError, ValueError) as error:
        print(f"host_picture: {options.csv}: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
