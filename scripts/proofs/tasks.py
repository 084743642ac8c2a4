# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The runs that decide a proof, and the rows that their results end in."""

from dataclasses import dataclass, field
from pathlib import Path

from . import tools as engine

BASE, INDUCTION, COVERS, DEFECT = "base", "induction", "covers", "defect"


@dataclass(frozen=True)
class Task:
    """One run: a proof on a design, of one of the four kinds."""

    proof: object
    design: str
    kind: str
    patch: Path = None

    @property
    def what(self):
        return f"{self.design} {self.kind}{f' {self.patch.stem}' if self.patch else ''}"

    def run(self, tools, root):
        """A Result; of a defect {property: Result}."""
        name = f"{self.proof.key}-{self.what}".replace(" ", "-").replace("/", "-")
        folder = tools.folder / name
        engine.elaborate(tools, root, self.proof, self.design, folder, self.patch)
        proof, show = self.proof, self.proof.show
        if self.kind == BASE:
            return engine.solve(tools, folder, "all.smt2", ["-t", str(proof.depth)], show)
        if self.kind == INDUCTION:
            return engine.solve(tools, folder, "all.smt2", ["-i", "-t", str(proof.depth)], show)
        if self.kind == COVERS:
            return engine.solve(tools, folder, "covers.smt2", ["-c", "-t", str(proof.cover_depth)])
        step = ["-i", "-t", str(proof.depth)]
        for entry in proof.properties:
            if entry.defect == self.patch and entry.from_any in ("alone", "next"):
                self.check_alone(tools, root, folder / "whole", entry, step)
        bmc = ["-t", str(proof.defect_depth)]
        return {
            entry.name: engine.solve(
                tools, folder, f"{entry.name}.smt2", step if entry.from_any else bmc, show
            )
            for entry in proof.properties
            if entry.defect == self.patch
        }

    def check_alone(self, tools, root, folder, entry, options):
        """Without the defect the assertion must be inductive so, or its failure says nothing."""
        engine.elaborate(tools, root, self.proof, self.design, folder, None, entry.name)
        if not engine.solve(tools, folder, f"{entry.name}.smt2", options).passed:
            raise engine.Broken(
                f"{self.proof.key}: {entry.name} is not inductive with "
                f'from_any = "{entry.from_any}"; take another defect'
            )


@dataclass
class Row:
    """One proof on one design."""

    proof: object
    design: str
    first: bool  # defects are tried on the first design only
    results: dict = field(default_factory=dict)  # kind: Result
    caught: dict = field(default_factory=dict)  # property: Result

    def good(self, most_defects=None):
        """Whether all runs of the row ended as they must, of so many defects; None: of all."""
        kinds = (BASE, INDUCTION, COVERS)
        if not all(kind in self.results and self.results[kind].passed for kind in kinds):
            return False
        tried = chosen_defects(self.proof, most_defects) if self.first else ()
        return all(
            entry.name in self.caught and not self.caught[entry.name].passed
            for entry in self.proof.properties
            if entry.defect in tried
        )

    def as_json(self, root):
        """Verdicts, times, and where each defect was seen."""
        base, induction = self.results[BASE], self.results[INDUCTION]
        covers = self.results.get(COVERS)
        return {
            "proof": self.proof.key,
            "design": self.design,
            "k": induction.depth,
            "base_proven": base.passed,
            "induction_proven": induction.passed,
            "base_seconds": round(base.seconds, 2),
            "induction_seconds": round(induction.seconds, 2),
            "covers": covers.reached if covers else {},
            "unreached_covers": covers.unreached if covers else [],
            "properties": [
                {
                    "name": entry.name,
                    "says": entry.says,
                    "defect": str(entry.defect.relative_to(root)),
                    "caught_at": None if caught is None or caught.passed else caught.step,
                }
                for entry in self.proof.properties
                for caught in [self.caught.get(entry.name)]
            ],
        }


def designs(proof, first_only):
    return proof.designs[:1] if first_only else proof.designs


def chosen_defects(proof, most=None):
    """So many of the proof's defects, spread evenly over its properties; None: all."""
    patches = list(dict.fromkeys(entry.defect for entry in proof.properties))
    if most is None or most >= len(patches):
        return patches
    return [patches[(2 * n + 1) * len(patches) // (2 * most)] for n in range(most)]


def plan(proofs, most_defects, first_only):
    """The tasks, those that may take long first."""
    todo = []
    for proof in proofs:
        for number, design in enumerate(designs(proof, first_only)):
            todo += [Task(proof, design, kind) for kind in (INDUCTION, BASE, COVERS)]
            if number == 0:
                for patch in chosen_defects(proof, most_defects):
                    todo.append(Task(proof, design, DEFECT, patch))
    return todo


def rows(proofs, first_only):
    return [
        Row(proof, design, number == 0)
        for proof in proofs
        for number, design in enumerate(designs(proof, first_only))
    ]


def enter(all_rows, task, result):
    """Puts a result where it belongs; yields what a user must know of it."""
    row = next(r for r in all_rows if r.proof is task.proof and r.design == task.design)
    if task.kind == DEFECT:
        row.caught |= result
        for name, one in result.items():
            if one.passed:
                yield (
                    f"{task.proof.key} ({task.design}): {name} holds in the first "
                    f"{task.proof.defect_depth} clocks with the defect {task.patch.stem}: "
                    "it does not see it"
                )
        return
    row.results[task.kind] = result
    where = f"{task.proof.key} ({task.design})"
    if result.passed:
        return
    if task.kind == COVERS:
        unreached = ", ".join(result.unreached)
        yield f"{where}: not reached within {task.proof.cover_depth} clocks: {unreached}"
    elif task.kind == BASE:
        yield f"{where}: {', '.join(result.failed)} fails in clock {result.step}:\n{result.trace}"
    else:
        yield (
            f"{where}: {', '.join(result.failed)} is not inductive within {task.proof.depth} "
            f"clocks; from a state that a reset may never lead to:\n{result.trace}"
        )
