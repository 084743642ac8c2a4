# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Chunk files: run one, and merge all of them.

A chunk file is a line that says what it is and one line per point. It grows under a name of its own
and appears under its name when it is whole. Documentation: docs/explore.md
"""

import importlib
import json
import os
import re
import socket
from pathlib import Path

from exploring import plan as plans
from exploring import space

FOLDER = "chunks"
WORK = "work"
MERGED = "points.jsonl"
EVALUATOR = "FELTGATE_EXPLORE_POINT"  # tests put their own module here


class ChunkError(Exception):
    """Chunks that do not make a whole, or an evaluation that failed."""


class Orphaned(Exception):
    """The process that started this one is gone."""


def evaluator():
    return importlib.import_module(os.environ.get(EVALUATOR, "exploring.point")).evaluate


def file_name(index, count):
    return f"{index:05d}-of-{count:05d}.jsonl"


def head_of(plan, index, count, sources):
    return {"chunk": index, "of": count, "plan": plan.digest, "sources": sources}


def read_head(path):
    """The first line of a chunk file, {} where it has none."""
    with path.open(encoding="utf-8") as file:
        try:
            return json.loads(file.readline())
        except ValueError:
            return {}


def is_done(plan, index, count, sources):
    path = plan.folder / FOLDER / file_name(index, count)
    return path.exists() and read_head(path) == head_of(plan, index, count, sources)


def line_of(point, result):
    """A point's line: what it is and what came out; nothing of when and where."""
    return space.canonical({"id": space.point_id(point), **point, "result": result})


def one(evaluate, point, plan):
    try:
        return evaluate(point, plan.folder / WORK)
    except Exception as error:  # whatever it is, the point must be named
        raise ChunkError(
            f"point {space.canonical(point['set'])} of {point['base']}: "
            f"{type(error).__name__}: {error}"
        ) from error


def run(plan, index, count, sources, parent=None):
    """Evaluates a chunk; the path of its file. Nothing to do when it is there already."""
    folder = plan.folder / FOLDER
    path = folder / file_name(index, count)
    if is_done(plan, index, count, sources):
        return path
    points = plan.chunk(index, count)
    evaluate = evaluator()
    folder.mkdir(parents=True, exist_ok=True)
    temporary = folder / f".{path.stem}.{socket.gethostname()}.{os.getpid()}.tmp"
    try:
        with temporary.open("w", encoding="utf-8") as file:
            file.write(space.canonical(head_of(plan, index, count, sources)) + "\n")
            for point in points:
                if parent is not None and os.getppid() != parent:
                    raise Orphaned(f"chunk {index}/{count}: its starter is gone")
                file.write(line_of(point, one(evaluate, point, plan)) + "\n")
                file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
    return path


def sweep_up(plan):
    """Removes what killed processes of this machine left behind."""
    for path in (plan.folder / FOLDER).glob(f".*.{socket.gethostname()}.*.tmp"):
        try:
            os.kill(int(path.name.split(".")[-2]), 0)
        except ProcessLookupError:
            path.unlink(missing_ok=True)
        except (PermissionError, ValueError):
            continue


def points_under_way(folder):
    """Points that chunks under way have finished; for the progress line only."""
    lines = 0
    for path in (Path(folder) / FOLDER).glob(".*.tmp"):
        try:
            lines += max(0, path.read_bytes().count(b"\n") - 1)
        except OSError:
            continue  # renamed meanwhile
    return lines


def collect(plan):
    """{id: line} of all chunk files. Raises ChunkError on gaps, duplicates and strangers."""
    lines, come_from, sources = {}, {}, {}
    paths = sorted((plan.folder / FOLDER).glob("*.jsonl"))
    wanted = {space.point_id(point) for point in plan.points}
    for path in paths:
        if not re.fullmatch(r"\d{5}-of-\d{5}\.jsonl", path.name):
            raise ChunkError(f"{path}: no chunk file; take it away")
        head, *rest = path.read_text(encoding="utf-8").splitlines()
        head = json.loads(head)
        if head.get("plan") != plan.digest:
            raise ChunkError(f"{path}: a chunk of another plan; take it away")
        sources.setdefault(head.get("sources"), path)
        for line in rest:
            name = json.loads(line)["id"]
            if name in lines:
                raise ChunkError(
                    f"{path}: point {name} is in {come_from[name].name} too; chunks of two counts "
                    "overlap: keep those of one"
                )
            if name not in wanted:
                raise ChunkError(f"{path}: point {name} is not in the plan; take the file away")
            lines[name], come_from[name] = line, path
    if len(sources) > 1:
        names = ", ".join(path.name for path in sources.values())
        raise ChunkError(f"chunks of different sources ({names}); run again, which renews them")
    gaps = [name for name in wanted if name not in lines]
    if gaps:
        counts = sorted({int(path.stem.rsplit("-", 1)[1]) for path in paths})
        if len(counts) == 1:
            there = {int(path.name[:5]) for path in paths}
            absent = [str(i) for i in range(1, counts[0] + 1) if i not in there]
            missing = f"; missing chunks of {counts[0]}: {', '.join(absent[:20])}"
        else:
            missing = ""
        raise ChunkError(
            f"{plan.folder}: {len(gaps)} of {len(wanted)} points have no result{missing}; run them"
        )
    return lines


def merge(plan):
    """Writes points.jsonl, sorted by the plan; its path. The same bytes whatever ran when."""
    lines = collect(plan)
    path = plan.folder / MERGED
    text = "".join(lines[space.point_id(point)] + "\n" for point in plan.points)
    plans.write_durably(path, text)
    return path


def read_merged(folder):
    path = Path(folder) / MERGED
    try:
        return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    except OSError as error:
        raise ChunkError(f"{path}: {error.strerror}; 'explore merge DIR' first") from None
