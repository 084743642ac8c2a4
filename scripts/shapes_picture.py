#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/shapes.svg: a pen that moves around inside a fish, the proxy and the force; and
how the force's direction turns along the path, for the three laws, from paths that `feltgate shape`
prints.

  for law in proxy walk simple; do
    ./feltgate shape vectors/shapes/fish.svg --radius 3mm --vertices 40 --law $law --path $law.csv
  done
  scripts/shapes_picture.py proxy.csv walk.csv simple.csv
"""

import csv
import math
from pathlib import Path

from docs_picture import BLUE, GREY, RED, files, plt, save

COLOURS = {"proxy": BLUE, "walk": RED, "simple": GREY}
STIFFNESS_N_PER_M = 50.0


def way_of(path):
    """Rows of pen and force, m and N."""
    with open(path, newline="", encoding="utf-8") as file:
        return [[float(v) for v in row.values()] for row in csv.DictReader(file)]


def shape(axes, rows):
    """The pen's way, the proxy's, and a force now and then."""
    mm = 1e3
    axes.plot([mm * r[0] for r in rows], [mm * r[1] for r in rows], color="k", lw=0.8,
              label="pen, 2 mm deep")
    proxy = [(r[0] + r[2] / STIFFNESS_N_PER_M, r[1] + r[3] / STIFFNESS_N_PER_M) for r in rows]
    axes.plot([mm * p[0] for p in proxy], [mm * p[1] for p in proxy], color=COLOURS["proxy"],
              lw=1.5, label="proxy")
    some = rows[::25]
    axes.quiver([mm * r[0] for r in some], [mm * r[1] for r in some], [r[2] for r in some],
                [r[3] for r in some], color=COLOURS["walk"], width=0.004, scale=1.6,
                label="force, 0.1 N")
    axes.set_aspect("equal")
    axes.set(xlabel="x, mm", ylabel="y, mm")
    axes.margins(y=0.1)
    axes.legend(loc="center", bbox_to_anchor=(0.62, 0.5), fontsize=8)


def turning(axes, name, rows):
    """The force's direction along the way."""
    way, at = [], 0.0
    direction, before = [], None
    for i, row in enumerate(rows):
        if i:
            at += 1e3 * math.dist(row[:2], rows[i - 1][:2])
        angle = math.degrees(math.atan2(row[3], row[2]))
        if before is not None:
            angle += 360 * round((before - angle) / 360)
        before = angle
        way.append(at)
        direction.append(angle)
    axes.plot(way, direction, color=COLOURS[name], lw=1.2, label=name,
              ls="--" if name == "simple" else "-")


def main():
    """The picture from the files that are named."""
    ways = files(3, __doc__)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for path in ways:
        rows = way_of(path)
        name = Path(path).stem
        if name == "proxy":
            shape(left, rows)
        turning(right, name, rows)
    right.set(xlim=(15, 60), ylim=(170, 330), xlabel="way of the pen, mm",
              ylabel="direction of the force, degrees")
    right.legend(fontsize=8)
    right.grid(alpha=0.3)
    save(figure, "shapes")


if __name__ == "__main__":
    main()
