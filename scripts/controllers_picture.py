#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws the comparison of controllers from the JSON of feltgate controllers; it only draws.

  feltgate controllers -o docs/images/controllers.svg        calls it
  feltgate controllers --estimators -o estimators.svg        the velocity estimators instead
  feltgate controllers --json all.json && scripts/controllers_picture.py all.json all.svg

Documentation: docs/speed-for-accuracy.md
"""

import sys

from outputs import write_whole
from reports import plots

COLOURS = {
    "observer": "#0072b2",
    "feed-forward": "#008a64",
    "PI": "#b23a00",
    "PID": "#b04a8b",
    "reaction observer": "#7d4bb5",
}
DASHES = {"PI": (0, (4, 3)), "reaction observer": (0, (4, 3))}
STALL_MS = 10

def style(name):
    return {"color": COLOURS[name], "linestyle": DASHES.get(name, "-"), "linewidth": 1.2}


def picture(data):
    title = "A disturbance observer beside what one would use instead"
    figure, (step, border, noise) = plots.stacked(title, [1.9, 1.7, 1.7], apart=2)
    for one in data["controllers"]:
        name = one["name"]
        values = [1e3 * v for v in one["stall_nm"]]
        times = [1e3 * data["stall_trace_s"] * i for i in range(len(values))]
        step.plot(times, values, label=name, **style(name))
        ratios = one["inertia_ratios"]
        x, y = [r["ratio"] for r in ratios], [r["border_nm_rad"] for r in ratios]
        border.plot(x, y, marker="o", markersize=4, **style(name))
        x, y = ([e[key] for e in one["encoders"]] for key in ("lines", "noise_nm"))
        noise.plot(x, [1e3 * v for v in y], marker="o", markersize=4, **style(name))
    step.set(xlim=(0, STALL_MS), xlabel="after the step, ms", ylabel="motor torque, mNm")
    step.legend(loc="lower right", ncols=2)
    for axis, ticks in ((border, (0.5, 1, 2, 4)), (noise, (500, 1024, 2500, 10000))):
        axis.set_xscale("log")
        axis.set_xticks(ticks, [f"{t:g}" for t in ticks])
        axis.minorticks_off()
    border.set(xlabel="nominal over true inertia", ylabel="largest wall, Nm/rad")
    noise.set(xlabel="lines of the encoder", ylabel="noise, mNm rms")
    noise.set_ylim(bottom=0)
    return plots.finish(figure, "controllers")


LEAST_MNM = 0.1  # on the logarithmic axis


def estimators_picture(data):
    """Walls, and noise of tau_hat, of each estimator, as bars."""
    title = "Which velocity: the N-method or M/T over whole cycles"
    figure, (wall, noise) = plots.stacked(title, [2.2, 2.6], apart=2)
    names = [e["name"].replace("`", "") for e in data["estimators"]]
    names[2] = f"{names[1].rsplit(',', 1)[0]}, 2000 rad/s"  # "the same" in the table
    rows = range(len(names))
    walls = (("border_nm_rad", "feed-forward"), ("border_observer_nm_rad", "observer fed back"))
    for k, (key, label) in enumerate(walls):
        values = [e[key] for e in data["estimators"]]
        colour = COLOURS[label.split()[0]]
        wall.barh([r + 0.2 - 0.4 * k for r in rows], values, 0.38, label=label, color=colour)
    wall.set_xlim(0, 58)  # room for the legend
    motions = ["at rest", *(f"at {w:g} rad/s" for w in data["speeds_rad_s"])]
    for k, label in enumerate(motions):
        values = [max(1e3 * e["tau_hat_irregular_nm"][k], LEAST_MNM) for e in data["estimators"]]
        colour = ("#b23a00", "#0072b2", "#7d4bb5")[k]
        noise.barh([r + 0.27 - 0.27 * k for r in rows], values, 0.25, label=label, color=colour)
    noise.set(xscale="log", xlim=(LEAST_MNM, 300))
    for axis, text in ((wall, "largest wall, Nm/rad"), (noise, "noise of tau_hat, mNm rms")):
        place = "center right" if axis is wall else "lower right"
        axis.set_yticks(list(rows), names, fontsize=7)
        axis.invert_yaxis()
        axis.set_xlabel(text)
        axis.legend(loc=place, fontsize=7)
    return plots.finish(figure, "estimators")


SCHEMAS = {
    "feltgate-controllers/1": picture,
    "feltgate-estimators/1": estimators_picture,
}


def draw(data, options):
    write_whole(options.to, SCHEMAS[data["schema"]](data).svg)


if __name__ == "__main__":
    sys.exit(plots.main(__doc__, "controllers", SCHEMAS, draw))
