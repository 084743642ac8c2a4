# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of RTL or twin that test programs run with, one at a time, and the share that is killed.

The environment variable FELTGATE_MUTANT chooses a mutant by its number, 0 none. First every test case
runs without one and says how long it takes and, of the twin, which mutants it reaches. The cases that
reach a mutant then run with it, the shortest first, until one fails. Documentation: docs/testing.md
"""

import contextlib
import math
import os
import random
import resource
import shlex
import subprocess
import threading
from dataclasses import dataclass, field
from pathlib import Path

import block_results
import interrupts
from command_line import Refused
from crew import Crew
from reports.columns import aligned

KILLED, CRASHES, HANGS, SURVIVES, UNREACHED = "killed", "crashes", "hangs", "survives", "unreached"
DEAD = (KILLED, CRASHES, HANGS)
SLOWER, MORE_S = 3, 2  # a mutant may take this many times the CPU time, and these seconds more
UNRECORDED = 0.8  # the least share of what has no record yet
SIGMAS = 3  # a sample may be this much worse than the record by chance


class MutateError(Refused):
    """What is missing or wrong, for the user."""


@dataclass
class Mutant:
    """One change."""

    number: int
    what: str
    where: list  # of path:line


@dataclass
class Case:
    """A test case: the command that runs it, and the mutants that it reaches, None: any."""

    command: list
    seconds: float = 0.0
    reached: set | None = None


@dataclass
class Subject:
    """What is changed, and the test cases that judge it."""

    name: str
    row: str  # of the results: the block or the header
    mutants: list
    cases: list = field(default_factory=list)

    def sample(self, count, seed):
        """So many of its mutants, 0: all; the same ones for one seed."""
        if not 0 < count < len(self.mutants):
            return self.mutants
        some = random.Random(f"{seed}/{self.name}").sample(range(len(self.mutants)), count)
        return [self.mutants[n] for n in sorted(some)]


@dataclass
class Verdict:
    """What became of one mutant."""

    subject: Subject
    mutant: Mutant
    fate: str
    seconds: float
    again: str = ""  # a command that a survivor survives


class Runs:
    """Test cases in parallel, with one mutant each; `folder` is for what they write."""

    def __init__(self, folder, jobs):
        self.folder, self.jobs, self.crew = Path(folder), jobs, Crew()

    def run(self, case, limit_s=None, **more):
        """(fate, seconds of CPU time) of a test case; beyond the limit of these a signal ends it."""
        environment = {k: v for k, v in os.environ.items() if not k.startswith("FELTGATE_")} | more
        environment["FELTGATE_MISMATCH_DIR"] = str(self.folder / "mismatch" / str(threading.get_ident()))
        silent = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.DEVNULL)
        process = self.crew.start(case.command, env=environment, **silent)
        with contextlib.suppress(ProcessLookupError):  # it may be over already
            resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))
            if limit_s:
                resource.prlimit(process.pid, resource.RLIMIT_CPU, (limit_s, limit_s))
        status, seconds = self.crew.wait(process, 60 + 20 * limit_s if limit_s else None)
        if status is None or (limit_s and status < 0 and seconds > limit_s - 1):
            return HANGS, seconds
        if -status in interrupts.ENDING:  # by somebody else: it says nothing of the mutant
            raise interrupts.Interrupted(-status)
        return SURVIVES if status == 0 else KILLED if status > 0 else CRASHES, seconds

    def survey(self, cases):
        """Enters what each case takes without a mutant and which mutants it reaches."""

        def one(numbered):
            number, case = numbered
            notes = self.folder / f"reached{number}"
            notes.unlink(missing_ok=True)
            fate, case.seconds = self.run(case, FELTGATE_MUTANT="0", FELTGATE_MUTANTS_REACHED=str(notes))
            if fate != SURVIVES:
                raise MutateError(f"{shlex.join(map(str, case.command))}: {fate} without a mutant")
            if notes.exists():
                case.reached = set(map(int, notes.read_text(encoding="ascii").split()))

        self.crew.counted("mutate", one, enumerate(cases), self.jobs, lambda n, *_: Path(n[1].command[0]).name)

    def try_mutant(self, subject, mutant):
        """Its verdict."""
        spent, fate, again = 0.0, UNREACHED, ""
        for case in sorted(subject.cases, key=lambda case: case.seconds):
            if case.reached is not None and mutant.number not in case.reached:
                continue
            limit_s = math.ceil(SLOWER * case.seconds + MORE_S)
            fate, seconds = self.run(case, limit_s, FELTGATE_MUTANT=str(mutant.number))
            spent += seconds
            again = f"FELTGATE_MUTANT={mutant.number} {shlex.join(map(str, case.command))}"
            if fate in DEAD:
                break
        return Verdict(subject, mutant, fate, spent, again)

    def verdicts(self, subjects, count, seed):
        """Of a sample of each subject's mutants."""
        self.survey({id(case): case for subject in subjects for case in subject.cases}.values())
        work, found = [(s, m) for s in subjects for m in s.sample(count, seed)], []

        def note(_, verdict, __):
            found.append(verdict)
            return f"{verdict.subject.name} {verdict.fate}"

        self.crew.counted("mutate", lambda item: self.try_mutant(*item), work, self.jobs, note)
        return sorted(found, key=lambda v: (v.subject.name, v.mutant.number))


