#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/texture.svg: a row of an image, the forces on it, and how firm it is by texel.

  feltgate texture vectors/textures/ripples.png --depth 4mm --path way.csv
  feltgate texture vectors/textures/ripples.png --depth 1mm --table > table.txt
  scripts/texture_picture.py way.csv table.txt
"""

from docs_picture import BLUE, GREY, RED, columns, files, plt, save

NAMES = ("pen_x_m", "pen_y_m", "height_m", "force_x_n", "force_y_n")


def forces(axes, path):
    way = columns(path, NAMES)
    x = [1e3 * v for v in way["pen_x_m"]]
    axes.plot(x, [1e3 * v for v in way["height_m"]], color=GREY, lw=1.4, label="surface")
    axes.axhline(80, color=GREY, lw=0.6, ls=":")
    axes.plot(x, [1e3 * v for v in way["pen_y_m"]], color=BLUE, lw=0.8,
              label="pen, 1 mm below black")
    every = slice(None, None, 4)
    axes.quiver(x[every], [1e3 * v for v in way["pen_y_m"]][every], way["force_x_n"][every],
                way["force_y_n"][every], color=RED, angles="xy", scale_units="xy", scale=0.5,
                width=0.003, label="force, 1 N is 2 mm")
    axes.set(xlabel="x, mm", ylabel="y, mm", xlim=(-18, 18), ylim=(78, 87))
    axes.legend(fontsize=8, frameon=False, loc="upper center", ncols=3)


def firmness(axes, path):
    with open(path, encoding="utf-8") as table:
        rows = [line.split() for line in table]
    rows = [row for row in rows if len(row) == 4 and row[0][0].isdigit()]
    texel = [float(row[0]) for row in rows]
    axes.semilogx(texel, [float(row[2]) for row in rows], "o-", color=BLUE, label="depth split")
    axes.semilogx(texel, [float(row[3]) for row in rows], "o-", color=RED, label="along the normal")
    axes.set(xlabel="texel, mm", ylabel="upright stiffness felt, share", ylim=(0, 1.15))
    axes.legend(fontsize=8, frameon=False, loc="center right")


def main():
    way, table = files(2, __doc__)
    figure, panels = plt.subplot_mosaic("aab", figsize=(10, 3.6), layout="constrained")
    forces(panels["a"], way)
    firmness(panels["b"], table)
    save(figure, "texture")


if __name__ == "__main__":
    main()
