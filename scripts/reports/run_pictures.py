# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Pictures of one run, for report.py and demo.py. Documentation: docs/figures.md"""

import re

import numpy as np

from reports import plots
from reports.run_section import ENGINE_NAMES, closed_loop

QUAD = {"linewidth": 0.6, "alpha": 0.5}  # lets the RTL through where both swing too fast
FELT_S = 1e-3  # as in model/sim/loop/felt.hpp


def time_axis(t):
    """(times, label) in ms for what is short."""
    return (1e3 * t, "time, ms") if t[-1] <= 0.1 else (t, "time, s")


def mark_faults(axes, time, faults):
    """Shades the time in which a fault was latched."""
    if not np.any(faults):
        return
    since, colour = time[np.argmax(faults > 0)], plots.COLOURS["fault"]
    for axis in axes:
        axis.axvspan(since, time[-1], color=colour, alpha=0.08)
    where = ("data", "axes fraction")
    axes[0].annotate("fault latched", (since, 0.9), xycoords=where, color=colour, fontsize=8)


def lead(summary):
    """The back-end whose signals have no name before them: the one that drives the motor."""
    name = next(iter(summary["engines"]), "rtl")
    return ENGINE_NAMES.get(name, name)


def exact(summary, csv, signal):
    """Values of the back-end that the others are compared with; None where there is none."""
    return csv.get(f"{summary.get('reference')}_{signal}")


def draw_exact(axes, time, summary, csv, signal):
    values = exact(summary, csv, signal)
    if values is not None:
        plots.draw(axes, time, values, "quad", f"{summary['reference']} reference", **QUAD)


def motion_picture(name, summary, csv):
    time, label = time_axis(csv["time_s"])
    figure, (position, velocity) = plots.stacked("Motion", [1.5, 1.5])
    plots.draw(position, time, csv["position_rad"], "rtl", lead(summary))
    if closed_loop(summary):
        plots.draw(position, time, csv["theta_rad"], "ideal", "lever of the plant")
        plots.draw(velocity, time, csv["omega_rad_s"], "ideal", "lever of the plant")
    plots.draw(velocity, time, csv["velocity_rad_s"], "rtl", lead(summary))
    draw_exact(velocity, time, summary, csv, "velocity_rad_s")
    position.set_ylabel("position, rad")
    velocity.set(ylabel="velocity, rad/s", xlabel=label)
    plots.at_least(position, 0.005)
    plots.at_least(velocity, 0.05)
    plots.legend(position)
    plots.legend(velocity)
    mark_faults([position, velocity], time, csv["faults"])
    return plots.finish(figure, f"{name}-motion")


def torque_picture(name, summary, csv):
    time, label = time_axis(csv["time_s"])
    figure, (command, observed) = plots.stacked("Torque", [1.5, 1.5])
    plots.draw(command, time, csv["tau_ref_nm"], "reference", "asked for by the scene")
    plots.draw(command, time, csv["torque_nm"], "rtl", f"commanded, {lead(summary)}")
    draw_exact(command, time, summary, csv, "torque_nm")
    if closed_loop(summary):
        plots.draw(command, time, csv["motor_torque_nm"], "motor")
    plots.draw(observed, time, csv["tau_hat_nm"], "rtl", f"observed, {lead(summary)}")
    draw_exact(observed, time, summary, csv, "tau_hat_nm")
    command.set_ylabel("torque, Nm")
    observed.set(ylabel="observed, Nm", xlabel=label)
    for axes in (command, observed):
        plots.at_least(axes, 0.01)
        plots.legend(axes)
    mark_faults([command, observed], time, csv["faults"])
    return plots.finish(figure, f"{name}-torque")


