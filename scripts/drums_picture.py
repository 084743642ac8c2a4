#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/drums.svg: the stick over the drums with the hits that were told, from a run.

  ./feltgate run drums --engine twin --csv drums.csv --every 1200 --events hits.txt
  scripts/drums_picture.py drums.csv hits.txt
"""

import csv
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

import drums_sound  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
BLUE, RED, GREY = "#1f6fb4", "#c0392b", "#888888"
STICK_M = 0.3


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    time_s = [float(r["time_s"]) for r in rows]
    tip_mm = [1e3 * STICK_M * math.sin(float(r["theta_rad"])) for r in rows]
    torque_mnm = [1e3 * float(r["tau_ref_nm"]) for r in rows]
    plt.rcParams.update({"svg.hashsalt": "feltgate", "font.size": 9, "svg.fonttype": "none"})
    figure, (tip, torque) = plt.subplots(2, 1, figsize=(8, 4), sharex=True)
    tip.plot(time_s, tip_mm, color="k", lw=1)
    tip.axhline(0, color=GREY, lw=0.8)
    tip.fill_between(time_s, -15, 0, color=GREY, alpha=0.15, lw=0)
    for at_s, drum, speed, place in drums_sound.read_hits(sys.argv[2]):
        tip.plot(at_s, 0, "o", color=RED, ms=3 + 4 * speed)
        tip.annotate(f"drum {drum}\n{speed:.2f} m/s\nplace {place:.2f}", (at_s, 40), (-6, 0),
                     textcoords="offset points", fontsize=8, color=RED)
    tip.set_ylabel("tip over the skins, mm")
    tip.set_ylim(-15, 65)
    torque.plot(time_s, torque_mnm, color=BLUE, lw=1)
    torque.set_ylabel("torque, mNm")
    torque.set_xlabel("time, s")
    for axes in (tip, torque):
        axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    figure.savefig(ROOT / "docs/images/drums.svg", metadata={"Date": None})
    return 0


if __name__ == "__main__":
    sys.exit(main())
