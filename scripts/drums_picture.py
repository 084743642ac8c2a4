#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/drums.svg: the stick over the drums with the reported hits, from a run.

  ./feltgate run drums --engine twin --csv drums.csv --every 1200 --events hits.txt
  scripts/drums_picture.py drums.csv hits.txt
"""

import drums_sound
from docs_picture import BLUE, GREY, RED, columns, draw, np, plt

NAMES = ("time_s", "theta_rad", "tau_ref_nm")
STICK_M = 0.3


def picture(rows, hits):
    time_s, theta_rad, torque_nm = columns(rows, NAMES).values()
    figure, (tip, torque) = plt.subplots(2, 1, figsize=(8, 4), sharex=True)
    tip.plot(time_s, 1e3 * STICK_M * np.sin(theta_rad), color="k", lw=1)
    tip.axhline(0, color=GREY, lw=0.8)
    tip.fill_between(time_s, -15, 0, color=GREY, alpha=0.15, lw=0)
    for at_s, drum, speed, place in drums_sound.read_hits(hits):
        tip.plot(at_s, 0, "o", color=RED, ms=3 + 4 * speed)
        tip.annotate(f"drum {drum}\n{speed:.2f} m/s\nplace {place:.2f}", (at_s, 40), (-6, 0),
                     textcoords="offset points", fontsize=8, color=RED)
    tip.set(ylabel="tip over the skins, mm", ylim=(-15, 65))
    torque.plot(time_s, 1e3 * torque_nm, color=BLUE, lw=1)
    torque.set(ylabel="torque, mNm", xlabel="time, s")
    for axes in (tip, torque):
        axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    return figure


if __name__ == "__main__":
    draw(__doc__, drums=picture)
