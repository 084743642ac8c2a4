# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Finds the points that no other point beats.

A point beats another when it renders the same scenes, is no worse in any objective and better in
one. Documentation: docs/speed-for-accuracy.md
"""

from exploration import space

# Key of a point's result, what it is, unit of the page, factor to that unit. Less is better.
OBJECTIVES = (
    ("torque_error_rms_nm", "rms torque error", "µNm", 1e6),
    ("lut4_equivalents", "LUT4 equivalents", "", 1),
    ("mult18", "MULT18", "", 1),
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
