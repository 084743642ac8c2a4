# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Pictures and tables of one run, for report.py and demo.py. Documentation: docs/figures.md"""

import numpy as np

from reporting import page, plots
from reporting.runs import design

ENGINES = ("rtl", "twin", "double", "quad")
QUAD = {"linewidth": 0.6, "alpha": 0.5}  # lets the RTL through where both swing too fast


def lsb(design_name, signal):
    """Unit of the last place of a signal of a design, in its SI unit."""
    try:
        return 2.0 ** -design(design_name)["formats"][signal][2]
    except (OSError, KeyError):
        return {"velocity": 2.0**-21, "torque": 2.0**-16, "current": 2.0**-16}[signal]


def torque_constant(design_name):
    try:
        return float(design(design_name)["observer"]["torque_constant_nm_a"])
    except (OSError, KeyError):
        return None


def time_axis(t):
    """(times, label) in ms for what is short."""
    return (1e3 * t, "time, ms") if t[-1] <= 0.1 else (t, "time, s")


def closed_loop(summary):
    return "scene" in summary


def mark_faults(axes, time, faults):
    """Shades the time in which a fault was latched."""
    if not np.any(faults):
        return
    since, colour = time[np.argmax(faults > 0)], plots.COLOURS["fault"]
    for axis in axes:
        axis.axvspan(since, time[-1], color=colour, alpha=0.08)
    where = ("data", "axes fraction")
    axes[0].annotate("fault latched", (since, 0.9), xycoords=where, color=colour, fontsize=8)


def motion_picture(name, summary, csv):
    time, label = time_axis(csv["time_s"])
    figure, (position, velocity) = plots.stacked("Motion", [1.5, 1.5])
    plots.draw(position, time, csv["position_rad"], "rtl")
    if closed_loop(summary):
        plots.draw(position, time, csv["theta_rad"], "ideal", "lever of the plant")
        plots.draw(velocity, time, csv["omega_rad_s"], "ideal", "lever of the plant")
    plots.draw(velocity, time, csv["velocity_rad_s"], "rtl")
    plots.draw(velocity, time, csv["quad_velocity_rad_s"], "quad", **QUAD)
    position.set_ylabel("position, rad")
    velocity.set_ylabel("velocity, rad/s")
    velocity.set_xlabel(label)
    plots.at_least(position, 0.005)
    plots.at_least(velocity, 0.05)
    plots.legend(position)
    plots.legend(velocity)
    mark_faults([position, velocity], time, csv["faults"])
    return plots.finish(figure, f"{name}-motion")


def torque_picture(name, summary, csv):
    time, label = time_axis(csv["time_s"])
    figure, (command, observed) = plots.stacked("Torque", [1.5, 1.5])
    plots.draw(command, time, csv["tau_ref_nm"], "reference", "reference")
    constant = torque_constant(summary["design"])
    if constant:
        plots.draw(command, time, constant * csv["current_a"], "rtl", "commanded, RTL")
        plots.draw(command, time, constant * csv["quad_current_a"], "quad", **QUAD)
    if closed_loop(summary):
        plots.draw(command, time, csv["motor_torque_nm"], "motor")
    plots.draw(observed, time, csv["tau_hat_nm"], "rtl", "observed, RTL")
    plots.draw(observed, time, csv["quad_tau_hat_nm"], "quad", **QUAD)
    command.set_ylabel("torque, Nm")
    observed.set_ylabel("observed, Nm")
    observed.set_xlabel(label)
    for axes in (command, observed):
        plots.at_least(axes, 0.01)
        plots.legend(axes)
    mark_faults([command, observed], time, csv["faults"])
    return plots.finish(figure, f"{name}-torque")


def difference_picture(name, summary, csv):
    """RTL minus quad on the same counts, in units of the last place."""
    time, label = time_axis(csv["time_s"])
    figure, axes = plots.stacked("RTL minus quad reference, in units of the last place", [0.9] * 3)
    rows = (
        ("velocity", csv["velocity_rad_s"] - csv["quad_velocity_rad_s"]),
        ("torque", csv["tau_hat_nm"] - csv["quad_tau_hat_nm"]),
        ("current", csv["current_a"] - csv["quad_current_a"]),
    )
    for axis, (signal, error) in zip(axes, rows, strict=True):
        unit = lsb(summary["design"], signal)
        plots.draw(axis, time, error / unit, "rtl", "", linewidth=0.7, color="#2f7fb8")
        axis.set_ylabel({"torque": "observed\ntorque"}.get(signal, signal))
        plots.at_least(axis, 2.0)
        si = {"velocity": "rad/s", "torque": "Nm", "current": "A"}[signal]
        place = f"1 = 2^{round(np.log2(unit))} {si}"
        axis.set_title(place, loc="right", fontsize=7.5, color="#5a6570")
    axes[-1].set_xlabel(label)
    return plots.finish(figure, f"{name}-difference")


