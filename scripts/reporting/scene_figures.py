# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Figures 14, 16, 17, 19, 21 and 22 of the paper: virtual objects under a moving hand.

Documentation: docs/figures.md, docs/scenes.md
"""

from dataclasses import dataclass

import numpy as np

from reporting import objects, plots
from reporting.paper_figure import PaperFigure
from reporting.runs import scene_job

ZOOM_S = 0.03


def zoom_window(v):
    """The time in which the ideal torque first reaches half its largest size: where it moves."""
    size = np.abs(v.ideal)
    middle = v.time[int(np.argmax(size >= 0.5 * size.max()))]
    return middle - ZOOM_S / 2, middle + ZOOM_S / 2


def draw_overview(axes, csv, v):
    """Position, for the damper velocity, commanded and observed torque, over the whole run."""
    time = csv["time_s"]
    plots.draw(axes[0], time, csv["position_rad"], "rtl")
    plots.draw(axes[0], time, csv["theta_rad"], "ideal", "lever")
    axes[0].set_ylabel("position, rad")
    if v.scene == "damper":
        plots.draw(axes[1], time, csv["velocity_rad_s"], "rtl")
        plots.draw(axes[1], time, csv["omega_rad_s"], "ideal", "lever")
        axes[1].set_ylabel("velocity,\nrad/s")
    command, observed = axes[-2:]
    plots.draw(command, time, csv["torque_nm"], "rtl", "commanded, RTL")
    plots.draw(command, time, csv["motor_torque_nm"], "motor", zorder=2.5)
    plots.draw(observed, time, csv["tau_hat_nm"], "rtl", "observed, RTL")
    for axis in (command, observed):
        plots.draw(axis, v.time, v.ideal, "ideal")


def draw_zoom(axis, csv, v):
    begin, end = zoom_window(v)
    inside = (csv["time_s"] >= begin) & (csv["time_s"] <= end)
    ms = 1e3 * (csv["time_s"][inside] - begin)
    plots.draw(axis, ms, csv["tau_hat_nm"][inside], "rtl", "observed, RTL")
    plots.draw(axis, ms, csv["quad_tau_hat_nm"][inside], "quad", "quad")
    plots.draw(axis, ms, csv["motor_torque_nm"][inside], "motor")
    shown = (v.time >= begin) & (v.time <= end)
    plots.draw(axis, 1e3 * (v.time[shown] - begin), v.ideal[shown], "ideal")
    axis.set_xlabel(f"zoom: time from {begin:.3f} s, ms")


def picture(number, run, scene, mirrored, png):
    csv, v = run.csv, objects.view(run, scene)
    heights = [0.75, 1.05, 1.05, 1.25] if scene != "damper" else [0.75, 0.75, 1.05, 1.05, 1.25]
    title = f"{scene.replace('_', ' ').capitalize()}, design {v.design}"
    figure, axes = plots.stacked(title, heights, apart=1)
    draw_overview(axes[:-1], csv, v)
    draw_zoom(axes[-1], csv, v)
    sign = "\n(mirrored)" if mirrored else ""
    for axis, name in zip(axes[-3:], ("torque, Nm", "observed, Nm", "torque, Nm"), strict=True):
        axis.set_ylabel(name + sign)
        if mirrored:
            axis.invert_yaxis()
    axes[-2].set_xlabel("time, s")
    for axis in axes:
        plots.legend(axis)
    figure.align_ylabels(axes)
    return plots.finish(figure, f"figure-{number}-{v.design}", png=png)


@dataclass(frozen=True)
class Spec:
    number: int
    scene: str
    title: str
    said: str
    fill: object
    mirrored: bool = False


SPECS = (
    Spec(
        14,
        "membrane",
        "virtual membrane",
        "between 0.7 and 0.5 rad the torque is constant, −0.5 Nm; outside it is 0.",
        objects.membrane,
        True,
    ),
    Spec(
        16,
        "spring_compression",
        "compression spring",
        "touched at 0.5 rad, fully compressed at 0, where the force is greatest; a small vibration "
        "in the zoom, perhaps from the experimental setup.",
        objects.spring_compression,
    ),
    Spec(
        17,
        "spring_tension",
        "tension spring",
        "pulled from 0 to about 3 rad; the torque reaches its limit of 0.5 Nm at 1 rad; a small "
        "vibration, not perceptible.",
        objects.spring_tension,
    ),
    Spec(
        19,
        "damper",
        "viscous damper",
        "moved fast from 0 to about 0.1 rad; the torque rises to 0.13 Nm in proportion to the "
        "velocity.",
        objects.damper,
    ),
    Spec(
        21,
        "charge_attract",
        "attracting charges",
        "from 4.5 rad towards 0 the torque grows “exponentially in a positive direction”.",
        objects.attract,
        True,
    ),
    Spec(
        22,
        "charge_repel",
        "repelling charges",
        "from −0.5 Nm at 0 rad the torque decreases “exponentially in magnitude” as the lever "
        "moves away; vibrations small enough for the classroom.",
        objects.repel,
        True,
    ),
)


def jobs(designs, quick=False):
    return [
        scene_job(spec.scene, d, every=50)
        for spec in SPECS
        for d in designs
        if d == "lever" or spec.scene == "spring_compression" or not quick
    ]


def figure(spec, runs, designs, png=False):
    found = PaperFigure(spec.number, spec.title, spec.said, [(d, d) for d in designs])
    there = [runs[n] for d in designs if (n := scene_job(spec.scene, d).name) in runs]
    found.pictures = [picture(spec.number, run, spec.scene, spec.mirrored, png) for run in there]
    views = [objects.view(run, spec.scene) for run in there]
    spec.fill(found, views)
    for name, key in (("tau_hat_nm", "observed torque"), ("torque_nm", "commanded torque")):
        errors = {
            r.design: 1e6 * e["max_error"]
            for r in there
            if (e := r.summary["engines"].get("rtl", {}).get(name))
        }
        stem = name.removesuffix("_nm")
        found.add(f"{stem}_max_error_unm", f"{key}, RTL less quad, largest, µNm", "", **errors)
    return found
