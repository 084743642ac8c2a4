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

import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
BLUE, RED, GREY = "#1f6fb4", "#c0392b", "#888888"


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def felt(axes, path, color, label):
    rows = rows_of(path)
    axes.plot([r["theta_rad.0"] for r in rows], [-r["tau_ref_nm.0"] for r in rows], color=color,
              lw=1.0, label=label)


def apart(axes, path, color, label):
    rows = rows_of(path)
    axes.plot([1e3 * r["time_s"] for r in rows],
              [1e3 * (r["theta_rad.0"] - r["theta_rad.1"]) for r in rows], color=color, lw=0.9,
              label=label)


def main(position, observer, below, above):
    plt.rcParams.update({"svg.hashsalt": "feltgate", "font.size": 8})
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 2.8), layout="constrained")
    left.plot([0, 0.3], [0, 0.3], color=GREY, lw=0.8, ls="--", label="the spring, 1 Nm/rad")
    felt(left, position, BLUE, "position to position, 4 Nm/rad")
    felt(left, observer, RED, "the observer's torque")
    left.set(xlabel="led lever [rad]", ylabel="felt [Nm]")
    left.legend(loc="upper left", frameon=False)
    apart(right, above, RED, "14 Nm/rad")
    apart(right, below, BLUE, "11 Nm/rad")
    right.set(xlabel="time [ms]", ylabel="apart [mrad]", title="pushed apart, border 12.4 Nm/rad")
    right.legend(loc="upper left", frameon=False)
    nobody = {"Date": None, "Creator": None}
    figure.savefig(ROOT / "docs/images/coupled_levers.svg", metadata=nobody)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
