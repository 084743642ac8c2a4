# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A sweep: every point of a space is evaluated by a process of its own, which leaves the result in a file of
the sweep's folder. So a sweep that was stopped goes on, and machines that share the folder can each take a part.

Documentation: docs/speed-for-accuracy.md
"""

import hashlib
import importlib
import json
import os
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import interrupts
import outputs
from command_line import Refused
from crew import Crew
from exploration import space

SCHEMA = "feltgate-explore-plan/1"
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
    """An evaluation that failed, or a folder of another sweep."""


@dataclass(frozen=True)
class Sweep:
    folder: Path
    name: str
    description: str
    points: tuple = ()
    sources: str = ""

    def result(self, point, kind=MEASURED):
        """What was measured of a point, or None: it was not, or of other sources."""
        path = self.folder / kind / f"{space.point_id(point)}.json"
        found = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        return found.get("result") if found.get("sources") == self.sources else None

    def part(self, index, count):
        """The points of part `index` of `count`, from 1: those of one structure are together."""
        groups = {}
        for point in self.points:
            groups.setdefault(space.structure(point), []).append(point)
        return [p for number, group in enumerate(groups.values()) if number % count == index - 1 for p in group]


def start(root, found, folder):
    """The sweep of a Space in a folder, in which no other one is."""
    folder = Path(folder).resolve()
    head = {"schema": SCHEMA, "name": found.name, "description": found.description, "points": found.points}
    text = space.canonical(head) + "\n"
    path = folder / "plan.json"
    if path.exists() and path.read_text(encoding="utf-8") != text:
        raise SweepError(f"{path}: the plan of another space; choose another folder")
    folder.mkdir(parents=True, exist_ok=True)
    outputs.write_whole(path, text)
    digest = sources_digest(root, {point["base"] for point in found.points})
    return Sweep(folder, found.name, found.description, tuple(found.points), digest)


def load(folder):
    """The head of a sweep that was started in a folder."""
    path = Path(folder) / "plan.json"
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        return Sweep(Path(folder).resolve(), found["name"], found["description"], tuple(found["points"]))
    except (OSError, ValueError, KeyError) as error:
        raise SweepError(f"{path}: {error}; start a sweep there: explore SPACE -o {folder}") from None


def parse_part(text):
    """(i, n) of 'i/n'."""
    found = re.fullmatch(r"(\d+)/(\d+)", text)
    if not found or not 1 <= int(found[1]) <= int(found[2]):
        raise SweepError(f"--part {text}: wanted I/N with I from 1 to N, such as 3/16")
    return int(found[1]), int(found[2])


def sources_digest(root, bases):
    """Of everything that decides the figures of a point."""
    digest = hashlib.sha256()
    paths = [space.design_path(root, base) for base in bases]
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