def loop_picture(name, csv):
    """What the hand feels over where it is: a spring is a line, friction and damping an area."""
    figure, (axes,) = plots.stacked("What the hand meets", [2.9])
    position = csv["theta_rad"]
    armed = csv["time_s"] > 0
    plots.draw(axes, position[armed], csv["hand_torque_nm"][armed], "hand", "hand on the lever")
    plots.draw(axes, position, -csv["tau_ref_nm"], "ideal", "against the torque reference")
    axes.set_xlabel("position, rad")
    axes.set_ylabel("torque, Nm")
    plots.legend(axes)
    return plots.finish(figure, f"{name}-loop")


def pictures(name, summary, csv):
    drawn = [motion_picture(name, summary, csv)]
    if any(np.any(csv[column]) for column in ("tau_ref_nm", "tau_hat_nm", "current_a")):
        drawn.append(torque_picture(name, summary, csv))
    if closed_loop(summary) and np.ptp(csv["theta_rad"]) > 0.02:
        drawn.append(loop_picture(name, csv))
    if np.any(csv["quad_velocity_rad_s"]) or np.any(csv["quad_tau_hat_nm"]):
        drawn.append(difference_picture(name, summary, csv))
    return drawn


def subject(summary):
    return summary.get("scene") or summary.get("trace") or "run"


def facts(summary):
    """What ran, as a list of lines."""
    kind = "scene" if closed_loop(summary) else "recording"
    lines = [f"{kind} {subject(summary)} on design {summary['design']}"]
    if "plant" in summary:
        lines[0] += f", plant {summary['plant']}"
    if summary.get("probes"):
        probes = summary["probes"]
        lines.append(f"probes: {probes if isinstance(probes, str) else ', '.join(probes)}")
    lines.append(
        f"{page.number(summary['simulated_s'])} s of device time: {summary['clocks']:,} clocks, "
        f"{summary['ticks']:,} ticks"
    )
    p = summary["position"]
    lines.append(
        f"encoder: {p['steps']:,} steps, {p['illegal']:,} illegal, {p['reversals']:,} reversals"
    )
    return lines


def error_cells(engine, key, scale):
    """Largest and rms error, in units of 1/scale."""
    errors = engine.get(key, {})
    return [
        page.number(scale * errors[kind]) if kind in errors else "–"
        for kind in ("max_error", "rms_error")
    ]


def engine_table(summary):
    head = [
        "engine",
        "velocity, max µrad/s",
        "rms",
        "observed torque, max µNm",
        "rms",
        "torque, max µNm",
        "rms",
        "saturated ticks",
        "speed, s/s",
    ]
    rows = []
    for name in ENGINES:
        engine = summary["engines"].get(name)
        if engine is None:
            continue
        rows.append(
            [name]
            + error_cells(engine, "velocity_rad_s", 1e6)
            + error_cells(engine, "tau_hat_nm", 1e6)
            + error_cells(engine, "torque_nm", 1e6)
            + [f"{engine['saturations']:,}" if "saturations" in engine else "–"]
            + [page.number(engine.get("speed"))]
        )
    return page.table(head, rows)


def steps_of(summary):
    """Step responses of the engine that drove the motor."""
    for name in ENGINES:
        steps = summary["engines"].get(name, {}).get("step_responses")
        if steps:
            return steps
    return []


STEP_KEYS = (
    ("step to, Nm", "tau_ref_nm"),
    ("motor settles, ms", "torque_settling_ms"),
    ("observer settles, ms", "tau_hat_settling_ms"),
    ("overshoot, %", "overshoot_pct"),
    ("final error, %", "final_error_pct"),
    ("observer's final error, %", "tau_hat_final_error_pct"),
)


def step_table(summary):
    rows = [[page.number(step.get(key)) for _, key in STEP_KEYS] for step in steps_of(summary)]
    return page.table([title for title, _ in STEP_KEYS], rows)


def faults_of(summary):
    """Everything that makes a run wrong, one line each."""
    count = summary.get("mismatches", 0)
    texts = [f"{count:,} mismatches"] if count else []
    if "first_mismatch" in summary:
        texts[-1:] = [f"{count:,} mismatches, the first: {summary['first_mismatch']}"]
    texts += summary.get("expectations", {}).get("broken", [])
    return [f"{subject(summary)}, {summary['design']}: {text}" for text in texts]


def inside(summary, drawn):
    """The section's body: facts, tables, pictures."""
    parts = [page.bullets(facts(summary)), page.pictures(drawn), engine_table(summary)]
    steps = step_table(summary)
    if steps:
        parts.append("<h3>Torque steps</h3>" + steps)
    return "\n".join(parts)
