#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/texture.svg: a row of an image, the forces on it, and how firm it is by texel.

  feltgate texture vectors/textures/ripples.png --depth 4mm --path way.csv
  feltgate texture vectors/textures/ripples.png --depth 1mm --table > table.txt
  scripts/texture_picture.py way.csv table.txt
"""

from docs_picture import BLUE, GREY, RED, columns, draw, np, plt

NAMES = ("pen_x_m", "pen_y_m", "height_m", "force_x_n", "force_y_n")


def forces(axes, path):
    x, y, height, *force = columns(path, NAMES).values()
    axes.plot(1e3 * x, 1e3 * height, color=GREY, lw=1.4, label="surface")
    axes.axhline(80, color=GREY, lw=0.6, ls=":")
    axes.plot(1e3 * x, 1e3 * y, color=BLUE, lw=0.8, label="pen, 1 mm below black")
    axes.quiver(*(values[::4] for values in (1e3 * x, 1e3 * y, *force)), color=RED, angles="xy",
                scale_units="xy", scale=0.5, width=0.003, label="force, 1 N is 2 mm")
    axes.set(xlabel="x, mm", ylabel="y, mm", xlim=(-18, 18), ylim=(78, 87))
    axes.legend(fontsize=8, frameon=False, loc="upper center", ncols=3)


def firmness(axes, path):
    with open(path, encoding="utf-8") as table:
        rows = [line.split() for line in table]
    rows = [row for row in rows if len(row) == 4 and row[0][0].isdigit()]
    texel, _, split, normal = np.array(rows).astype(float).T
    axes.semilogx(texel, split, "o-", color=BLUE, label="depth split")
    axes.semilogx(texel, normal, "o-", color=RED, label="along the normal")
    axes.set(xlabel="texel, mm", ylabel="upright stiffness felt, share", ylim=(0, 1.15))
    axes.legend(fontsize=8, frameon=False, loc="center right")


def picture(way, table):
    figure, panels = plt.subplot_mosaic("aab", figsize=(10, 3.6), layout="constrained")
    forces(panels["a"], way)
    firmness(panels["b"], table)
    return figure


if __name__ == "__main__":
    draw(__doc__, texture=picture)
