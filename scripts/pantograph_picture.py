#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/pantograph.svg: where the pen of the default pantograph can be and what its
motors can push there, and a drop of its cranks against a stop, from the table that the test prints.

  build/testbench/axes/pantograph/linkage_test "[.drop]" > drop.csv
  scripts/pantograph_picture.py drop.csv
"""

import csv

from docs_picture import BLUE, GREY, RED, draw, np, plt, vectors


def drop_of(path):
    """Times, angles between the cranks by restitution; lines of the test program are skipped."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = [line for line in file if line.startswith("time_s") or line[0].isdigit()]
    by = {}
    for row in csv.DictReader(lines):
        times, angles = by.setdefault(float(row["restitution"]), ([], []))
        times.append(1e3 * float(row["time_s"]))
        angles.append(float(row["between_deg"]))
    return by


def at(angle, length=1.0):
    """A vector in this direction."""
    return length * np.array((np.cos(angle), np.sin(angle)))


def workspace(axes, plant, torque):
    """Rings of equal angle between the cranks, three poses, and what the motors can push there."""
    length = plant["linkage"]["crank_1_m"]
    least, most = np.radians((plant["stops"]["least_deg"], plant["stops"]["most_deg"]))
    for angle in (least, np.radians(60), np.radians(120), most):
        radius = 2e3 * length * np.cos(angle / 2)
        style = "-" if angle in (least, most) else ":"
        axes.add_patch(plt.Circle((0, 0), radius, fill=False, color=GREY, ls=style))
        axes.text(*at(-0.6, radius), f"{np.degrees(angle):.0f}°",
                  color=GREY, fontsize=8, ha="center", va="center",
                  bbox={"fc": "w", "ec": "none", "pad": 0.5})
    for first, last, alpha in ((30, 150, 1.0), (-20, 60, 0.45), (110, 235, 0.45)):
        a, b = np.radians((first, last))
        ends = at(a, 1e3 * length), at(b, 1e3 * length)
        pen = sum(ends)
        for end, color in zip(ends, (BLUE, RED)):
            axes.plot([0, end[0]], [0, end[1]], color=color, lw=3, alpha=alpha)
            axes.plot([end[0], pen[0]], [end[1], pen[1]], color="k", lw=1.5, alpha=alpha)
        axes.plot(*pen, "o", color="k", ms=4, alpha=alpha)
        # Forces that both motors can make there: a parallelogram around the pen, 40 mm per N.
        across = length * np.sin(b - a)
        corners = [pen + 40 * (torque * (one * at(b) - five * at(a)) / across)
                   for one, five in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        axes.add_patch(plt.Polygon(corners, fc=BLUE, ec=BLUE, alpha=0.15 * alpha))
    axes.set(xlim=(-215, 215), ylim=(-130, 215), aspect="equal", xlabel="x, mm", ylabel="y, mm",
             title="pen between the stops; forces of 1 A, 40 mm per N")


def drop(axes, plant, table):
    for (restitution, (times, angles)), color in zip(table.items(), (GREY, BLUE, RED)):
        axes.plot(times, angles, color=color, lw=1.2, label=f"restitution {restitution:g}")
    for key in ("least_deg", "most_deg"):
        axes.axhline(plant["stops"][key], color="k", lw=0.8, ls="--")
    axes.set(xlabel="time, ms", ylabel="angle between the cranks, degrees",
             title="pulled outward by 1 N, without friction")
    axes.legend(fontsize=8, frameon=False, loc=(0.55, 0.72))
    axes.grid(alpha=0.3)


def picture(table):
    plant = vectors("devices/pantograph")
    ratio = plant["joint"]["drum_radius_m"] / plant["joint"]["pulley_radius_m"]
    # 1 A in each motor.
    torque = ratio * plant["motor"]["torque_constant_nm_a"]
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 4.2), layout="constrained")
    workspace(axes[0], plant, torque)
    drop(axes[1], plant, drop_of(table))
    return figure


if __name__ == "__main__":
    draw(__doc__, pantograph=picture)
