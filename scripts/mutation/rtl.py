# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of the RTL: runs a block's test program on each, tries to prove the survivors equivalent,
and reports the rest."""

import json
import operator
import os
import random
import re
import subprocess
import tempfile
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import interrupts
from command_line import say
from crew import Crew

from . import equivalence
from .mutant import MutateError, pin, place, says, where

KILLED, CRASHES, HANGS, SURVIVES = "killed", "crashes", "hangs", "survives"
DEAD = (KILLED, CRASHES, HANGS)
PATTERNS = {"wire", "register", "pin"}  # of the whole name
KEYS = {"line", *PATTERNS, "bits", "modes", "kind", "why"}
ARGUED, BY_PROOF, GAP = "equivalent", "proof", "gap"
LONGEST_S = 3600  # for a test without a mutant


@dataclass
class Test:
    """A test program and its mutants."""

    name: str
    block: str
    folder: Path  # of the netlist
    program: Path
    seed: int = 0
    database: int = 0
    mutants: list = field(default_factory=list)
    own: bool = False  # its children are whole but for their pins

    def names(self):
        """What a user may call it; a test may have the name of its block."""
        return self.block, self.name, f"{self.block}.{self.name}"

    def read(self):
        path = self.folder / "mutants.json"
        if not path.exists():
            raise MutateError(f"{path} is missing; build the target {self.program.name}")
        found = json.loads(path.read_text(encoding="utf-8"))
        self.seed, self.database, self.mutants = found["seed"], found["database"], found["mutants"]
        self.own = found["own"]

    def joined(self, mutants, work, crew):
        return equivalence.Joined(self.folder, self.block, mutants, work, crew, self.own)


def tests(build):
    """All that the build folder has been configured with."""
    found = []
    for path in sorted(build.glob("testbench/**/*_mutants.netlist/test.json")):
        entry = json.loads(path.read_text(encoding="utf-8"))
        program = path.parent.parent / f"{entry['test']}_mutants"
        found.append(Test(entry["test"], entry["block"], path.parent, program))
    return found


LISTED = Path("testbench/campaigns/mutate/rtl.toml")


class Listed:
    """Survivors of a block that were looked at, with the reason: its entries in rtl.toml."""

    def __init__(self, root, block):
        path = root / LISTED
        self.root = root
        self.entries = []
        if path.exists():
            try:
                self.entries = tomllib.loads(path.read_text(encoding="utf-8")).get(block, [])
                for entry in self.entries:
                    for key in PATTERNS & entry.keys():
                        re.compile(entry[key])
            except (tomllib.TOMLDecodeError, re.error) as error:
                raise MutateError(f"{path}: {error}") from error
        for entry in self.entries:
            if (
                not entry.get("why")
                or entry.get("kind") not in (ARGUED, BY_PROOF, GAP)
                or not entry.keys() <= KEYS
                or len(entry) < 3
            ):
                raise MutateError(
                    f"{path}: an entry has 'why', the kind {ARGUED}, {BY_PROOF} or {GAP}, "
                    "and some of "
                    "line, wire, register, pin, bits, modes"
                )

    def entry(self, mutant):
        """(kind, reason) of the first entry that fits, or two empty texts."""
        for entry in self.entries:
            if "line" in entry and not any(
                entry["line"] in place(self.root, s)[2] for s in mutant["sources"]
            ):
                continue
            texts = {
                "wire": mutant.get("wire", ""),
                "register": mutant.get("register", ""),
                "pin": pin(mutant),
            }
            if not all(re.fullmatch(entry[key], texts[key]) for key in PATTERNS & entry.keys()):
                continue
            if "bits" in entry and mutant["bit"] not in entry["bits"]:
                continue
            if "modes" in entry and mutant["mode"] not in entry["modes"]:
                continue
            return entry["kind"], entry["why"]
        return "", ""


@dataclass
class Row:
    """What became of a test's mutants."""

    test: Test
    listed: Listed
    fates: dict = field(default_factory=dict)  # number: KILLED ... SURVIVES
    proofs: dict = field(default_factory=dict)  # number: (verdict, what was said)
    seconds: float = 0.0
    before: dict = field(default_factory=dict)  # results of the run whose survivors these are

    def tried(self):
        return self.before.get("mutants", len(self.fates))

    def count(self, *fates):
        earlier = sum(self.before.get(fate, 0) for fate in set(fates) - {SURVIVES})
        return earlier + sum(fate in fates for fate in self.fates.values())

    def survivors(self):
        """Those that are not proven equivalent."""
        return [
            m
            for m in self.test.mutants
            if self.fates.get(m["number"]) == SURVIVES
            and self.proofs.get(m["number"], ("",))[0] != equivalence.EQUIVALENT
        ]

    def equivalent(self):
        """Proven to be."""
        now = sum(verdict == equivalence.EQUIVALENT for verdict, _ in self.proofs.values())
        return now + self.before.get("equivalent", 0)

    def of(self, kind):
        """Survivors of this kind; "": not listed."""
        return sum(self.listed.entry(m)[0] == kind for m in self.survivors())

    def dead(self):
        """Killed by the test, or by a property of the block that fails with it."""
        return self.count(*DEAD) + self.of(BY_PROOF)

    def relevant(self):
        """All but those that are equivalent, by proof or by argument."""
        return self.tried() - self.equivalent() - self.of(ARGUED)

    def share(self):
        return self.dead() / self.relevant() if self.relevant() else 1.0

    def as_json(self):
        """Counts, and what survived."""

        def entry(mutant):
            verdict, said = self.proofs.get(mutant["number"], ("not tried", ""))
            return {
                "number": mutant["number"],
                "mutant": says(mutant),
                "where": where(self.listed.root, mutant),
                "proof": verdict,
                "said": said,
                **dict(zip(("kind", "why"), self.listed.entry(mutant))),
            }

        return {
            "test": self.test.name,
            "block": self.test.block,
            "seed": self.test.seed,
            "database": self.test.database,
            "mutants": self.tried(),
            "killed": self.count(*DEAD),
            "crashes": self.count(CRASHES),
            "hangs": self.count(HANGS),
            "equivalent": self.equivalent(),
            "by_proof": self.of(BY_PROOF),
            "argued": self.of(ARGUED),
            "gaps": self.of(GAP),
            "left": self.of(""),
            "killed_share": round(self.share(), 4),
            "seconds": round(self.seconds, 1),
            "survivors": [entry(m) for m in self.survivors()],
        }


