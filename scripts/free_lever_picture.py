#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/free_lever.svg: the hand's torque against the speed, free and damped, from the
rows of three runs, and what is felt over the damper that is asked for, from the test's table.

  ./feltgate run free_lever --engine twin --every 500 --csv free.csv
  ./feltgate run damped_lever --engine twin --every 500 --csv lever.csv
  ./feltgate run damped_lever --design paper --engine twin --every 500 --csv paper.csv
  FELTGATE_SHOW=1 build/testbench/loop/free_lever_test > table.md
  scripts/free_lever_picture.py free.csv lever.csv paper.csv table.md
"""

import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
BLUE, RED, GREY = "#1f6fb4", "#c0392b", "#888888"
COLOURS = {"lever": BLUE, "paper": RED}


def swing(axes, path, color, label):
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if float(row["time_s"]) > 0.02]
    axes.plot([float(r["omega_rad_s"]) for r in rows],
              [1e3 * float(r["hand_torque_nm"]) for r in rows], color=color, lw=1.0, label=label)


def table(path):
    """{design: [(asked, rms, rms by formulas)]}, of the rows without friction of the plant."""
    found = {}
    for line in Path(path).read_text(encoding="utf-8").splitlines():
        cells = [cell.strip(" `") for cell in line.split("|")[1:-1]]
        if len(cells) == 9 and cells[0] in COLOURS and float(cells[2]) == 0:
            found.setdefault(cells[0], []).append(tuple(float(cells[i]) for i in (1, 3, 4)))
    return found


def main(free, lever, paper, felt):
    plt.rcParams.update({"svg.hashsalt": "feltgate", "font.size": 8})
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.0), layout="constrained")
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
    nobody = {"Date": None, "Creator": None}
    figure.savefig(ROOT / "docs/images/free_lever.svg", metadata=nobody)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        print(__doc__, file=sys.stderr)
        sys.exit(0 if "--help" in sys.argv else 2)
    main(*sys.argv[1:])
