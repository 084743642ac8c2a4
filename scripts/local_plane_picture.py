#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/local_plane.svg: a disc rendered by its tangents at 50 Hz and 1 kHz, from the
rows of the two scenes.

  feltgate run plane_circle_slow --engine twin --csv slow.csv --every 1
  feltgate run plane_circle --engine twin --csv fast.csv --every 1
  scripts/local_plane_picture.py slow.csv fast.csv
"""

import math
import tomllib

from docs_picture import BLUE, GREY, RED, ROOT, columns, files, plt, save

NAMES = ("time_s", "pen_x_m", "pen_y_m", "plane_normal_x", "plane_normal_y", "plane_tilt_rad",
         "plane_step_n")


def world(axes, slow, x, y, radius):
    angles = [2 * math.pi * n / 200 for n in range(201)]
    axes.plot([1e3 * (x + radius * math.cos(a)) for a in angles],
              [1e3 * (y + radius * math.sin(a)) for a in angles], color=GREY, lw=1)
    axes.plot([1e3 * v for v in slow["pen_x_m"]], [1e3 * v for v in slow["pen_y_m"]], color=BLUE,
              lw=1.4, label="pen, 2 mm deep")
    label = "planes sent, 50 a second"
    for i, step in enumerate(slow["plane_step_n"]):
        if step <= 0:
            continue
        nx, ny = slow["plane_normal_x"][i], slow["plane_normal_y"][i]
        middle = (x + radius * nx, y + radius * ny)
        axes.plot([1e3 * (middle[0] - s * 0.006 * ny) for s in (-1, 1)],
                  [1e3 * (middle[1] + s * 0.006 * nx) for s in (-1, 1)], color=RED, lw=1,
                  label=label)
        label = None
    axes.set_aspect("equal")
    axes.set(xlabel="x, mm", ylabel="y, mm", xlim=(-36, 36), ylim=(104, 146))
    axes.legend(fontsize=8, frameon=False, loc="lower center")


def over_time(axes, run, title, thinned):
    times = [1e3 * t for t in run["time_s"]]
    axes.plot(times[::thinned], [math.degrees(a) for a in run["plane_tilt_rad"][::thinned]],
              color=BLUE, lw=0.9)
    axes.set_ylabel("off the tangent, degrees", color=BLUE)
    axes.set_title(title, fontsize=9)
    steps = axes.twinx()
    at = [i for i, step in enumerate(run["plane_step_n"]) if step > 0]
    steps.vlines([times[i] for i in at], 0, [1e3 * run["plane_step_n"][i] for i in at], color=RED,
                 lw=1)
    steps.set_ylabel("force's step, mN", color=RED)
    steps.set_ylim(bottom=0)
    axes.set_xlabel("time, ms")


def main():
    slow, fast = (columns(path, NAMES) for path in files(2, __doc__))
    file = ROOT / "vectors/scenes/plane_circle_slow.toml"
    scene = tomllib.loads(file.read_text(encoding="utf-8"))
    figure, panels = plt.subplot_mosaic("ab\nac", figsize=(10, 4.4), layout="constrained")
    world(panels["a"], slow, *scene["plane"]["circle_m"])
    over_time(panels["b"], slow, "50 Hz", 200)
    over_time(panels["c"], fast, "1 kHz", 50)
    save(figure, "local_plane")


if __name__ == "__main__":
    main()
