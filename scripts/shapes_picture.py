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

from pathlib import Path

from docs_picture import BLUE, GREY, RED, columns, draw, np, plt

COLOURS = {"proxy": BLUE, "walk": RED, "simple": GREY}
STIFFNESS_N_PER_M = 50.0


def shape(axes, x, y, force_x, force_y):
    """The pen's way, the proxy's, and a force now and then; m and N."""
    axes.plot(1e3 * x, 1e3 * y, color="k", lw=0.8, label="pen, 2 mm deep")
    axes.plot(1e3 * (x + force_x / STIFFNESS_N_PER_M), 1e3 * (y + force_y / STIFFNESS_N_PER_M),
              color=COLOURS["proxy"], lw=1.5, label="proxy")
    some = slice(None, None, 25)
    axes.quiver(1e3 * x[some], 1e3 * y[some], force_x[some], force_y[some], color=COLOURS["walk"],
                width=0.004, scale=1.6, label="force, 0.1 N")
    axes.set_aspect("equal")
    axes.set(xlabel="x, mm", ylabel="y, mm")
    axes.margins(y=0.1)
    axes.legend(loc="center", bbox_to_anchor=(0.62, 0.5), fontsize=8)


def turning(axes, name, x, y, force_x, force_y):
    """The force's direction along the way."""
    way = np.cumsum(1e3 * np.hypot(np.diff(x, prepend=x[0]), np.diff(y, prepend=y[0])))
    direction = np.unwrap(np.degrees(np.arctan2(force_y, force_x)), period=360)
    axes.plot(way, direction, color=COLOURS[name], lw=1.2, label=name,
              ls="--" if name == "simple" else "-")


def picture(proxy, walk, simple):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for path in (proxy, walk, simple):
        way, name = columns(path).values(), Path(path).stem
        if name == "proxy":
            shape(left, *way)
        turning(right, name, *way)
    right.set(xlim=(15, 60), ylim=(170, 330), xlabel="way of the pen, mm",
              ylabel="direction of the force, degrees")
    right.legend(fontsize=8)
    right.grid(alpha=0.3)
    return figure


if __name__ == "__main__":
    draw(__doc__, shapes=picture)