@dataclass
class Row:
    """A block or a header: what became of its mutants, and the share of them that must be killed."""

    name: str
    offered: int
    verdicts: list
    least: float

    def count(self, *fates):
        return sum(verdict.fate in fates for verdict in self.verdicts)

    def share(self):
        return self.count(*DEAD) / len(self.verdicts) if self.verdicts else 1.0

    def limit(self):
        """The share below which it is bad: of a sample less than of all, for chance decides it."""
        tried, rest = len(self.verdicts), self.offered - len(self.verdicts)
        if not rest or not tried:
            return self.least
        variance = self.least * (1 - self.least) / tried * rest / (self.offered - 1)
        return self.least - SIGMAS * math.sqrt(variance)

    def is_bad(self):
        return self.share() < self.limit()

    def seconds(self):
        return round(sum(verdict.seconds for verdict in self.verdicts), 1)

    def survivors(self):
        return [verdict for verdict in self.verdicts if verdict.fate not in DEAD]

    def as_json(self):
        return {
            "name": self.name,
            "offered": self.offered,
            "tried": len(self.verdicts),
            **{fate: self.count(fate) for fate in (KILLED, CRASHES, HANGS)},
            "killed_share": round(self.share(), 4),
            "least_share": round(self.limit(), 4),
            "seconds": self.seconds(),
            "survivors": [
                {"test": v.subject.name, "number": v.mutant.number, "what": v.mutant.what,
                 "where": v.mutant.where, "reached": v.fate == SURVIVES, "again": v.again}
                for v in self.survivors()
            ],
        }


def rows_of(root, key, subjects, found, required=None):
    """A row for each block or header, with the share of the record: whole percents of [killed, tried]."""
    recorded = (block_results.read(root, "mutants") or {"blocks": {}})["blocks"]
    rows = []
    for name in dict.fromkeys(subject.row for subject in subjects):
        killed, tried = recorded.get(name, {}).get(key, (UNRECORDED * 100, 100))
        least = 100 * killed // tried / 100 if required is None else required
        offered = sum(len(subject.mutants) for subject in subjects if subject.row == name)
        rows.append(Row(name, offered, [v for v in found if v.subject.row == name], least))
    return rows


def line_of(root, where):
    """path:line: what is there."""
    path, _, line = where.rpartition(":")
    full = Path(root, path)
    lines = full.read_text(encoding="utf-8").splitlines() if full.exists() else []
    return f"{where}: {lines[int(line) - 1].strip() if int(line) <= len(lines) else ''}"


def print_rows(root, rows):
    """Each survivor with its place, for a person to judge, and a table."""
    for row in rows:
        for v in row.survivors():
            print(f"{v.subject.name} {v.mutant.number} {v.fate}: {v.mutant.what}")
            lines = [*(line_of(root, where) for where in v.mutant.where), v.again]
            print("\n".join(f"    {line}" for line in lines if line))
    table = [("", "offered", "tried", *DEAD, "share", "least", "s of CPU")]
    for row in rows:
        shares = (f"{100 * share:.1f} %" for share in (row.share(), row.limit()))
        counts = (row.count(fate) for fate in DEAD)
        table.append((row.name, row.offered, len(row.verdicts), *counts, *shares, f"{row.seconds():.0f}"))
    print(aligned(table))
