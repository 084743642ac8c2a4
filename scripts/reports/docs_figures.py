# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The nine figures of the paper as one small picture each for docs/figures.md, from the twin alone.

`feltgate figures --docs` calls it; figures.html has more of each. Documentation: docs/figures.md
"""

from dataclasses import replace

import numpy as np

from reports import calibrations, measure, objects, plots
from reports.paper_figure import WORDS
from reports.runs import read_toml, scene_job
from reports.scene_figures import SPECS, motion_file, motion_job

DESIGNS = {"paper": "paper", "lever": "motor"}  # and the colour of each
STEPS = "torque_step"


def by_twin(job):
    """The same job with the twin as its only engine."""
    words = job.arguments
    if "--engine" in words:
        words = words[: words.index("--engine")]
    return replace(job, name=f"{job.name}-twin", arguments=(*words, "--engine", "twin"), every=100)


def object_job(spec, name):
    return by_twin(motion_job(spec, name) if spec.motion else scene_job(spec.scene, name))


def calibration_jobs():
    """{figure: {key: job}}"""
    found = {7: calibrations.open_jobs(), 10: calibrations.closed_jobs()}
    return {n: {key: by_twin(job) for key, job in of.items() if key != "paper_48v"} for n, of in found.items()}


def step_jobs():
    return {name: by_twin(scene_job(STEPS, name)) for name in DESIGNS}


def jobs():
    found = [job for of in calibration_jobs().values() for job in of.values()]
    found += step_jobs().values()
    return found + [object_job(spec, name) for spec in SPECS for name in DESIGNS]


def begun(number, heights):
    return plots.stacked(f"Figure {number}: {WORDS[str(number)]['title']}", heights)


def ended(figure, number):
    return plots.finish(figure, f"paper_{number:02d}")


def line(axes, x, y, kind, label):
    """A thin line in the colour of a design."""
    plots.draw(axes, x, y, kind, label, linewidth=1.2, linestyle="-")


def figure_7(runs):
    figure, (axes,) = begun(7, [2.4])
    wide = np.linspace(0, 5.5, 2)
    for published in (0.072, 0.051):
        plots.draw(axes, wide, published * wide, "ideal", "the paper's slopes" if published > 0.06 else "")
    volts = measure.set_values(calibrations.OPEN, "voltage_setpoint")
    for key in DESIGNS:
        run = runs[calibration_jobs()[7][key].name]
        for column, words, mark in (("motor_torque_nm", "motor", "o"), ("tau_hat_nm", "observed", "s")):
            values = measure.finals(run, column, calibrations.OPEN)
            style = {"color": plots.COLOURS[DESIGNS[key]], "markersize": 4}
            axes.plot(volts, values, f"{mark}-", linewidth=0.8, label=f"{key}: {words}", **style)
    axes.set(xlabel="voltage, V", ylabel="torque, Nm", ylim=(0, None))
    axes.legend(loc="upper left", fontsize=7.5)
    return ended(figure, 7)


def figure_10(runs):
    figure, (axes,) = begun(10, [2.2])
    reference = measure.set_values(calibrations.CLOSED, "setpoint_torque")
    shown = {"unit": ("paper, Kv = 1", "rtl"), "paper": ("paper, Kv 1.25/0.95", "paper"), "lever": ("lever", "motor")}
    for key, (words, colour) in shown.items():
        run = runs[calibration_jobs()[10][key].name]
        motor, seen = (measure.finals(run, c, calibrations.CLOSED) for c in ("motor_torque_nm", "tau_hat_nm"))
        error = 1e3 * (motor - seen)
        axes.plot(reference, error, "o-", color=plots.COLOURS[colour], markersize=4, linewidth=0.8, label=words)
    axes.axhline(0, color=plots.COLOURS["ideal"], linewidth=0.8)
    axes.axvline(0.15, color=plots.COLOURS["reference"], linestyle=":")
    axes.set(xlabel="torque reference, Nm", ylabel="motor less\nobserved, mNm")
    plots.legend(axes)
    return ended(figure, 10)


def figure_11(runs):
    figure, (axes,) = begun(11, [2.4])
    pole = measure.observer_pole("paper")
    for begin, _, event in measure.steps(STEPS):
        first, goal = event["step_nm"] == 0.1, event["step_nm"]
        for name, job in step_jobs().items():
            csv = runs[job.name].csv
            ms = 1e3 * (csv["time_s"] - begin)
            at = (ms > -2) & (ms < 25)
            line(axes, ms[at], csv["motor_torque_nm"][at], DESIGNS[name], f"{name}: motor" if first else "")
            if name == "paper":
                plots.draw(axes, ms[at], csv["tau_hat_nm"][at], "rtl", "paper: observed" if first else "")
                ideal = goal * (1 - np.exp(-pole * 1e-3 * np.maximum(ms[at], 0)))
                plots.draw(axes, ms[at], ideal, "ideal", f"1 - exp(-{pole:.4g} t)" if first else "")
    axes.set(xlabel="time after the step, ms", ylabel="torque, Nm")
    plots.legend(axes, 4)
    return ended(figure, 11)


def of_object(spec, runs):
    """Position, and the torques of both designs; what the object should ask for is dashed."""
    figure, (where, torque) = begun(spec.number, [0.7, 1.7])
    for name, kind in DESIGNS.items():
        arm_s = read_toml(motion_file(spec))["core"]["arm_s"] if spec.motion else None
        v = objects.view(runs[object_job(spec, name).name], spec.scene, name, arm_s)
        if name == "paper":
            line(where, v.time, v.theta, "reference", "")
            plots.draw(torque, v.time, v.observed, "rtl", "paper: observed")
        else:
            plots.draw(torque, v.time, v.ideal, "ideal")
        line(torque, v.time, v.motor, kind, f"{name}: motor")
    where.set_ylabel("position,\nrad")
    torque.set(xlabel="time, s", ylabel="torque, Nm" + ("\n(mirrored)" if spec.mirrored else ""))
    if spec.mirrored:
        torque.invert_yaxis()
    plots.legend(torque, 4)
    figure.align_ylabels([where, torque])
    return ended(figure, spec.number)


def draw(runs):
    """The nine pictures, in the paper's order."""
    return [figure_7(runs), figure_10(runs), figure_11(runs), *(of_object(spec, runs) for spec in SPECS)]
