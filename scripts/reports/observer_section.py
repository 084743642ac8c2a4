# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The demo's section on where the observer is: lever beside lever_observer. Documentation: docs/figures.md"""

from dataclasses import replace

import numpy as np

from reports import page, plots
from reports.runs import design, scene_job

DESIGNS = {"lever": "motor", "lever_observer": "paper"}  # and the colour of each
LOAD = "load_step"
LOAD_S = 0.2  # when the load of vectors/scenes/load_step.toml steps
HELD_S = 0.05  # before it the lever is at rest
# A step of 0.3 Nm at a locked shaft on motors whose constants are not the design's.
OTHERS = {"p24_warm": "R +20 %", "p48": "R 3 times, Kt twice"}


def others_job(name, plant):
    job = scene_job("hold_and_release", name, plant)
    return replace(job, arguments=(*job.arguments, "--engine", "twin"))


def jobs():
    """What the section needs beside the demo's scenes."""
    found = [scene_job(scene, name, every=50) for name in DESIGNS for scene in (LOAD, "torque_step")]
    return found + [others_job(name, plant) for name in DESIGNS for plant in OTHERS]


def of_load(run):
    """Ripple of the held wall, mNm rms; how far the load step swings over, %; when it rests, ms."""
    time, theta, torque = (run.csv[key] for key in ("time_s", "theta_rad", "motor_torque_nm"))
    held = (time > LOAD_S - HELD_S) & (time < LOAD_S)
    after = time > LOAD_S
    begin, end = theta[held].mean(), theta[time > time[-1] - HELD_S / 2].mean()
    over = 100 * (theta[after].max() - end) / (end - begin)
    count = 2 * np.pi / (4 * design("lever")["encoder"]["lines"])
    off = np.flatnonzero(after & (np.abs(theta - end) > count))
    return 1e3 * torque[held].std(), over, 1e3 * (time[off[-1]] - LOAD_S)


def picture(found):
    """Angle and motor torque of both designs after the step."""
    figure, axes = plots.stacked("Load step at a wall of 4 Nm/rad", [1.2, 1.2])
    for name, colour in DESIGNS.items():
        csv = found[name].csv
        ms = 1e3 * (csv["time_s"] - LOAD_S)
        shown = (ms > -10) & (ms < 100)
        for axis, key in zip(axes, ("theta_rad", "motor_torque_nm"), strict=True):
            plots.draw(axis, ms[shown], csv[key][shown], colour, name, linestyle="-")
    axes[0].set_ylabel("angle, rad")
    axes[1].set(ylabel="motor torque, Nm", xlabel="after the step, ms")
    plots.legend(axes[0])
    return plots.finish(figure, "observer", "A force without damping steps from 0.1 to 0.2 Nm.")


def numbers(runs, name):
    """Those of a design, in the order of WORDS."""

    def figure(job, key):
        return runs[job.name].summary["figures"].get(key)

    step = scene_job("torque_step", name)
    return [
        figure(step, "torque_settling_ms.1"),
        figure(step, "final_error_pct.1"),
        *(figure(others_job(name, plant), "final_error_pct.0") for plant in OTHERS),
        *of_load(runs[scene_job(LOAD, name).name]),
    ]


WORDS = (
    "step of 0.2 Nm, shaft locked: settles (2 %), ms",
    "the same: final error, %",
    *(f"step of 0.3 Nm, {words}: final error, %" for words in OTHERS.values()),
    "wall held with 0.1 Nm: ripple of the motor's torque, mNm rms",
    "load step there to 0.2 Nm: swings over, %",
    "the same: within a count, ms",
)


def html(runs):
    """Of {name: Run}; nothing where one is missing."""
    if not all(job.name in runs and runs[job.name].ran for job in jobs()):
        return ""
    columns = [numbers(runs, name) for name in DESIGNS]
    rows = [[words, *map(page.number, row)] for words, *row in zip(WORDS, *columns, strict=True)]
    text = page.paragraph(
        "lever is feed-forward: it shows the observed torque and does not feed it back. lever_observer "
        "has the same constants and feeds 22 % back. At a locked shaft the observer sees its own "
        "command, so neither corrects a wrong R or Kt."
    )
    load = {name: runs[scene_job(LOAD, name).name] for name in DESIGNS}
    text += page.pictures([picture(load)]) + page.table(["", *DESIGNS], rows, words=(0,))
    return page.section("observer", "Where the observer is", text)
