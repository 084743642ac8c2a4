# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Tables of feltgate prove: on the terminal, and its counts in docs/verification/proofs.json."""

import block_results

from .tasks import BASE, COVERS, INDUCTION


def seconds(result):
    return f"{result.seconds:.1f}" if result else "-"


def text_table(rows):
    """The rows, for a terminal."""
    lines = [f"{'proof':32}{'design':10}{'k':>3}{'base s':>9}{'induct. s':>10}  covers"]
    for row in rows:
        induction, covers = row.results.get(INDUCTION), row.results.get(COVERS)
        k = induction.depth if induction and induction.passed else "-"
        reached = ", ".join(f"{n} {s}" for n, s in covers.reached.items()) if covers else ""
        lines.append(
            f"{row.proof.key:32}{row.design:10}{k:>3}{seconds(row.results.get(BASE)):>9}"
            f"{seconds(induction):>10}  {reached}"
        )
        for entry in row.proof.properties if row.first else ():
            caught = row.caught.get(entry.name)
            fate = (
                f"fails in clock {caught.step} with"
                if caught and not caught.passed
                else "not seen with"
            )
            lines.append(
                f"  {entry.name:30}{fate if caught else 'not tried with'} {entry.defect.stem}"
            )
    return "\n".join(lines)


def write(root, result):
    """docs/verification/proofs.json: the counts and seconds of each block."""
    from . import catalog

    run = {entry["proof"] for entry in result["proofs"]}
    of_all = all(p.key in run for p in catalog.read(root))
    put = block_results.write if of_all else block_results.merge
    put(root, "proofs", "./feltgate prove --update", per_block(result))


def per_block(result):
    """The row of each block in the table of results; seconds of base and induction."""
    blocks = {}
    for entry in result["proofs"]:
        row = blocks.setdefault(
            entry["proof"].partition(".")[0], {"properties": {}, "seconds": 0.0}
        )
        row["properties"] |= {(entry["proof"], one["name"]): 1 for one in entry["properties"]}
        row["seconds"] += entry["base_seconds"] + entry["induction_seconds"]
    return {
        name: {"properties": len(row["properties"]), "seconds": round(row["seconds"], 1)}
        for name, row in blocks.items()
    }
