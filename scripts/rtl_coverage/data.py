# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Verilator's coverage.dat, and the sum of many of them.

verilator_coverage 5.006 counts a column of the source as covered if any bit of it is covered.
Therefore it is not used.
"""

import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from command_line import Refused
import rtl_sources

LINE = re.compile(r"^C '(.*)' (\d+)$")
PAGES = {"line": "line", "branch": "branch", "toggle": "toggle", "user": "cover"}
KINDS = tuple(PAGES.values())
NEEDED = {"toggle": 2}  # a bit must come back, or rise in two models; of all else once is enough
CORE = "feltgate_core"  # the program that runs the devices
POINTS = "testbench/campaigns/coverage/points_"  # the files of modules BLOCK_cover


class DataError(Refused):
    """A file that is no coverage data."""


@dataclass(frozen=True, order=True)
class Point:
    """One thing that may be reached; instances and designs are not told apart."""

    block: str
    kind: str
    file: str  # relative to the repository
    line: int
    column: int
    name: str  # a bit, a branch, a cover point with its indexes

    @property
    def needed(self):
        return NEEDED.get(self.kind, 1)

    @property
    def where(self):
        return f"{self.file}:{self.line}"


def fields(text):
    """The pairs of key and value of a point."""
    return dict(pair.split("\x02", 1) for pair in text.split("\x01") if "\x02" in pair)


def generated_index(hierarchy):
    """The indexes of a cover point in a generate loop: '[3]', '[3][1]', or nothing."""
    own = hierarchy.rpartition(".u_cover")[2]
    return "".join(
        f"[{n}]" for n in re.findall(r"__BRA__(\d+)__KET__|\[(\d+)\]", own) for n in n if n
    )


def point_of(root, entry):
    """None for what is not asked for: the cover points' own lines and bits."""
    page, _, module = entry.get("page", "").removeprefix("v_").partition("/")
    kind = PAGES.get(page)
    path = Path(entry["f"])
    file = str(path.relative_to(root)) if path.is_relative_to(root) else str(path)
    is_points = file.startswith(POINTS)
    if kind is None or is_points != (kind == "cover"):
        return None
    name = entry["o"] + (generated_index(entry["h"]) if is_points else "")
    block = rtl_sources.measured_as(module.partition("_cover")[0] if is_points else path.stem)
    block = CORE if block == rtl_sources.CORE else block
    return Point(block, kind, file, int(entry["l"]), int(entry["n"]), name)


def read(root, file):
    """{(hierarchy, point): count} of one program."""
    counts = Counter()
    lines = file.read_text(encoding="utf-8").splitlines()
    if not lines or not lines[0].startswith("# SystemC::Coverage"):
        raise DataError(f"{file}: no coverage data")
    for line in lines[1:]:
        found = LINE.match(line)
        if not found:
            raise DataError(f"{file}: '{line}' is no point")
        entry = fields(found[1])
        point = point_of(root, entry)
        if point:
            counts[entry["h"], point] += int(found[2])
    return counts


def merged(all_counts):
    """{point: count} over programs and instances."""
    total = Counter()
    for (_, point), count in instances(all_counts).items():
        total[point] += count
    return total


def instances(all_counts):
    """{(hierarchy, point): count} over programs, the instances apart."""
    total = Counter()
    for counts in all_counts:
        total.update(counts)
    return total
