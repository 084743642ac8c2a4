#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/drums.svg: the stick over the drums with the reported hits, from a run.

  ./feltgate run drums --engine twin --csv drums.csv --every 1200 --events hits.txt
  scripts/drums_picture.py drums.csv hits.txt
"""

import math

import drums_sound
from docs_picture import BLUE, GREY, RED, columns, files, plt, save

NAMES = ("time_s", "theta_rad", "tau_ref_nm")
STICK_M = 0.3


def main():
    rows, hits = files(2, __doc__)
    time_s, theta_rad, torque_nm = columns(rows, NAMES).values()
    tip_mm = [1e3 * STICK_M * math.sin(theta) for theta in theta_rad]
    torque_mnm = [1e3 * torque for torque in torque_nm]
    figure, (tip, torque) = plt.subplots(2, 1, figsize=(8, 4), sharex=True)
    tip.plot(time_s, tip_mm, color="k", lw=1)
    tip.axhline(0, color=GREY, lw=0.8)
    tip.fill_between(time_s, -15, 0, color=GREY, alpha=0.15, lw=0)
    for at_s, drum, speed, place in drums_sound.read_hits(hits):
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
    save(figure, "drums")


if __name__ == "__main__":
    main()
