# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The nine figures of the paper as one picture each: of a page, from the RTL, and of docs/figures.md, from the twin.

`find(job)` is the run of a job, or None where there is none. Documentation: docs/figures.md
"""

from dataclasses import replace

import numpy as np

from reports import measure, objects, plots
from reports.paper_figure import WORDS
from reports.runs import Job, ROOT, read_toml, scene_job

DESIGNS = {"paper": "paper", "lever": "motor"}  # and the colour of each
OPEN, CLOSED, STEPS = "calibration_open_loop", "calibration_closed_loop", "torque_step"
UNIT_GAIN = (("voltage_gain", 1), ("voltage_gain_high", 1))
MOTIONS = ROOT / "vectors" / "figures"
SHORT = 19  # the figure whose motion RTL and twin run in lock-step, too
OBJECTS = {int(number): words for number, words in WORDS.items() if "scene" in words}
NUMBERS = (7, 10, 11, *OBJECTS)


def open_jobs():
    """Of figure 7, by column."""
    return {
        "paper": scene_job(OPEN, "paper"),
        "paper_48v": scene_job(OPEN, "paper", plant="p48"),
        "lever": scene_job(OPEN, "lever"),
    }


def closed_jobs():
    """Of figure 10, by column."""
    return {
        "unit": scene_job(CLOSED, "paper", sets=UNIT_GAIN, variant="kv1"),
        "paper": scene_job(CLOSED, "paper"),
        "lever": scene_job(CLOSED, "lever"),
    }


def step_job(design, scene=STEPS):
    return scene_job(scene, design, every=20)


def motion_file(number):
    return MOTIONS / f"figure_{number}.toml"


def motion_job(number, design):
    """A run of the paper's own motion; a long one by the twin, which takes a tenth of the time."""
    path = motion_file(number)
    arguments = ("run", str(path), "--design", design)
    if number != SHORT:
        arguments += ("--engine", "twin,quad")
    return Job(f"figure_{number}-{design}", arguments, float(read_toml(path)["duration_s"]), every=50)


def object_job(number, design):
    """In the paper's own motion, where the shipped scene has another."""
    scene = OBJECTS[number]["scene"]
    return motion_job(number, design) if OBJECTS[number].get("motion") else scene_job(scene, design, every=50)


def by_twin(job):
    """The same job with the twin as its only engine."""
    words = job.arguments
    if "--engine" in words:
        words = words[: words.index("--engine")]
    return replace(job, name=f"{job.name}-twin", arguments=(*words, "--engine", "twin"), every=100)


def jobs():
    """What all nine need, for the twin."""
    found = [job for key, job in open_jobs().items() if key != "paper_48v"]
    found += [*closed_jobs().values(), *map(step_job, DESIGNS)]
    found += [object_job(number, design) for number in OBJECTS for design in DESIGNS]
    return [by_twin(job) for job in found]


def begun(number, heights):
    return plots.stacked(f"Figure {number}: {WORDS[str(number)]['title']}", heights)


def line(axes, x, y, kind, label):
    """A thin line in the colour of a design."""
    plots.draw(axes, x, y, kind, label, linewidth=1.2, linestyle="-")


def figure_7(find):
    figure, (axes,) = begun(7, [2.4])
    wide = np.linspace(0, 5.5, 2)
    for published in (0.072, 0.051):
        plots.draw(axes, wide, published * wide, "ideal", "the paper's slopes" if published > 0.06 else "")
    volts = measure.set_values(OPEN, "voltage_setpoint")
    for key in DESIGNS:
        run = find(open_jobs()[key])
        for column, words, mark in (("motor_torque_nm", "motor", "o"), ("tau_hat_nm", "observed", "s")) if run else ():
            values = measure.finals(run, column, OPEN)
            style = {"color": plots.COLOURS[DESIGNS[key]], "markersize": 4}
            axes.plot(volts, values, f"{mark}-", linewidth=0.8, label=f"{key}: {words}", **style)
    axes.set(xlabel="voltage, V", ylabel="torque, Nm", ylim=(0, None))
    axes.legend(loc="upper left", fontsize=7.5)
    return figure


def figure_10(find):
    figure, (axes,) = begun(10, [2.2])
    reference = measure.set_values(CLOSED, "setpoint_torque")
    shown = {"unit": ("paper, Kv = 1", "rtl"), "paper": ("paper, Kv 1.25/0.95", "paper"), "lever": ("lever", "motor")}
    for key, (words, colour) in shown.items():
        run = find(closed_jobs()[key])
        if not run:
            continue
        motor, seen = (measure.finals(run, c, CLOSED) for c in ("motor_torque_nm", "tau_hat_nm"))
        error = 1e3 * (motor - seen)
        axes.plot(reference, error, "o-", color=plots.COLOURS[colour], markersize=4, linewidth=0.8, label=words)
    axes.axhline(0, color=plots.COLOURS["ideal"], linewidth=0.8)
    axes.axvline(0.15, color=plots.COLOURS["reference"], linestyle=":")
    axes.set(xlabel="torque reference, Nm", ylabel="motor less\nobserved, mNm")
    plots.legend(axes)
    return figure


def figure_11(find):
    figure, (axes,) = begun(11, [2.4])
    pole = measure.observer_pole("paper")
    for begin, _, event in measure.steps(STEPS):
        first, goal = event["step_nm"] == 0.1, event["step_nm"]
        for name in DESIGNS:
            run = find(step_job(name))
            if not run:
                continue
            csv = run.csv
            ms = 1e3 * (csv["time_s"] - begin)
            at = (ms > -2) & (ms < 25)
            line(axes, ms[at], csv["motor_torque_nm"][at], DESIGNS[name], f"{name}: motor" if first else "")
            if name == "paper":
                plots.draw(axes, ms[at], csv["tau_hat_nm"][at], "rtl", "paper: observed" if first else "")
                ideal = goal * (1 - np.exp(-pole * 1e-3 * np.maximum(ms[at], 0)))
                plots.draw(axes, ms[at], ideal, "ideal", f"1 - exp(-{pole:.4g} t)" if first else "")
    axes.set(xlabel="time after the step, ms", ylabel="torque, Nm")
    plots.legend(axes, 4)
    return figure


def of_object(number, find):
    """Position, and the torques of both designs; what the object should ask for is dashed."""
    words = OBJECTS[number]
    figure, (where, torque) = begun(number, [0.7, 1.7])
    for name, kind in DESIGNS.items():
        run = find(object_job(number, name))
        if not run:
            continue
        arm_s = read_toml(motion_file(number))["core"]["arm_s"] if words.get("motion") else None
        v = objects.view(run, words["scene"], name, arm_s)
        if not where.lines:
            line(where, v.time, v.theta, "reference", "")
        if name == "paper":
            plots.draw(torque, v.time, v.observed, "rtl", "paper: observed")
        else:
            plots.draw(torque, v.time, v.ideal, "ideal")
        line(torque, v.time, v.motor, kind, f"{name}: motor")
    where.set_ylabel("position,\nrad")
    torque.set(xlabel="time, s", ylabel="torque, Nm" + ("\n(mirrored)" if words.get("mirrored") else ""))
    if words.get("mirrored"):
        torque.invert_yaxis()
    plots.legend(torque, 4)
    figure.align_ylabels([where, torque])
    return figure


def draw(number, find, png=False):
    """The picture of a figure."""
    drawing = {7: figure_7, 10: figure_10, 11: figure_11}.get(number)
    figure = drawing(find) if drawing else of_object(number, find)
    caption = WORDS[str(number)].get("motion", "")
    return plots.finish(figure, f"paper_{number:02d}", caption, png)
