#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/gimbal.svg: the torques of three motors while a handle is turned once around,
from the rows of the scene.

  feltgate run gimbal --engine twin --csv gimbal.csv --every 50
  scripts/gimbal_picture.py gimbal.csv
"""

from docs_picture import BLUE, GREY, RED, columns, draw, np, plt, vectors

JOINTS = (("outer joint", BLUE), ("middle joint", GREY), ("inner joint", RED))


def picture(path):
    run = columns(path)
    most_nm = 2 * vectors("scenes/gimbal")["parameters"]["stiffness"]
    times, turned = 1e3 * run["time_s"], np.degrees(run["theta_rad.0"])
    figure, (angle, torque) = plt.subplots(1, 2, figsize=(10, 3.6), layout="constrained")
    for n, (name, colour) in enumerate(JOINTS):
        angle.plot(times, np.degrees(run[f"theta_rad.{n}"]), color=colour, lw=1.3, label=name)
        torque.plot(turned, run[f"tau_ref_nm.{n}"], color=colour, lw=1.3)
    torque.plot(turned, -most_nm * np.sin(np.radians(turned) / 2), color="black", lw=0.8, ls=":")
    angle.set(xlabel="time, ms", ylabel="joint, degrees", xlim=(0, times[-1]))
    angle.legend(fontsize=8, frameon=False)
    torque.set(xlabel="outer joint, degrees", ylabel="torque asked for, Nm", xlim=(0, 360),
               xticks=range(0, 361, 60))
    return figure


if __name__ == "__main__":
    draw(__doc__, gimbal=picture)
