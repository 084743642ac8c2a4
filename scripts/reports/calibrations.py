# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Figures 7 and 10 of the paper: the two calibrations. Documentation: docs/figures.md"""

import numpy as np

from reports import measure, plots
from reports.paper_figure import PaperFigure
from reports.runs import design, scene_job

OPEN, CLOSED = "calibration_open_loop", "calibration_closed_loop"
UNIT_GAIN = (("voltage_gain", 1), ("voltage_gain_high", 1))


def open_jobs():
    return {
        "paper": scene_job(OPEN, "paper"),
        "paper_48v": scene_job(OPEN, "paper", plant="p48"),
        "lever": scene_job(OPEN, "lever"),
    }


def closed_jobs():
    return {
        "unit": scene_job(CLOSED, "paper", sets=UNIT_GAIN, variant="kv1"),
        "paper": scene_job(CLOSED, "paper"),
        "lever": scene_job(CLOSED, "lever"),
    }


def jobs():
    return [*open_jobs().values(), *closed_jobs().values()]


def fitted(axes, x, y, kind, label, marker):
    """Points with the straight line through them, as the paper draws them."""
    a, b = measure.slope(x, y)
    colour = plots.COLOURS[kind]
    axes.plot(x, y, marker, color=colour, markersize=5)
    axes.plot(x, a * x + b, color=colour, linewidth=1.2, label=f"{label}: {a:.4f} Nm/V")
    return a, b


def open_picture(run, title, name, plant_name, png):
    volts = measure.set_values(OPEN, "voltage_setpoint")
    motor = measure.finals(run, "motor_torque_nm", OPEN)
    seen = measure.finals(run, "tau_hat_nm", OPEN)
    quad = measure.finals(run, "quad_tau_hat_nm", OPEN)
    figure, (axes,) = plots.stacked(title, [3.0])
    measured = fitted(axes, volts, motor, "motor", "motor (measured)", "o")
    observed = fitted(axes, volts, seen, "rtl", "observed, RTL", "s")
    axes.plot(volts, quad, "x", color=plots.COLOURS["quad"], markersize=6, label="observed, quad")
    motor_data = measure.plant(plant_name)["motor"]
    dead = motor_data["dead_voltage_v"] + measure.dead_time_v(run.design)
    wide = np.linspace(0, 6, 50)
    ideal = motor_data["torque_constant_nm_a"] / motor_data["resistance_ohm"]
    plots.draw(axes, wide, ideal * np.maximum(wide - dead, 0), "ideal", "ideal: Kt/R (V − losses)")
    for published in (0.072, 0.051):
        plots.draw(axes, wide, published * wide, "paper", "")
        axes.annotate(
            f"paper's slope {published}",
            (wide[-1], published * wide[-1]),
            ha="right",
            va="bottom" if published > 0.06 else "top",
            fontsize=7.5,
            color=plots.COLOURS["paper"],
        )
    axes.set(xlabel="voltage set-point, V", ylabel="torque, Nm", ylim=(0, 0.46))
    axes.legend(loc="upper left", fontsize=7.5)
    return (
        plots.finish(figure, name, png=png),
        measured,
        observed,
        measure.slope(volts, quad),
        ideal,
    )


def figure_7(runs, png=False):
    found = PaperFigure(
        7,
        [
            ("paper", "design paper, 24 V winding"),
            ("paper_48v", "design paper, 48 V winding"),
            ("lever", "design lever, 24 V winding"),
        ],
    )
    titles = dict(found.columns)
    measured, observed, exact, ideal, offset = {}, {}, {}, {}, {}
    for key, job in open_jobs().items():
        if job.name not in runs:
            continue
        plant_name = "p48" if key == "paper_48v" else "p24"
        picture, fit, seen, quad, ideal[key] = open_picture(
            runs[job.name], plots.sentence(titles[key]), f"figure-07-{key}", plant_name, png
        )
        found.pictures.append(picture)
        measured[key], offset[key] = fit
        observed[key], exact[key] = seen[0], quad[0]
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


def torque_picture(key, title, run, png):
    reference, motor, seen, quad, *_ = points(run)
    figure, (torque, error) = plots.stacked(title, [1.7, 1.2])
    torque.plot(reference, motor, "o", color=plots.COLOURS["motor"], label="motor (measured)")
    torque.plot(reference, seen, "s", color=plots.COLOURS["rtl"], label="observed, RTL")
    torque.plot(reference, quad, "x", color=plots.COLOURS["quad"], label="observed, quad")
    plots.draw(torque, reference, reference, "ideal")
    error.bar(reference, 1e3 * (motor - seen), 0.007, color=plots.COLOURS["motor"])
    plots.at_least(error, 4.0)
    error.axhline(0, color=plots.COLOURS["ideal"], linewidth=0.8)
    for axes in (torque, error):
        axes.axvline(0.15, color=plots.COLOURS["paper"], linestyle=":", linewidth=1.1)
    torque.annotate("0.15 Nm", (0.155, 0.02), color=plots.COLOURS["paper"], fontsize=7.5)
    torque.set_ylabel("torque, Nm")
    error.set(ylabel="measured less\nobserved, mNm", xlabel="torque reference, Nm")
    plots.legend(torque, 4)
    return plots.finish(figure, f"figure-10-{key}", png=png)


def border_picture(runs, keys, png):
    """The voltage over the reference: what the border does while the hand pushes deeper."""
    figure, (volts, torque) = plots.stacked("The command over the reference", [1.6, 1.4])
    law, observer = design("paper")["voltage"], design("paper")["observer"]
    wide = np.linspace(0.01, 0.5, 981)
    gain = np.where(wide > law["region_nm"], law["kv_high"], law["kv_low"])
    law_v = gain * wide / observer["torque_constant_nm_a"] + measure.dead_time_v("paper")
    plots.draw(volts, wide, law_v, "ideal", "law of paper")
    for key, kind, marker in (("paper", "paper", "o"), ("lever", "motor", "^")):
        if key not in keys:
            continue
        reference, motor, _, _, command, _ = points(runs[closed_jobs()[key].name])
        for axes, values in ((volts, command), (torque, motor)):
            axes.plot(reference, values, marker, color=plots.COLOURS[kind], label=f"{key}, RTL")
    plots.draw(torque, wide, wide, "ideal")
    for axes in (volts, torque):
        axes.set_xlim(0.0, 0.32)
    volts.set_ylim(0, 6)
    torque.set_ylim(0, 0.36)
    volts.set_ylabel("voltage, V")
    torque.set(ylabel="motor torque, Nm", xlabel="torque reference, Nm")
    plots.legend(volts)
    return plots.finish(figure, "figure-10-border", png=png)


def figure_10(runs, png=False):
    columns = [("unit", "paper, Kv = 1"), ("paper", "paper, Kv 1.25/0.95"), ("lever", "lever")]
    found = PaperFigure(10, columns)
    titles, data = dict(found.columns), {}
    for key, job in closed_jobs().items():
        if job.name in runs:
            data[key] = points(runs[job.name])
            found.pictures.append(
                torque_picture(key, plots.sentence(titles[key]), runs[job.name], png)
            )
    found.pictures.append(border_picture(runs, data, png))
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
