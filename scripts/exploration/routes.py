# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Second stage of a sweep: place and route, only for points of the front, as it takes minutes.

Documentation: docs/speed-for-accuracy.md
"""

import json
from pathlib import Path

import outputs
from exploration import chunks, space

FOLDER = "routed"


def path_of(plan, name):
    return plan.folder / FOLDER / f"{name}.json"


def is_done(plan, name, sources):
    return read(plan.folder, sources).get(name) is not None


def run(plan, name, sources):
    """Places and routes one point of the plan; the path of what came out."""
    path = path_of(plan, name)
    point = next((p for p in plan.points if space.point_id(p) == name), None)
    if point is None:
        raise chunks.ChunkError(f"no point {name} in {plan.folder}; points.jsonl has the names")
    if not is_done(plan, name, sources):
        result = chunks.one(chunks.evaluator(), point, plan, route=True)
        path.parent.mkdir(parents=True, exist_ok=True)
        text = space.canonical({"id": name, "sources": sources, "result": result})
        outputs.write_whole(path, text + "\n")
    return path


def read(folder, sources):
    """{id: result} of what has been routed from these sources."""
    found = {}
    for path in sorted((Path(folder) / FOLDER).glob("*.json")):
        row = json.loads(path.read_text(encoding="utf-8"))
        if row["sources"] == sources:
            found[row["id"]] = row["result"]
    return found
