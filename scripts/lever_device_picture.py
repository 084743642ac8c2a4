#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/NAME.svg of a scene with one lever: angle and torque over time, and the torque
against the angle, from the columns of its run.

  feltgate run end_stops --engine twin --csv end_stops.csv --every 100
  scripts/lever_device_picture.py end_stops end_stops.csv
"""

import tomllib

from docs_picture import BLUE, GREY, RED, ROOT, columns, files, plt, save

NAMES = ("time_s", "theta_rad", "tau_ref_nm", "motor_torque_nm")


def over_time(axes, run, title):
    times = [1e3 * t for t in run["time_s"]]
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
    axes.plot(run["theta_rad"], run["tau_ref_nm"], color=BLUE, lw=1.0)
    at = range(len(run["time_s"]) // 12, len(run["time_s"]) - 1, len(run["time_s"]) // 12)
    for i in at:
        to = min(i + len(run["time_s"]) // 60 + 1, len(run["time_s"]) - 1)
        ends = [(run["theta_rad"][k], run["tau_ref_nm"][k]) for k in (i, to)]
        if abs(ends[0][0] - ends[1][0]) < 1e-3:
            continue
        axes.annotate("", ends[1], ends[0], arrowprops={"arrowstyle": "->", "color": BLUE})
    axes.axhline(0, color=GREY, lw=0.6)
    axes.set(xlabel="angle, rad", ylabel="law's torque, Nm", title="torque against angle")
    axes.grid(alpha=0.3)


def main():
    name, path = files(2, __doc__)
    run = columns(path, NAMES)
    scene = tomllib.loads((ROOT / f"vectors/scenes/{name}.toml").read_text(encoding="utf-8"))
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.8), layout="constrained")
    over_time(axes[0], run, scene["title"])
    over_angle(axes[1], run)
    save(figure, name)


if __name__ == "__main__":
    main()
