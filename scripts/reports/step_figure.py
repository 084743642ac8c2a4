# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Figure 11 of the paper: torque steps, shaft locked and against a cord.

Documentation: docs/figures.md
"""

import numpy as np

from reports import measure, plots
from reports.paper_figure import PaperFigure
from reports.run_section import steps_of
from reports.runs import scene_job

SCENES = {"torque_step": "shaft locked", "torque_step_cord": "against a cord"}
SPAN_MS = (-2, 30)


def jobs(designs):
    return [scene_job(scene, d, every=20) for d in designs for scene in SCENES]


def picture(run, scene, design_name, png):
    figure, axes = plots.stacked(f"Design {design_name}, {SCENES[scene]}", [1.25] * 3)
    pole = measure.observer_pole(design_name)
    csv = run.csv
    for axis, (begin, _, event) in zip(axes, measure.steps(scene), strict=True):
        ms = 1e3 * (csv["time_s"] - begin)
        shown = (ms >= SPAN_MS[0]) & (ms <= SPAN_MS[1])
        ms, goal = ms[shown], event["step_nm"]
        plots.draw(axis, ms, csv["motor_torque_nm"][shown], "motor")
        plots.draw(axis, ms, csv["tau_hat_nm"][shown], "rtl", "observed, RTL")
        plots.draw(axis, ms, csv["quad_tau_hat_nm"][shown], "quad", "quad")
        ideal = np.where(ms > 0, goal * (1 - np.exp(-pole * 1e-3 * np.maximum(ms, 0))), 0)
        plots.draw(axis, ms, ideal, "ideal", f"1 - exp(-{pole:.4g} t)")
        axis.axhline(goal, color=plots.COLOURS["reference"], linewidth=1.0)
        axis.set_ylabel("torque, Nm")
        axis.set_title(f"{goal} Nm", loc="left", fontsize=8.5)
        low, high = axis.get_ylim()
        axis.set_ylim(min(low, -0.1 * goal), max(high, 1.15 * goal))
    axes[-1].set_xlabel("time after the step, ms")
    plots.legend(axes[0], 4)
    name = f"figure-11-{design_name}-{'cord' if scene.endswith('cord') else 'locked'}"
    return plots.finish(figure, name, png=png)


def figure_11(runs, designs, png=False):
    found = PaperFigure(
        11,
        [
            (f"{d}_{s}", f"{d}, {'cord' if s.endswith('cord') else 'locked'}")
            for d in designs
            for s in SCENES
        ],
    )
    steps, spikes = {}, {}
    for design_name in designs:
        for scene in SCENES:
            run = runs.get(scene_job(scene, design_name).name)
            if run is None:
                continue
            key = f"{design_name}_{scene}"
            found.pictures.append(picture(run, scene, design_name, png))
            steps[key] = steps_of(run.summary)
            spikes[key] = 1e3 * spike(run, scene)
    kinds = ("tau_hat_settling_ms", "torque_settling_ms", "final_error_pct")
    for key in (*kinds, "tau_hat_final_error_pct"):
        stem, unit = key.rsplit("_", 1)
        for i, (_, _, event) in enumerate(measure.steps("torque_step")):
            there = {run: of[i].get(key) for run, of in steps.items() if i < len(of)}
            goal = event["step_nm"]
            found.add(f"{stem}_at_{goal}_nm_{unit}", there, key, (goal, ""))
    found.add("observed_spike_mnm", spikes)
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
