# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A plan: the points of a space in a folder, and their division into chunks.

Points of one structure are next to each other. If there are no more chunks than structures, they
are in one chunk, because building a structure costs far more than another point of it.
Documentation: docs/speed-for-accuracy.md
"""

import hashlib
import json
import re
from dataclasses import dataclass
from pathlib import Path

import outputs
from command_line import Refused
from exploration import space

SCHEMA = "feltgate-explore-plan/1"
# What decides a point's figures: a change of these makes chunks of before stale.
SOURCES = (
    *("rtl/core/**/*.sv", "rtl/*.f", "rtl/*.toml", "vectors/plants/linear.toml"),
    *("model/include/feltgate/*.hpp", "model/sim/reference/*"),
    *("model/studies/explore/*", "model/design/*"),
)
EVALUATOR = "scripts/exploration/point*.py"
GENERATED = "/generated/"


class PlanError(Refused):
    """A folder without a plan, or with another one."""


@dataclass(frozen=True)
class Plan:
    folder: Path
    name: str
    description: str
    points: tuple
    digest: str

    def groups(self):
        """[(first, after)] of the points of one structure each."""
        edges = [
            i
            for i, point in enumerate(self.points)
            if i == 0 or space.structure(point) != space.structure(self.points[i - 1])
        ]
        return list(zip(edges, [*edges[1:], len(self.points)], strict=True))

    def chunk(self, index, count):
        """The points of chunk `index` of `count`, counted from 1. A chunk may be empty."""
        if not 1 <= index <= count:
            raise PlanError(f"chunk {index}/{count}: count from 1 to {count}")
        groups, total = self.groups(), len(self.points)
        if count > len(groups):
            groups = [(i, i + 1) for i in range(total)]
        mine = [g for g in groups if g[0] * count // total == index - 1]
        return [point for first, after in mine for point in self.points[first:after]]


def text_of(found):
    """The plan as a file: the same bytes for the same space."""
    head = {"schema": SCHEMA, "name": found.name, "description": found.description}
    lines = ",\n".join("  " + space.canonical(point) for point in found.points)
    return space.canonical(head)[:-1] + ',"points":[\n' + lines + "\n]}\n"


def make(found, folder):
    """Writes the plan of a Space. The same plan again changes nothing; another one is refused."""
    path = Path(folder) / "plan.json"
    text = text_of(found)
    if path.exists():
        if path.read_text(encoding="utf-8") != text:
            raise PlanError(f"{path}: the plan of another space; choose another folder")
        return load(folder)
    path.parent.mkdir(parents=True, exist_ok=True)
    outputs.write_whole(path, text)
    return load(folder)


def load(folder):
    path = Path(folder) / "plan.json"
    try:
        text = path.read_text(encoding="utf-8")
        table = json.loads(text)
    except OSError as error:
        raise PlanError(f"{path}: {error.strerror}; 'explore plan SPACE -o DIR' first") from None
    except ValueError as error:
        raise PlanError(f"{path}: {error}; plan into another folder") from None
    if table.get("schema") != SCHEMA:
        raise PlanError(f"{path}: schema {table.get('schema')!r}, not {SCHEMA}; plan it again")
    digest = hashlib.sha256(text.encode()).hexdigest()[:16]
    points = tuple(table["points"])
    return Plan(path.parent.resolve(), table["name"], table["description"], points, digest)


def parse_chunk(text):
    """(i, n) of 'i/n'."""
    found = re.fullmatch(r"(\d+)/(\d+)", text)
    if not found or not 1 <= int(found[1]) <= int(found[2]):
        raise PlanError(f"--chunk {text}: wanted I/N with I from 1 to N, such as 3/16")
    return int(found[1]), int(found[2])


def sources_digest(root, bases):
    """Of everything that decides the figures of a point."""
    digest = hashlib.sha256()
    paths = [space.design_path(root, base) for base in bases]
    for pattern in (*SOURCES, EVALUATOR):
        paths += [p for p in Path(root).glob(pattern) if GENERATED not in str(p)]
    for path in sorted(set(paths)):
        digest.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]
