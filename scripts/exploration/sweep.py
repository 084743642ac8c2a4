# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A sweep: every point of a space is evaluated by a process of its own, which leaves the result in a file of
the sweep's folder. So a sweep that was stopped goes on.

Documentation: docs/speed-for-accuracy.md
"""

import hashlib
import importlib
import json
import os
import sys
from dataclasses import dataclass
from pathlib import Path

import interrupts
import outputs
from command_line import Refused
from crew import Crew
from exploration import space

SCRIPT = Path(__file__).resolve().parents[1] / "explore.py"
EVALUATOR = "FELTGATE_EXPLORE_POINT"  # tests put their own module here
MEASURED, ROUTED = "measured", "routed"  # folders of results: with place and route, and without
# What decides a point's figures: a change of these makes results of before stale.
SOURCES = (
    *("rtl/core/**/*.sv", "rtl/*.f", "rtl/*.toml", "vectors/plants/linear.toml"),
    *("model/include/feltgate/*.hpp", "model/sim/reference/*"),
    *("model/studies/explore/*", "model/design/*", "scripts/exploration/point*.py"),
)


class SweepError(Refused):
    """An evaluation that failed, or a table that cannot be used."""


@dataclass(frozen=True)
class Sweep:
    folder: Path
    sources: str

    def result(self, point, kind=MEASURED):
        """What was measured of a point, or None: it was not, or of other sources."""
        path = self.folder / kind / f"{space.point_id(point)}.json"
        found = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        return found.get("result") if found.get("sources") == self.sources else None


def start(root, found, folder):
    """The sweep of a Space in a folder."""
    folder = Path(folder).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    return Sweep(folder, sources_digest(root, found.base))


def sources_digest(root, base):
    """Of everything that decides the figures of a point."""
    digest = hashlib.sha256()
    paths = [space.design_path(root, base)]
    for pattern in SOURCES:
        paths += [p for p in Path(root).glob(pattern) if "/generated/" not in str(p)]
    for path in sorted(set(paths)):
        digest.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def spread(points):
    """The first point of each structure, which builds it, before the second ones, and so on."""
    seen, ranks = {}, {}
    for point in points:
        key = space.structure(point)
        ranks[space.point_id(point)] = seen[key] = seen.get(key, -1) + 1
    return sorted(points, key=lambda point: ranks[space.point_id(point)])


def run(sweep, points, jobs, kind=MEASURED):
    """Evaluates the points that have no result yet, `jobs` at a time."""
    crew = Crew()

    def one(point):
        words = ("worker", sweep.folder, kind, sweep.sources, space.canonical(point))
        done = crew.run([sys.executable, "-B", SCRIPT, *map(str, words)], **interrupts.CAPTURED)
        if done.returncode:
            said = done.stderr.strip().removeprefix("explore: ")
            raise SweepError(said or f"point {space.point_id(point)}: {interrupts.how_it_ended(done.returncode)}")

    missing = [point for point in points if sweep.result(point, kind) is None]
    crew.counted(f"explore, {kind}", one, spread(missing), jobs or os.cpu_count() or 1, lambda *_: "")


def worker(folder, kind, sources, text):
    """Evaluates one point and writes its result. SweepError names the point."""
    point = json.loads(text)
    evaluate = importlib.import_module(os.environ.get(EVALUATOR, "exploration.point")).evaluate
    try:
        result = evaluate(point, Path(folder) / "work", route=kind == ROUTED)
    except Exception as error:  # whatever it is, the point must be named
        changed = space.canonical(point["set"])
        raise SweepError(f"point {changed} of {point['base']}: {type(error).__name__}: {error}") from error
    result.pop("structure", None)  # names a folder of this machine
    path = Path(folder) / kind / f"{space.point_id(point)}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    outputs.write_whole(path, space.canonical({"sources": sources, "result": result}) + "\n")
    return 0