def run_program(crew, test, number, limit_s):
    """(fate, seconds of CPU time, output)"""
    kept = {
        k: v for k, v in os.environ.items() if k not in ("FELTGATE_DEFECT", "FELTGATE_MISMATCH_DIR")
    }
    with tempfile.TemporaryFile() as output:
        status, seconds = crew.timed(
            [test.program, "--abort"],
            limit_s,
            env=kept | {"FELTGATE_MUTANT": str(number)},
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
        )
        output.seek(0)
        text = output.read().decode("utf-8", "replace")
    if status is None:
        return HANGS, seconds, text
    if -status in interrupts.ENDING:  # by somebody else: it says nothing of the mutant
        raise interrupts.Interrupted(-status)
    if status == 0:
        return SURVIVES, seconds, text
    return (CRASHES if status < 0 or "fatal error condition" in text else KILLED), seconds, text


def chosen(of, options):
    """So many mutants of a test or header, or all; the same ones for one seed."""
    if not 0 < options.count < len(of.mutants):
        return of.mutants
    some = random.Random(f"{options.seed}/{of.name}").sample(range(len(of.mutants)), options.count)
    return [of.mutants[n] for n in sorted(some)]


def check_earlier(found):
    """KeyError where a test of an earlier run lacks what is taken over from it."""
    counts = ("mutants", "killed", CRASHES, HANGS, "equivalent")
    operator.itemgetter("test", "seed", "database", "seconds", *counts)(found)
    for survivor in found["survivors"]:
        operator.itemgetter("number", "proof", "said")(survivor)


def of_run(results, test):
    """What an earlier run of all mutants said of a test: {} with other mutants in it."""
    for found in results["tests"]:
        same = (test.seed, test.database, len(test.mutants))
        if found["test"] == test.name and same == tuple(
            found[key] for key in ("seed", "database", "mutants")
        ):
            return {**found, KILLED: found["killed"] - found[CRASHES] - found[HANGS]}
    raise MutateError(
        f"the results have no run of all mutants of {test.name} as they are now; "
        "run it without --again"
    )


