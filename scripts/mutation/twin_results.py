# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Known survivors of the twin's mutants, and the results: testbench/campaigns/mutate/twin.toml, the
rows of the table, docs/verification/twin_mutants.json. docs/testing.md
"""

import json
import tomllib
from dataclasses import dataclass, field

from command_line import Refused
import block_results
import outputs
from reports.columns import aligned

from . import twin_programs

SCHEMA = "feltgate-mutate-twin/1"
CATALOGUE = "testbench/campaigns/mutate/twin.toml"
RESULTS = "docs/verification/twin_mutants.json"
SURVIVOR_KEYS = {"header", "kind", "why", "mutants"}
DEAD = ("killed", "hangs", "crashes")


class TwinError(Refused):
    """A header or a catalogue that cannot be used."""


@dataclass
class Catalogue:
    """What testbench/campaigns/mutate/twin.toml says."""

    tests: dict  # header: targets
    constant: dict = field(default_factory=dict)  # header: functions that only the compiler calls
    survivors: dict = field(default_factory=dict)  # (header, name of the mutant): (kind, why)
    blocks: dict = field(
        default_factory=dict
    )  # header: row of docs/blocks.md, where that has another name


def read_catalogue(root):
    """testbench/campaigns/mutate/twin.toml; TwinError where something in it cannot be used."""
    path = root / CATALOGUE
    try:
        text = tomllib.loads(path.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise TwinError(f"{path}: {error}") from error
    tests, blocks, survivors = text.get("tests", {}), text.get("block", {}), {}
    for header in blocks:
        if header not in tests or not isinstance(blocks[header], str):
            raise TwinError(
                f"{path}: [block] has a row of docs/blocks.md for a header; not so {header}"
            )
    for entry in text.get("survivor", []):
        if entry.keys() != SURVIVOR_KEYS:
            raise TwinError(f"{path}: a survivor has the keys {', '.join(sorted(SURVIVOR_KEYS))}")
        if entry["kind"] not in ("equivalent", "gap") or not entry["why"]:
            raise TwinError(f"{path}: a survivor is equivalent or a gap, and says why")
        for name in entry["mutants"]:
            survivors[entry["header"], name] = (entry["kind"], entry["why"])
    return Catalogue(tests, text.get("constant", {}), survivors, blocks)


def survivors_of(path):
    """(header, mutant) of those that results tell of."""
    try:
        rows = json.loads(path.read_text(encoding="utf-8"))["headers"]
        return {
            (row["header"], survivor["mutant"]) for row in rows for survivor in row["survivors"]
        }
    except (OSError, ValueError, KeyError, TypeError) as error:
        why = error.strerror if isinstance(error, OSError) else error
        raise TwinError(
            f"{path}: no results of 'feltgate mutate --twin --json' ({why}); give such a file"
        ) from None


@dataclass
class Row:
    """What became of a header's mutants."""

    header: str
    offered: int
    verdicts: list
    catalogue: Catalogue

    def known(self, verdict):
        """(kind, why) of one that is not killed, or None."""
        if verdict.how == "exact":
            return (
                "equivalent",
                "nothing to round, for the result has as many fraction bits, or no call with the "
                "arguments swapped",
            )
        return self.catalogue.survivors.get((self.header, verdict.mutant.name))

    def count(self, *hows):
        return sum(v.how in hows for v in self.verdicts)

    def left(self, kind):
        """Not killed: equivalent, gap or None for those not listed."""
        return [
            v for v in self.verdicts if v.how not in DEAD and (self.known(v) or (None,))[0] == kind
        ]

    def share(self):
        """Killed, of those that are not equivalent."""
        living = len(self.verdicts) - len(self.left("equivalent"))
        return self.count(*DEAD) / living if living else 1.0

    def as_json(self):
        """Counts, and what survived."""
        return {
            "header": self.header,
            "offered": self.offered,
            "tried": len(self.verdicts),
            "killed": self.count("killed"),
            "hangs": self.count("hangs"),
            "crashes": self.count("crashes"),
            "equivalent": len(self.left("equivalent")),
            "killed_share": round(self.share(), 4),
            "seconds": round(sum(v.seconds for v in self.verdicts), 1),
            "survivors": [
                {
                    "mutant": v.mutant.name,
                    "line": v.mutant.line,
                    "reached": v.how != "unreached",
                    "kind": (self.known(v) or ("not listed", ""))[0],
                    "why": (self.known(v) or ("", ""))[1],
                }
                for v in self.verdicts
                if v.how not in DEAD
            ],
        }


def table(rows):
    """The rows, for a terminal."""
    head = (
        "header",
        "offered",
        "tried",
        "killed",
        "hang",
        "crash",
        "equivalent",
        "gaps",
        "not listed",
        "killed share",
    )
    lines = [head]
    for row in rows:
        lines.append(
            (
                row.header,
                row.offered,
                len(row.verdicts),
                row.count("killed"),
                row.count("hangs"),
                row.count("crashes"),
                len(row.left("equivalent")),
                len(row.left("gap")),
                len(row.left(None)),
                f"{100 * row.share():.1f} %",
            )
        )
    return aligned(lines)


def print_survivors(rows, known):
    """Those that are not listed, or all (`known`)."""
    for row in rows:
        for verdict in row.verdicts:
            if verdict.how in DEAD or (row.known(verdict) and not known):
                continue
            kind, why = row.known(verdict) or ("not listed", "")
            print(
                f"{twin_programs.HEADERS}/{row.header}.hpp:{verdict.mutant.line}: "
                f"{verdict.how}, {kind}: "
                f"{verdict.mutant.name}{f' ({why})' if why else ''}"
            )


def results_of(rows, options, dropped):
    """The object of --json."""
    return {
        "schema": SCHEMA,
        "machine": block_results.machine(),
        "date": block_results.today(),
        "seed": options.seed,
        "count": options.count,
        "not_compiled": {name: len(d) for name, d in dropped.items()},
        "headers": [row.as_json() for row in rows],
    }


def update(root, catalogue, result):
    """The headers' results beside those of others, and [killed, not equivalent] of their blocks."""
    where = root / RESULTS
    entries = {}
    if where.exists():
        entries = {e["header"]: e for e in json.loads(where.read_text(encoding="utf-8"))["headers"]}
    for entry in result["headers"]:
        entries[entry["header"]] = {
            **{k: v for k, v in entry.items() if k != "survivors"},
            "date": result["date"],
            "machine": result["machine"],
        }
    known = [entries[name] for name in catalogue.tests if name in entries]
    lines = ",\n".join("  " + json.dumps(entry) for entry in known)
    outputs.write_whole(
        where,
        f'{{"schema": "{SCHEMA}", "headers": [\n{lines}\n]}}\n',
    )
    changed, sums = {row_of(catalogue, entry["header"]) for entry in result["headers"]}, {}
    for entry in known:
        pair = sums.setdefault(row_of(catalogue, entry["header"]), [0, 0])
        pair[0] += entry["killed"] + entry["hangs"] + entry["crashes"]
        pair[1] += entry["tried"] - entry["equivalent"]
    rows = {row: {"twin": pair} for row, pair in sums.items() if row in changed}
    block_results.merge(root, "mutants", "./feltgate mutate [--twin] --update", rows)


def row_of(catalogue, header):
    """The row of docs/blocks.md that a header's mutants count in."""
    return catalogue.blocks.get(header, header)
