#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/NAME.svg of a scene with one lever: angle and torque over time, and the torque
against the angle, from the columns of its run.

  feltgate run end_stops --engine twin --csv end_stops.csv --every 100
  scripts/lever_device_picture.py end_stops end_stops.csv
"""

import sys

from docs_picture import BLUE, GREY, RED, columns, draw, plt, vectors


def over_time(axes, run, title):
    times = 1e3 * run["time_s"]
    axes.plot(times, run["theta_rad"], color=GREY, lw=1.2, label="angle, rad")
    axes.set(xlabel="time, ms", ylabel="angle, rad", title=title)
    torque = axes.twinx()
    torque.plot(times, run["motor_torque_nm"], color=RED, lw=0.8, label="motor's torque, Nm")
    torque.plot(times, run["tau_ref_nm"], color=BLUE, lw=1.2, label="law's torque, Nm")
    torque.set(ylabel="torque, Nm")
    lines = axes.get_lines() + torque.get_lines()
    axes.legend(lines, [line.get_label() for line in lines], fontsize=8, frameon=False,
                loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=3)
    axes.grid(alpha=0.3)


def over_angle(axes, run):
    angle, torque = run["theta_rad"], run["tau_ref_nm"]
    axes.plot(angle, torque, color=BLUE, lw=1.0)
    last = len(angle) - 1
    for i in range((last + 1) // 12, last, (last + 1) // 12):
        to = min(i + (last + 1) // 60 + 1, last)
        if abs(angle[i] - angle[to]) >= 1e-3:
            axes.annotate("", (angle[to], torque[to]), (angle[i], torque[i]),
                          arrowprops={"arrowstyle": "->", "color": BLUE})
    axes.axhline(0, color=GREY, lw=0.6)
    axes.set(xlabel="angle, rad", ylabel="law's torque, Nm", title="torque against angle")
    axes.grid(alpha=0.3)


def picture(name, path):
    run = columns(path)
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.8), layout="constrained")
    over_time(axes[0], run, vectors(f"scenes/{name}")["title"])
    over_angle(axes[1], run)
    return figure


if __name__ == "__main__":
    draw(__doc__, **{"".join(sys.argv[1:2]): picture})
