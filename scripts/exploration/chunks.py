# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Chunk files: the results of a sweep, in parts that any process of any machine may evaluate.

A chunk file has one line that says what it is, then one line per point. It is written under a
temporary name and gets its own name when it is complete. Documentation: docs/speed-for-accuracy.md
"""

import importlib
import json
import os
import socket
from pathlib import Path

from command_line import Refused
from exploration import space

FOLDER = "chunks"
WORK = "work"
EVALUATOR = "FELTGATE_EXPLORE_POINT"  # tests put their own module here


class ChunkError(Refused):
    """An evaluation that failed, or chunks that do not make a whole."""


class Orphaned(Refused):
    """The process that started this one is gone."""


def evaluator():
    return importlib.import_module(os.environ.get(EVALUATOR, "exploration.point")).evaluate


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


def one(evaluate, point, plan, **more):
    """A point's result. Raises ChunkError that names the point."""
    try:
        result = evaluate(point, plan.folder / WORK, **more)
    except Exception as error:  # whatever it is, the point must be named
        raise ChunkError(
            f"point {space.canonical(point['set'])} of {point['base']}: "
            f"{type(error).__name__}: {error}"
        ) from error
    result.pop("structure", None)  # names a folder of this machine
    return result


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


def missing(plan, count, sources):
    """Numbers of the chunks that are not there yet, or stale."""
    sweep_up(plan)
    return [i for i in range(1, count + 1) if not is_done(plan, i, count, sources)]


def points_under_way(folder):
    """Points that chunks under way have finished; for the progress line only."""
    lines = 0
    for path in (Path(folder) / FOLDER).glob(".*.tmp"):
        try:
            lines += max(0, path.read_bytes().count(b"\n") - 1)
        except OSError:
            continue  # renamed meanwhile
    return lines
