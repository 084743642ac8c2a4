#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/local_plane.svg: a disc rendered by its tangents at 50 Hz and 1 kHz, from the
rows of the two scenes.

  feltgate run plane_circle_slow --engine twin --csv slow.csv --every 1
  feltgate run plane_circle --engine twin --csv fast.csv --every 1
  scripts/local_plane_picture.py slow.csv fast.csv
"""

from docs_picture import BLUE, GREY, RED, columns, draw, np, plt, vectors


def world(axes, slow, x, y, radius):
    angles = 2 * np.pi * np.arange(201) / 200
    axes.plot(1e3 * (x + radius * np.cos(angles)), 1e3 * (y + radius * np.sin(angles)), color=GREY,
              lw=1)
    axes.plot(1e3 * slow["pen_x_m"], 1e3 * slow["pen_y_m"], color=BLUE, lw=1.4,
              label="pen, 2 mm deep")
    label = "planes sent, 50 a second"
    sides = np.array([-1, 1])
    for i in np.flatnonzero(slow["plane_step_n"] > 0):
        nx, ny = slow["plane_normal_x"][i], slow["plane_normal_y"][i]
        axes.plot(1e3 * (x + radius * nx - sides * 0.006 * ny),
                  1e3 * (y + radius * ny + sides * 0.006 * nx), color=RED, lw=1, label=label)
        label = None
    axes.set_aspect("equal")
    axes.set(xlabel="x, mm", ylabel="y, mm", xlim=(-36, 36), ylim=(104, 146))
    axes.legend(fontsize=8, frameon=False, loc="lower center")


def over_time(axes, run, title, thinned):
    times, step = 1e3 * run["time_s"], run["plane_step_n"]
    axes.plot(times[::thinned], np.degrees(run["plane_tilt_rad"][::thinned]), color=BLUE, lw=0.9)
    axes.set_ylabel("off the tangent, degrees", color=BLUE)
    axes.set_title(title, fontsize=9)
    steps = axes.twinx()
    steps.vlines(times[step > 0], 0, 1e3 * step[step > 0], color=RED, lw=1)
    steps.set_ylabel("force's step, mN", color=RED)
    steps.set_ylim(bottom=0)
    axes.set_xlabel("time, ms")


def picture(slow, fast):
    slow, fast = columns(slow), columns(fast)
    figure, panels = plt.subplot_mosaic("ab\nac", figsize=(10, 4.4), layout="constrained")
    world(panels["a"], slow, *vectors("scenes/plane_circle_slow")["plane"]["circle_m"])
    over_time(panels["b"], slow, "50 Hz", 200)
    over_time(panels["c"], fast, "1 kHz", 50)
    return figure


if __name__ == "__main__":
    draw(__doc__, local_plane=picture)