def take_over(row, results):
    """The survivors of an earlier run that are to be tried; the others stand as they were."""
    row.before = of_run(results, row.test)
    row.seconds = row.before["seconds"]
    found = {s["number"]: s for s in row.before["survivors"]}
    alive = [m for m in row.test.mutants if m["number"] in found]
    known = [m for m in alive if row.listed.entry(m)[0]]
    for mutant in known:
        earlier = found[mutant["number"]]
        row.fates[mutant["number"]] = SURVIVES
        row.proofs[mutant["number"]] = (earlier["proof"], earlier["said"])
    return [m for m in alive if m not in known]


def run(wanted, root, options, results=None):
    """The rows of these tests; with the results of an earlier run of what survived in it."""
    jobs = options.jobs
    rows = [Row(test, Listed(root, test.block)) for test in wanted]
    if results is None:
        todo = [(row, mutant) for row in rows for mutant in chosen(row.test, options)]
    else:
        todo = [(row, mutant) for row in rows for mutant in take_over(row, results)]
    crew, limits = Crew(), {}

    def first(row):
        fate, seconds, text = run_program(crew, row.test, 0, LONGEST_S)
        if fate != SURVIVES:
            last = "\n".join(text.strip().splitlines()[-5:])
            raise MutateError(f"{row.test.program.name} {fate} without a mutant:\n{last}")
        return seconds

    def limit(row, seconds):
        limits[row.test.name] = 60 + 40 * seconds
        row.seconds += seconds

    crew.each(first, rows, jobs, limit)

    def fate(item):
        row, mutant = item
        return run_program(crew, row.test, mutant["number"], limits[row.test.name])

    def note(item, found, _):
        row, mutant = item
        row.fates[mutant["number"]] = found[0]
        row.seconds += found[1]
        return f"{row.test.name} {mutant['number']}"

    crew.counted("mutate", fate, todo, jobs, note)
    if options.proof_seconds:
        say("mutate", f"{sum(map(unproven, rows))} survive; proving which are equivalent")
        with tempfile.TemporaryDirectory(prefix="feltgate-mutate-") as work:
            prove(rows, crew, Path(work), jobs, options.proof_seconds)
    return rows


def unproven(row):
    """How many survivors nothing was tried of."""
    return sum(fate == SURVIVES and n not in row.proofs for n, fate in row.fates.items())


def prove(rows, crew, work, jobs, limit_s):
    """Enters the verdict on each survivor in its row."""
    todo = []

    def join(row):
        alive = [
            m
            for m in row.test.mutants
            if row.fates.get(m["number"]) == SURVIVES and m["number"] not in row.proofs
        ]
        if not alive:
            return []
        design = row.test.joined(alive, work / row.test.name, crew)
        return [(row, mutant, design) for mutant in alive]

    def verdict(item):
        _, mutant, design = item
        return design.prove(mutant, limit_s)

    def note(item, found, _):
        row, mutant, _ = item
        row.proofs[mutant["number"]] = found[:2]
        row.seconds += found[2]
        return f"{row.test.name} {mutant['number']} {found[0]}"

    crew.each(join, rows, jobs, lambda _, found: todo.extend(found))
    crew.counted("mutate", verdict, todo, jobs, note)


def show(test, number, root, proof_seconds):
    """One mutant, for a person: what it is, where, and what becomes of it."""
    mutant = next((m for m in test.mutants if m["number"] == number), None)
    if mutant is None:
        raise MutateError(f"{test.name} has the mutants 1 to {len(test.mutants)}")
    print(f"{test.name} {number}: {says(mutant)}\n  cell {mutant['cell']}")
    for line in where(root, mutant):
        print(f"  {line}")
    crew = Crew()
    fate, seconds, text = run_program(crew, test, number, LONGEST_S)
    said = re.search(r"^.*mismatch (?:at|with).*$|^.*FAILED.*$", text, re.M)
    print(f"{fate} in {seconds:.2f} s of CPU{f': {said.group(0)}' if said else ''}")
    if fate == SURVIVES and proof_seconds:
        with tempfile.TemporaryDirectory(prefix="feltgate-mutate-") as work:
            design = test.joined([mutant], Path(work, "one"), crew)
            verdict, said, _ = design.prove(mutant, proof_seconds)
            print(f"{verdict}: {said}")
            if verdict == equivalence.DIFFERENT:
                print(design.example(mutant))
        kind, why = Listed(root, test.block).entry(mutant)
        print(
            f"{kind}: {why}"
            if kind
            else f"to list it with a reason: {LISTED}, [[{test.block}]]"
        )
    print(f"again: FELTGATE_MUTANT={number} {test.program}")
