# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Rows of figures 14, 16, 17, 19, 21 and 22 of the paper: virtual objects under a moving hand.

Documentation: docs/figures.md, docs/scenes.md
"""

from reports import objects
from reports.paper_figure import PaperFigure
from reports.paper_pictures import OBJECTS, motion_file, motion_job
from reports.runs import read_toml, scene_job


def jobs(designs, quick=False):
    """Quick: of the objects on paper only the one that shows its border."""
    found = [
        scene_job(words["scene"], d, every=50)
        for words in OBJECTS.values()
        for d in designs
        if d == "lever" or words["scene"] == "spring_compression" or not quick
    ]
    moved = [d for d in designs if d == "lever" or not quick]
    return found + [motion_job(n, d) for n, words in OBJECTS.items() if words.get("motion") for d in moved]


def views_of(number, find, designs):
    """[(run, its view)], for each design our own motion and then the paper's; what did not run is left out."""
    found, words = [], OBJECTS[number]
    for d in designs:
        if run := find(scene_job(words["scene"], d)):
            found.append((run, objects.view(run, words["scene"])))
        if words.get("motion") and (run := find(motion_job(number, d))):
            arm_s = read_toml(motion_file(number))["core"]["arm_s"]
            found.append((run, objects.view(run, words["scene"], f"{d}_motion", arm_s)))
    return found


def figure(number, find, designs):
    columns = [(d, d) for d in designs] + [(f"{d}_motion", f"{d}, its motion") for d in designs]
    found = PaperFigure(number, columns)
    there = views_of(number, find, designs)
    views = [v for _, v in there]
    if OBJECTS[number].get("motion"):
        objects.motion(found, views)
    getattr(objects, OBJECTS[number]["scene"])(found, views)
    for name in ("tau_hat_nm", "torque_nm"):
        errors = {}
        for run, v in there:
            engines = run.summary["engines"]
            if error := (engines.get("rtl") or engines["twin"]).get(name):
                errors[v.column] = 1e6 * error["max_error"]
        found.add(f"{name.removesuffix('_nm')}_max_error_unm", errors)
    return found
