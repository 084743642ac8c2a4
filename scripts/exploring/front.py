# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Which points nobody beats, and the three of them that are worth a name.

A point beats another when it renders the same scenes, is no worse in any objective and better in
one. Documentation: docs/explore.md
"""

import math

from exploring import space

# Key of a point's result, what it is, unit of the page, factor to that unit. Less is better.
OBJECTIVES = (
    ("torque_error_max_nm", "worst torque error", "µNm", 1e6),
    ("lut4_equivalents", "LUT4 equivalents", "", 1),
    ("delay_s", "estimator delay", "ms", 1e3),
)
SCENES = "scenes.include"


def good(row):
    """Whether a row of points.jsonl is a design with figures: neither refused nor mismatching."""
    return all(row["result"].get(key) is not None for key, *_ in OBJECTIVES)


def vector(row):
    return tuple(row["result"][key] for key, *_ in OBJECTIVES)


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
    """Rows of the front that may be named: all scenes of the base, and a design that is shipped."""
    return [
        row
        for row in find(rows)
        if SCENES not in row["set"] and row["result"].get("shippable", True)
    ]


def knee_distance(row, rows):
    """How far from the best of every objective, each on a logarithmic scale from 0 to 1."""
    total = 0.0
    for index, value in enumerate(vector(row)):
        values = [vector(other)[index] for other in rows]
        low, high = (math.log(max(v, 1e-12)) for v in (min(values), max(values)))
        if high > low:
            total += ((math.log(max(value, 1e-12)) - low) / (high - low)) ** 2
    return total


def presets(rows):
    """{name: row}: the shortest delay, the smallest error, and the one between."""
    if not rows:
        return {}

    def least(key, among):
        order = [key, *(k for k, *_ in OBJECTIVES)]
        return min(among, key=lambda row: [row["result"][k] for k in order])

    chosen = {"fast": least("delay_s", rows), "exact": least("torque_error_max_nm", rows)}
    rest = [row for row in rows if row["id"] not in {c["id"] for c in chosen.values()}] or rows
    chosen["balanced"] = min(rest, key=lambda row: (knee_distance(row, rows), row["id"]))
    return chosen
