#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/material_fields.svg, each field of a material alone, and
docs/images/material_stick_slip.svg, from the rows of the two scenes.

  feltgate run material_fields --engine twin --csv fields.csv --every 20
  feltgate run material_stick_slip --engine twin --csv slip.csv --every 50
  scripts/material_picture.py fields.csv slip.csv
"""

from docs_picture import BLUE, GREY, RED, columns, draw, np, plt, vectors

FIELDS = ("hardness: a spring", "damping: on the way in", "giving way at 0.1 Nm", "viscosity",
          "spring to an anchor", "constant", "friction: sticks, slips", "vibration, 200 Hz")


def fields(path, _slip):
    run, at = columns(path), vectors("scenes/material_fields")
    # Each pass begins a moment before the event that chooses its field, the first with the scene.
    begins = [0.0] + [event["at_s"] for event in at["event"]] + [at["duration_s"]]
    depth, torque = 1e3 * (run["theta_rad"] - at["parameters"]["face"]), 1e3 * run["tau_ref_nm"]
    figure, panels = plt.subplots(2, 4, figsize=(10, 5), sharex=True, sharey=True,
                                  layout="constrained")
    for n, axes in enumerate(panels.flat):
        rows = np.flatnonzero((begins[n] <= run["time_s"]) & (run["time_s"] < begins[n + 1]))
        deepest = rows[run["theta_rad"][rows].argmax()]
        for color, label, part in ((BLUE, "in", rows[rows <= deepest]),
                                   (RED, "out", rows[rows > deepest])):
            axes.plot(depth[part], torque[part], color=color, lw=1.1, label=label)
        axes.axvline(0, color=GREY, lw=0.6)
        axes.axhline(0, color=GREY, lw=0.6)
        axes.set_title(FIELDS[n], fontsize=9)
        axes.grid(alpha=0.3)
        axes.set_xlim(-25, 65)
    panels[0][0].legend(fontsize=8, frameon=False)
    figure.supxlabel("depth behind the face, mrad", fontsize=9)
    figure.supylabel("law's torque, mNm", fontsize=9)
    return figure


def stick_slip(_fields, path):
    run = columns(path)
    times = 1e3 * run["time_s"]
    figure, (torque, place) = plt.subplots(2, 1, figsize=(7, 4.4), sharex=True,
                                           layout="constrained")
    torque.plot(times, -1e3 * run["tau_ref_nm"], color=BLUE, lw=1.1, label="friction")
    torque.plot(times, 1e3 * run["hand_torque_nm"], color=RED, lw=1.1, label="hand's pull")
    for level, name in ((200, "static"), (150, "dynamic")):
        torque.axhline(level, color=GREY, lw=0.7, ls="--")
        torque.text(2, level + 3, name, fontsize=8, color=GREY)
    torque.set(ylabel="torque, mNm")
    torque.legend(fontsize=8, frameon=False, loc="lower right")
    place.plot(times, run["theta_rad"], color=BLUE, lw=1.2, label="lever")
    place.plot(times, 4 * np.maximum(times - 10, 0) / 1e3, color=GREY, lw=0.9, ls="--",
               label="where the hand wants it: 4 rad/s")
    place.set(xlabel="time, ms", ylabel="angle, rad")
    place.legend(fontsize=8, frameon=False)
    for axes in (torque, place):
        axes.grid(alpha=0.3)
    return figure


if __name__ == "__main__":
    draw(__doc__, material_fields=fields, material_stick_slip=stick_slip)
