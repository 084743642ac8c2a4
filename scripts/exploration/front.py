# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Finds the points that no other point beats, and three of them that have a name.

A point beats another when it renders the same scenes, is no worse in any objective and better in
one. fast has the shortest delay, and exact the smallest error; balanced lies between them: its distance
from the best of every objective, each on a logarithmic scale from 0 to 1, is the smallest.
Documentation: docs/speed-for-accuracy.md
"""

import math

from exploration import space

OBJECTIVES = ("torque_error_rms_nm", "lut4_equivalents", "mult18", "delay_s")  # less is better
PRESETS = ("fast", "balanced", "exact")
SCENES = "scenes.include"


def good(row):
    """Whether a row is a design with figures: neither refused nor mismatching."""
    return all(row["result"].get(key) is not None for key in OBJECTIVES)


def vector(row):
    return tuple(row["result"][key] for key in OBJECTIVES)


def beats(a, b):
    return a != b and all(x <= y for x, y in zip(a, b, strict=True))


def find(rows):
    """The rows of the front, in their order."""
    rows = [row for row in rows if good(row)]
    kinds = {}
    for row in rows:
        kinds.setdefault(space.canonical(row["set"].get(SCENES)), []).append(vector(row))
    return [
        row
        for row in rows
        if not any(beats(v, vector(row)) for v in kinds[space.canonical(row["set"].get(SCENES))])
    ]


def candidates(rows):
    """The front among designs for use: stable, and with all scenes of the base."""

    def usable(row):
        result = row["result"]
        fit = not result.get("coarse") and result.get("stable", True)
        return fit and SCENES not in row["set"]

    return find([row for row in rows if usable(row)])


def distance(row, rows):
    total = 0.0
    for key in OBJECTIVES:
        values = [math.log(max(1e-12, other["result"][key])) for other in rows]
        if max(values) > min(values):
            value = math.log(max(1e-12, row["result"][key]))
            total += ((value - min(values)) / (max(values) - min(values))) ** 2
    return total


def presets(rows):
    """{name: row} among the candidates."""
    rows = candidates(rows)
    if not rows:
        return {}

    def least(key):
        order = [key, *OBJECTIVES]
        return min(rows, key=lambda row: [row["result"][k] for k in order])

    fast, exact = least("delay_s"), least("torque_error_rms_nm")
    rest = [row for row in rows if row["id"] not in (fast["id"], exact["id"])] or rows
    balanced = min(rest, key=lambda row: (distance(row, rows), row["id"]))
    return dict(zip(PRESETS, (fast, balanced, exact), strict=True))