def felt_rows(csv):
    """(position, hand's torque, torque asked for) of each FELT_S of a run: a hand does not feel
    apart what is shorter. Rows that lie further apart are taken as they are."""
    window = np.floor(csv["time_s"] / FELT_S + 1e-6)
    first = np.flatnonzero(np.diff(window, prepend=-1.0))  # row of each window
    rows = np.diff(first, append=len(window))
    if rows.max() < 2:
        return csv["theta_rad"], csv["hand_felt_nm"], csv["tau_ref_nm"]
    position, asked = (
        (np.add.reduceat(csv[c], first) / rows)[:-1] for c in ("theta_rad", "tau_ref_nm")
    )
    return position, csv["hand_felt_nm"][first[1:]], asked


def loop_picture(name, csv):
    """What the hand feels over where it is: a spring is a line, friction and damping an area."""
    figure, (axes,) = plots.stacked("What the hand meets", [2.9])
    position, hand, asked = felt_rows(csv)
    plots.draw(axes, position, hand, "hand", "hand on the lever, means over 1 ms")
    plots.draw(axes, position, -asked, "ideal", "against the torque reference")
    axes.set(xlabel="position, rad", ylabel="torque, Nm")
    plots.legend(axes)
    return plots.finish(figure, f"{name}-loop")


AXES = ("motor", "quad", "paper")  # the colours of joints


def joints_picture(name, csv):
    """Angles and motors of a device of several axes over time."""
    time, label = time_axis(csv["time_s"])
    figure, (angle, torque) = plots.stacked("Joints and motors", [1.5, 1.5])
    numbers = [column.rpartition(".")[2] for column in csv if column.startswith("theta_rad.")]
    for number, kind in zip(numbers, AXES):
        look = {"linewidth": 1.1, "linestyle": "-"}
        plots.draw(angle, time, csv[f"theta_rad.{number}"], kind, f"axis {number}", **look)
        plots.draw(torque, time, csv[f"motor_torque_nm.{number}"], kind, "", **look)
    angle.set_ylabel("angle, rad")
    torque.set(ylabel="torque, Nm", xlabel=label)
    plots.legend(angle)
    return plots.finish(figure, f"{name}-joints")


def pen_picture(name, csv):
    """The way of a pen in the two directions in which it moved most, and the force that the hand feels."""
    x, y = sorted(sorted("xyz", key=lambda a: -np.ptp(csv.get(f"pen_{a}_m", np.zeros(1))))[:2])
    figure, (axes,) = plots.stacked("Way of the pen, force on it", [2.9])
    way = [1e3 * csv[f"pen_{a}_m"] for a in (x, y)]
    axes.plot(*way, color=plots.COLOURS["ideal"], linewidth=1.2)
    rows = np.unique(np.linspace(0, len(way[0]) - 1, 60).round().astype(int))
    force = [-csv[f"hand_{a}_n"][rows] for a in (x, y)]
    most = max(float(np.hypot(*force).max()), 1e-9)
    arrows = axes.quiver(*(w[rows] for w in way), *force, angles="xy", color=plots.COLOURS["motor"],
                         scale=8 * most, width=0.003)
    axes.quiverkey(arrows, 0.9, 1.05, most, f"{most:.2g} N", labelpos="W")
    axes.set(xlabel=f"{x}, mm", ylabel=f"{y}, mm")
    axes.axis("equal")
    return plots.finish(figure, f"{name}-pen")


def axes_pictures(name, csv):
    """Of a run of several axes."""
    moved = "pen_x_m" in csv and sorted(np.ptp(csv[c]) for c in csv if re.fullmatch("pen_._m", c))[-2] > 1e-3
    return [joints_picture(name, csv)] + ([pen_picture(name, csv)] if moved else [])


def pictures(name, summary, csv):
    """As many as the run has to show."""
    drawn = [motion_picture(name, summary, csv)]
    if any(np.any(csv[column]) for column in ("tau_ref_nm", "tau_hat_nm", "current_a")):
        drawn.append(torque_picture(name, summary, csv))
    if closed_loop(summary) and np.ptp(csv["theta_rad"]) > 0.02:
        drawn.append(loop_picture(name, csv))
    return drawn
