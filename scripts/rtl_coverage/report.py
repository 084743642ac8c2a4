# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Coverage of each block: the table, the list of points that were not reached, the JSON."""

from dataclasses import dataclass, field

from reports.columns import aligned

from .data import KINDS
from . import waivers as waiving

TARGET = {
    "line": 100.0,
    "branch": 100.0,
    "toggle": 98.0,
    "cover": 100.0,
}  # percent, waived points apart
CORE = "whole core"


@dataclass
class Row:
    """What was reached of one block."""

    block: str
    reached: dict = field(default_factory=lambda: dict.fromkeys(KINDS, 0))
    total: dict = field(default_factory=lambda: dict.fromkeys(KINDS, 0))
    waived: dict = field(default_factory=lambda: dict.fromkeys(KINDS, 0))
    seconds: float = 0.0

    def short(self):
        """The kinds that miss their target."""
        return [
            k for k in KINDS if 100 * self.reached[k] < TARGET[k] * (self.total[k] - self.waived[k])
        ]


@dataclass
class Report:
    """All that is told of a run."""

    rows: list
    core: Row  # the core's tests alone, each instance for itself; no target
    missed: list  # points neither reached nor waived
    waivers: list

    @property
    def bad(self):
        return [row for row in self.rows if row.short()]


def count(row, kind, reached):
    row.total[kind] += 1
    row.reached[kind] += reached


def make(points, core_points, seconds, waivers, blocks):
    """`points` {point: count} of all programs, `core_points` {(where, point): count} of the
    core's."""
    rows = {block: Row(block, seconds=seconds.get(block, 0.0)) for block in blocks}
    missed = []
    for point, number in sorted(points.items()):
        if point.block in rows:
            count(rows[point.block], point.kind, number >= point.needed)
            if number < point.needed:
                missed.append(point)
    left = waiving.take(waivers, missed)
    for waiver in waivers:
        for point in waiver.used:
            rows[point.block].waived[point.kind] += 1
    core = Row(CORE)
    for (_, point), number in core_points.items():
        count(core, point.kind, number >= point.needed)
    return Report(list(rows.values()), core if core_points else None, left, waivers)


def cell(row, kind):
    """One count of the table."""
    if not row.total[kind]:
        return "-"
    waived = f" ({row.waived[kind]} waived)" if row.waived[kind] else ""
    return f"{row.reached[kind]}/{row.total[kind]}{waived}"


def text(report, limit):
    """The table, then at most `limit` points that were not reached, and the waivers."""
    rows = [("block", "lines", "branches", "toggles", "cover points", "s of CPU", "")]
    for row in [*report.rows, *([report.core] if report.core else [])]:
        seconds = f"{row.seconds:.1f}" if row.seconds else "-"
        short = "short" if row in report.bad else ""
        rows.append((row.block, *(cell(row, kind) for kind in KINDS), seconds, short))
    lines = [aligned(rows)]
    if report.missed:
        lines += ["", "not reached:"]
        lines += [f"  {p.where}: {p.kind} {p.name}" for p in report.missed[:limit]]
        if len(report.missed) > limit:
            lines.append(f"  and {len(report.missed) - limit} more; --limit N shows N, --json all")
    used = [waiver for waiver in report.waivers if waiver.used]
    if used:
        lines += ["", "waived:"]
        lines += [
            f"  {w.block} {w.kind} {w.points.pattern} ({len(w.used)}): {w.reason}" for w in used
        ]
    return "\n".join(lines)


def figures(row):
    """[reached, of] of each kind."""
    return {kind: [row.reached[kind], row.total[kind]] for kind in KINDS}


def per_block(report):
    """The row of each block; the core's own tests are timed in its own row."""
    found = {}
    for row in [*report.rows, *([report.core] if report.core else [])]:
        found[row.block] = {kind: pair for kind, pair in figures(row).items() if pair[1]}
        if row.seconds:
            found[row.block]["seconds"] = round(row.seconds, 1)
    return found


def as_json(report, schema):
    """The object of docs/testing.md."""
    rows = {
        row.block: figures(row)
        | {"waived": row.waived, "short": row.short(), "seconds": round(row.seconds, 2)}
        for row in report.rows
    }
    return {
        "schema": schema,
        "blocks": rows,
        "whole_core": figures(report.core) if report.core else None,
        "not_reached": [
            {"block": p.block, "kind": p.kind, "file": p.file, "line": p.line, "point": p.name}
            for p in report.missed
        ],
        "waivers": [
            {
                "block": w.block,
                "kind": w.kind,
                "points": w.points.pattern,
                "reason": w.reason,
                "waived": [p.name for p in w.used],
            }
            for w in report.waivers
        ],
    }
