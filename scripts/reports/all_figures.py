# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""All figures of the paper that are redrawn, for figures.py and demo.py."""

from concurrent.futures import ProcessPoolExecutor
from functools import partial

from reports import paper_pictures, scene_figures, step_figures


def jobs(designs, quick=False):
    """What the figures need. Quick: of the objects on paper only the one that shows its border."""
    chosen = step_figures.jobs(designs) + scene_figures.jobs(designs, quick)
    return [job for job in chosen if job.design in designs]


def draw_one(number, runs, designs, png):
    def find(job):
        return runs.get(job.name)

    if number == 7:
        figure = step_figures.figure_7(find)
    elif number == 10:
        figure = step_figures.figure_10(find)
    elif number == 11:
        figure = step_figures.figure_11(find, designs)
    else:
        figure = scene_figures.figure(number, find, designs)
    figure.pictures.append(paper_pictures.draw(number, find, png))
    return figure


def draw(runs, designs, png=False):
    """Figures in the paper's order, from the runs that came to an end."""
    there = {name: run for name, run in runs.items() if run.ran}
    with ProcessPoolExecutor() as pool:
        return list(pool.map(partial(draw_one, runs=there, designs=designs, png=png), paper_pictures.NUMBERS))
