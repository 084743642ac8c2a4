# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Figures 14, 16, 17, 19, 21 and 22 of the paper: virtual objects under a moving hand.

Documentation: docs/figures.md, docs/scenes.md
"""

from dataclasses import dataclass

import numpy as np

from reports import objects, plots, run_section
from reports.paper_figure import WORDS, PaperFigure
from reports.runs import ROOT, Job, read_toml, scene_job

MOTIONS = ROOT / "vectors" / "figures"
SHORT = 19  # the figure whose motion RTL and twin run in lock-step, too

ZOOM_S = 0.03


def zoom_window(v):
    """The time in which the ideal torque first passes half its largest size: where it moves."""
    large = np.abs(v.ideal) >= 0.5 * np.abs(v.ideal).max()
    middle = v.time[int(np.argmax(large != large[0]))]
    return middle - ZOOM_S / 2, middle + ZOOM_S / 2


def draw_overview(axes, csv, v, engine):
    """Position, for the damper velocity, commanded and observed torque, over the whole run."""
    time = csv["time_s"]
    plots.draw(axes[0], time, csv["position_rad"], "rtl", engine)
    plots.draw(axes[0], time, csv["theta_rad"], "ideal", "lever")
    axes[0].set_ylabel("position, rad")
    if v.scene == "damper":
        plots.draw(axes[1], time, csv["velocity_rad_s"], "rtl", engine)
        plots.draw(axes[1], time, csv["omega_rad_s"], "ideal", "lever")
        axes[1].set_ylabel("velocity,\nrad/s")
    command, observed = axes[-2:]
    plots.draw(command, time, csv["torque_nm"], "rtl", f"commanded, {engine}")
    plots.draw(command, time, csv["motor_torque_nm"], "motor", zorder=2.5)
    plots.draw(observed, time, csv["tau_hat_nm"], "rtl", f"observed, {engine}")
    for axis in (command, observed):
        plots.draw(axis, v.time, v.ideal, "ideal")


def draw_zoom(axis, csv, v, engine):
    begin, end = zoom_window(v)
    inside = (csv["time_s"] >= begin) & (csv["time_s"] <= end)
    ms = 1e3 * (csv["time_s"][inside] - begin)
    plots.draw(axis, ms, csv["tau_hat_nm"][inside], "rtl", f"observed, {engine}")
    plots.draw(axis, ms, csv["quad_tau_hat_nm"][inside], "quad", "quad")
    plots.draw(axis, ms, csv["motor_torque_nm"][inside], "motor")
    shown = (v.time >= begin) & (v.time <= end)
    plots.draw(axis, 1e3 * (v.time[shown] - begin), v.ideal[shown], "ideal")
    axis.set_xlabel(f"zoom: time from {begin:.3f} s, ms")


def leader(run):
    """The back-end that drove the lever."""
    return "rtl" if "rtl" in run.summary["engines"] else "twin"


def picture(number, run, v, mirrored, caption, png):
    csv, scene, engine = run.csv, v.scene, run_section.ENGINE_NAMES.get(leader(run), leader(run))
    heights = [0.75, 1.05, 1.05, 1.25] if scene != "damper" else [0.75, 0.75, 1.05, 1.05, 1.25]
    moved = ", the paper's motion" if v.of_motion else ""
    title = f"{scene.replace('_', ' ').capitalize()}, design {v.design}{moved}"
    figure, axes = plots.stacked(title, heights, apart=1)
    draw_overview(axes[:-1], csv, v, engine)
    draw_zoom(axes[-1], csv, v, engine)
    sign = "\n(mirrored)" if mirrored else ""
    for axis, name in zip(axes[-3:], ("torque, Nm", "observed, Nm", "torque, Nm"), strict=True):
        axis.set_ylabel(name + sign)
        if mirrored:
            axis.invert_yaxis()
    axes[-2].set_xlabel("time, s")
    for axis in axes:
        plots.legend(axis)
    figure.align_ylabels(axes)
    name = f"figure-{number}-{v.column.replace('_', '-')}"
    return plots.finish(figure, name, caption, png)


@dataclass(frozen=True)
class Spec:
    """A figure of a virtual object, as figures.toml has it."""

    number: int
    scene: str
    mirrored: bool
    motion: str  # of the paper's own motion, "" where the shipped scene has it


SPECS = tuple(
    Spec(int(number), words["scene"], words.get("mirrored", False), words.get("motion", ""))
    for number, words in WORDS.items()
    if "scene" in words
)


def motion_file(spec):
    return MOTIONS / f"figure_{spec.number}.toml"


def motion_job(spec, design_name):
    """A run of the paper's own motion; a long one by the twin, which takes a tenth of the time."""
    path = motion_file(spec)
    arguments = ("run", str(path), "--design", design_name)
    if spec.number != SHORT:
        arguments += ("--engine", "twin,quad")
    seconds = float(read_toml(path)["duration_s"])
    return Job(f"figure_{spec.number}-{design_name}", arguments, seconds, every=50)


def jobs(designs, quick=False):
    """Quick: of the objects on paper only the one that shows its border."""
    found = [
        scene_job(spec.scene, d, every=50)
        for spec in SPECS
        for d in designs
        if d == "lever" or spec.scene == "spring_compression" or not quick
    ]
    moved = [d for d in designs if d == "lever" or not quick]
    return found + [motion_job(spec, d) for spec in SPECS if spec.motion for d in moved]


def views_of(spec, runs, designs):
    """[(run, its view)], for each design our own motion and then the paper's; what did not run is
    left out."""
    found = []
    for d in designs:
        if run := runs.get(scene_job(spec.scene, d).name):
            found.append((run, objects.view(run, spec.scene)))
        if spec.motion and (run := runs.get(f"figure_{spec.number}-{d}")):
            arm_s = read_toml(motion_file(spec))["core"]["arm_s"]
            found.append((run, objects.view(run, spec.scene, f"{d}_motion", arm_s)))
    return found


def figure(spec, runs, designs, png=False):
    columns = [(d, d) for d in designs] + [(f"{d}_motion", f"{d}, its motion") for d in designs]
    found = PaperFigure(spec.number, columns)
    there = views_of(spec, runs, designs)
    for run, v in there:
        ours = "Our own motion." if spec.motion else ""
        caption = spec.motion if v.of_motion else ours
        if leader(run) == "twin":
            caption += " Computed by the RTL's bit-exact twin."
        found.pictures.append(picture(spec.number, run, v, spec.mirrored, caption, png))
    views = [v for _, v in there]
    if spec.motion:
        objects.motion(found, views)
    getattr(objects, spec.scene)(found, views)
    for name in ("tau_hat_nm", "torque_nm"):
        errors = {
            v.column: 1e6 * e["max_error"]
            for r, v in there
            if (e := r.summary["engines"].get(leader(r), {}).get(name))
        }
        found.add(f"{name.removesuffix('_nm')}_max_error_unm", errors)
    return found
