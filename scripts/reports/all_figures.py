# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""All figures of the paper that are redrawn, for figures.py and demo.py."""

from concurrent.futures import ProcessPoolExecutor

from reports import calibrations, scene_figures, step_figure


def jobs(designs, quick=False):
    """What the figures need. Quick: of the objects on paper only the one that shows its border."""
    chosen = calibrations.jobs() + step_figure.jobs(designs)
    chosen += scene_figures.jobs(designs, quick)
    return [job for job in chosen if job.arguments[job.arguments.index("--design") + 1] in designs]


def draw_one(number, runs, designs, png):
    if number == 7:
        return calibrations.figure_7(runs, png)
    if number == 10:
        return calibrations.figure_10(runs, png)
    if number == 11:
        return step_figure.figure_11(runs, designs, png)
    spec = next(s for s in scene_figures.SPECS if s.number == number)
    return scene_figures.figure(spec, runs, designs, png)


NUMBERS = (7, 10, 11, *(spec.number for spec in scene_figures.SPECS))


def draw(runs, designs, png=False):
    """Figures in the paper's order, from the runs that came to an end."""
    there = {name: run for name, run in runs.items() if run.ran}
    with ProcessPoolExecutor() as pool:
        return [f.result() for f in [pool.submit(draw_one, n, there, designs, png) for n in NUMBERS]]
