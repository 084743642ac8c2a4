#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/gimbal.svg: the torques of three motors while a handle is turned once around,
from the rows of the scene.

  feltgate run gimbal --engine twin --csv gimbal.csv --every 50
  scripts/gimbal_picture.py gimbal.csv
"""

import math
import tomllib

from docs_picture import BLUE, GREY, RED, ROOT, columns, files, plt, save

NAMES = ("time_s", *(f"{what}.{n}" for what in ("theta_rad", "tau_ref_nm") for n in range(3)))
JOINTS = (("outer joint", BLUE), ("middle joint", GREY), ("inner joint", RED))


def main():
    (run,) = (columns(path, NAMES) for path in files(1, __doc__))
    text = (ROOT / "vectors/scenes/gimbal.toml").read_text(encoding="utf-8")
    most_nm = 2 * tomllib.loads(text)["parameters"]["stiffness"]
    turned = [math.degrees(a) for a in run["theta_rad.0"]]
    figure, (angle, torque) = plt.subplots(1, 2, figsize=(10, 3.6), layout="constrained")
    for n, (name, colour) in enumerate(JOINTS):
        times = [1e3 * t for t in run["time_s"]]
        degrees = [math.degrees(a) for a in run[f"theta_rad.{n}"]]
        angle.plot(times, degrees, color=colour, lw=1.3, label=name)
        torque.plot(turned, run[f"tau_ref_nm.{n}"], color=colour, lw=1.3)
    longer = [-most_nm * math.sin(math.radians(a) / 2) for a in turned]
    torque.plot(turned, longer, color="black", lw=0.8, ls=":")
    angle.set(xlabel="time, ms", ylabel="joint, degrees", xlim=(0, times[-1]))
    angle.legend(fontsize=8, frameon=False)
    torque.set(xlabel="outer joint, degrees", ylabel="torque asked for, Nm", xlim=(0, 360),
               xticks=range(0, 361, 60))
    save(figure, "gimbal")


if __name__ == "__main__":
    main()
