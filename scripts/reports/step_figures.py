# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Rows of figures 7, 10 and 11 of the paper: the two calibrations, and torque steps. Documentation: docs/figures.md"""

import numpy as np

from reports import measure
from reports.paper_figure import PaperFigure
from reports.paper_pictures import CLOSED, OPEN, STEPS, closed_jobs, open_jobs, step_job
from reports.run_section import steps_of
from reports.runs import design

SCENES = {STEPS: "locked", "torque_step_cord": "cord"}


def jobs(designs):
    found = [*open_jobs().values(), *closed_jobs().values()]
    return found + [step_job(d, scene) for d in designs for scene in SCENES]


def figure_7(find):
    columns = {"paper": "24 V winding", "paper_48v": "48 V winding", "lever": "24 V winding"}
    found = PaperFigure(7, [(key, f"design {key.partition('_')[0]}, {words}") for key, words in columns.items()])
    volts = measure.set_values(OPEN, "voltage_setpoint")
    measured, observed, exact, ideal, offset = {}, {}, {}, {}, {}
    for key, job in open_jobs().items():
        if not (run := find(job)):
            continue
        motor = measure.plant("p48" if key == "paper_48v" else "p24")["motor"]
        ideal[key] = motor["torque_constant_nm_a"] / motor["resistance_ohm"]
        measured[key], offset[key] = measure.slope(volts, measure.finals(run, "motor_torque_nm", OPEN))
        observed[key], exact[key] = (
            measure.slope(volts, measure.finals(run, column, OPEN))[0] for column in ("tau_hat_nm", "quad_tau_hat_nm")
        )
    found.add("measured_slope_nm_v", measured)
    found.add("ideal_slope_nm_v", ideal)
    found.add("measured_offset_nm", offset)
    found.add("observed_slope_nm_v", observed)
    found.add("observed_slope_quad_nm_v", exact)
    found.add("slope_ratio", {key: measured[key] / observed[key] for key in measured})
    return found


def points(run):
    reference = measure.set_values(CLOSED, "setpoint_torque")
    columns = ("motor_torque_nm", "tau_hat_nm", "quad_tau_hat_nm", "voltage_v", "current_a")
    return (reference, *(measure.finals(run, column, CLOSED) for column in columns))


def figure_10(find):
    found = PaperFigure(10, [("unit", "paper, Kv = 1"), ("paper", "paper, Kv 1.25/0.95"), ("lever", "lever")])
    data = {key: points(run) for key, job in closed_jobs().items() if (run := find(job))}
    for reference, sign in ((0.1, "negative"), (0.2, "positive"), (0.3, "positive")):
        errors = {}
        for key, (references, motor, seen, *_) in data.items():
            at = int(np.argmin(np.abs(references - reference)))
            errors[key] = 100 * (motor[at] - seen[at]) / reference
        key = f"error_at_{reference}_nm_pct"
        found.add(key, errors, "error_at_nm_pct", (reference, sign))
    crossing = {k: measure.zero_crossing(d[0], d[1] - d[2]) for k, d in data.items() if k == "unit"}
    found.add("error_sign_change_nm", crossing)
    largest = {k: 1e3 * np.abs(d[2] - d[3]).max() for k, d in data.items()}
    found.add("observed_less_quad_mnm", largest)
    if "paper" in data:
        found.notes.append(border_note(found, data["paper"]))
    if "lever" in data:
        rising = bool(
            np.all(np.diff(data["lever"][4]) > 0) and np.all(np.diff(data["lever"][1]) > 0)
        )
        found.notes.append(
            "In design lever voltage and torque "
            + ("rise with the reference everywhere: " if rising else "do NOT rise everywhere: ")
            + "V = R I + Ke w + dead voltage has no regions."
        )
    return found


def border_note(found, data):
    """What the border at 0.15 Nm does, from the points on both sides of it."""
    reference, motor, _, _, command, current = data
    law = design("paper")["voltage"]
    below = int(np.argmin(np.abs(reference - 0.15)))
    above = int(np.argmin(np.abs(reference - 0.16)))
    before = law["kv_low"] * current[below]
    after = law["kv_high"] * current[above] * reference[below] / reference[above]
    fall = 1e3 * measure.slope(command, motor)[0] * (after - before)
    found.add("border_voltage_before_v", {"paper": before})
    found.add("border_voltage_after_v", {"paper": after})
    found.add("border_torque_fall_mnm", {"paper": fall})
    return (
        f"The border is a defect: as the reference rises through 0.15 Nm the command falls from "
        f"{before:.2f} V to {after:.2f} V, and the motor's torque by {-fall:.0f} mNm, while the "
        "hand pushes deeper. The torque is not monotone in the reference, whatever is "
        f"calibrated; the paper does not mention it. (The core adds "
        f"{measure.dead_time_v('paper'):.2f} V to both for the dead time of the bridge.)"
    )


def figure_11(find, designs):
    found = PaperFigure(11, [(f"{d}_{s}", f"{d}, {words}") for d in designs for s, words in SCENES.items()])
    runs = {f"{d}_{s}": (s, run) for d in designs for s in SCENES if (run := find(step_job(d, s)))}
    steps = {key: steps_of(run.summary) for key, (_, run) in runs.items()}
    kinds = ("tau_hat_settling_ms", "torque_settling_ms", "final_error_pct")
    for key in (*kinds, "tau_hat_final_error_pct"):
        stem, unit = key.rsplit("_", 1)
        for i, (_, _, event) in enumerate(measure.steps("torque_step")):
            there = {run: of[i].get(key) for run, of in steps.items() if i < len(of)}
            goal = event["step_nm"]
            found.add(f"{stem}_at_{goal}_nm_{unit}", there, key, (goal, ""))
    found.add("observed_spike_mnm", {key: 1e3 * spike(run, scene) for key, (scene, run) in runs.items()})
    return found


def spike(run, scene):
    """Largest distance of the observed torque from its closed form, any step."""
    pole, worst = measure.observer_pole(run.design), 0.0
    time, observed = run.csv["time_s"], run.csv["tau_hat_nm"]
    for begin, until, event in measure.steps(scene):
        inside = (time > begin) & (time <= until)
        ideal = event["step_nm"] * (1 - np.exp(-pole * (time[inside] - begin)))
        worst = max(worst, float(np.abs(observed[inside] - ideal).max()))
    return worst
