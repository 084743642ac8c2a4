#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/coupled_levers.svg: what is felt of a spring that the second lever meets, and
two free levers after a push, below and above the border, from the rows of four runs.

  ./feltgate run coupled_levers --engine twin --every 200 --set share=0 --csv position.csv
  ./feltgate run coupled_levers --engine twin --every 200 --csv observer.csv
  ./feltgate run coupled_levers_free --engine twin --every 200 --set stiffness=11 --csv below.csv
  ./feltgate run coupled_levers_free --engine twin --every 200 --set stiffness=14 --csv above.csv
  scripts/coupled_levers_picture.py position.csv observer.csv below.csv above.csv
"""

from docs_picture import BLUE, GREY, RED, columns, draw, plt


def felt(axes, path, color, label):
    angle, torque = columns(path, ("theta_rad.0", "tau_ref_nm.0")).values()
    axes.plot(angle, -torque, color=color, lw=1.0, label=label)


def apart(axes, path, color, label):
    times, one, other = columns(path, ("time_s", "theta_rad.0", "theta_rad.1")).values()
    axes.plot(1e3 * times, 1e3 * (one - other), color=color, lw=0.9, label=label)


def picture(position, observer, below, above):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.2), layout="constrained")
    left.plot([0, 0.3], [0, 0.3], color=GREY, lw=0.8, ls="--", label="the spring, 1 Nm/rad")
    felt(left, position, BLUE, "position to position, 4 Nm/rad")
    felt(left, observer, RED, "the observer's torque")
    left.set(xlabel="led lever [rad]", ylabel="felt [Nm]")
    left.legend(loc="upper left", frameon=False)
    apart(right, above, RED, "14 Nm/rad")
    apart(right, below, BLUE, "11 Nm/rad")
    right.set(xlabel="time [ms]", ylabel="apart [mrad]", title="pushed apart, border 12.4 Nm/rad")
    right.legend(loc="upper left", frameon=False)
    return figure


if __name__ == "__main__":
    draw(__doc__, coupled_levers=picture)
