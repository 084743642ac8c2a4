#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/free_lever.svg: the hand's torque against the speed, free and damped, from the
rows of three runs, and the felt damping over the damping asked for, from the test's
table.

  ./feltgate run free_lever --engine twin --every 500 --csv free.csv
  ./feltgate run damped_lever --engine twin --every 500 --csv lever.csv
  ./feltgate run damped_lever --design paper --engine twin --every 500 --csv paper.csv
  FELTGATE_SHOW=1 build/testbench/sim/loop/free_lever_test > table.md
  scripts/free_lever_picture.py free.csv lever.csv paper.csv table.md
"""

from pathlib import Path

from docs_picture import BLUE, GREY, RED, columns, draw, plt

COLOURS = {"lever": BLUE, "paper": RED}


def swing(axes, path, color, label):
    times, speed, torque = columns(path, ("time_s", "omega_rad_s", "hand_torque_nm")).values()
    rows = times > 0.02
    axes.plot(speed[rows], 1e3 * torque[rows], color=color, lw=1.0, label=label)


def table(path):
    """{design: [(asked, rms, rms by formulas)]}, of the rows without friction of the plant."""
    found = {}
    for line in Path(path).read_text(encoding="utf-8").splitlines():
        cells = [cell.strip(" `") for cell in line.split("|")[1:-1]]
        if len(cells) == 9 and cells[0] in COLOURS and float(cells[2]) == 0:
            found.setdefault(cells[0], []).append(tuple(float(cells[i]) for i in (1, 3, 4)))
    return found


def picture(free, lever, paper, felt):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4), layout="constrained")
    swing(left, paper, RED, "damper of 0.03 Nm s/rad, paper")
    swing(left, lever, BLUE, "the same, lever")
    swing(left, free, GREY, "free, lever")
    left.set(xlabel="speed [rad/s]", ylabel="the hand's torque [mNm]", title="half a swing at 2 Hz")
    left.legend(loc="lower right", frameon=False)
    for design, rows in table(felt).items():
        asked, bits, formulas = zip(*rows, strict=True)
        right.plot(asked, formulas, color=COLOURS[design], lw=1.0, label=f"{design}, by formulas")
        right.plot(asked, bits, "o", color=COLOURS[design], ms=4, label=f"{design}, by bits")
    right.set(xlabel="damper asked for [mNm s/rad]", ylabel="felt, rms [mNm]", ylim=(0, None))
    right.legend(loc="upper left", frameon=False)
    for axes in (left, right):
        axes.grid(alpha=0.3)
    return figure


if __name__ == "__main__":
    draw(__doc__, free_lever=picture)
