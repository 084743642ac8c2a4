# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Tables of feltgate prove: on the terminal, and the generated part of docs/proofs.md."""

import re
import sys

import block_results
import outputs

from .tasks import BASE, COVERS, INDUCTION

BEGIN = "<!-- proofs: written by feltgate prove --update -->"
END = "<!-- end of proofs -->"
PAGE = "docs/proofs.md"


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


def sections(text):
    """{block: its part} of what stands between the markers."""
    parts = re.split(r"^### (\w+)\n", text, flags=re.M)[1:]
    return {name: f"### {name}\n{part.rstrip()}\n" for name, part in zip(parts[::2], parts[1::2])}


def generated(result, proofs, before=""):
    """The part between the markers: a table per block; of one without a result as it was before."""
    said = {p.key: p for p in proofs}
    blocks = {}
    for entry in result["proofs"]:
        blocks.setdefault(entry["proof"].partition(".")[0], []).append(entry)
    found = sections(before)
    for block, entries in blocks.items():
        lines = [f"### {block}", ""]
        for key in dict.fromkeys(entry["proof"] for entry in entries):
            lines += proof_lines(said[key], [e for e in entries if e["proof"] == key])
        found[block] = "\n".join(lines)
    count = sum(len(p.properties) for p in proofs)
    tools = result["tools"]
    names = [name for name in dict.fromkeys(p.block for p in proofs) if name in found]
    lines = [
        BEGIN,
        "",
        f"{count} properties in {len(proofs)} proofs of {len(names)} blocks; the last of them with {tools['yosys']}, "
        f"{tools['z3']}.",
        "",
        *(found[name] for name in names),
    ]
    return "\n".join([*lines, END, ""])


def proof_lines(proof, entries):
    """One proof of the page: assumptions, covers, times, properties."""
    relative = "../" + "/".join(proof.wrapper.parts[-5:])
    lines = [f"[`{proof.key}`]({relative}): {proof.title}.", ""]
    lines += [f"- assumed: {text}" for text in proof.assumes]
    covers = [
        f"{says} (clock {entries[0]['covers'].get(name, '-')})"
        for name, says in proof.covers.items()
    ]
    lines.append(f"- reached: {'; '.join(covers)}")
    times = [
        f"{e['design']} k = {e['k']}, {e['base_seconds']:.1f} s + {e['induction_seconds']:.1f} s"
        for e in entries
    ]
    lines += [
        f"- base + induction: {'; '.join(times)}",
        "",
        "| property | holds | fails with, in clock |",
        "|---|---|---|",
    ]
    for entry in entries[0]["properties"]:
        file, _, name = entry["defect"].rpartition("/")
        lines.append(
            f"| `{entry['name']}` | {entry['says']} "
            f"| [{name}](../{file}), {entry['caught_at']} |"
        )
    return [*lines, ""]


def write(root, result):
    """The page's part between the markers, and docs/verification/proofs.json."""
    from . import catalog

    path = root / PAGE
    before, rest = path.read_text(encoding="utf-8").split(BEGIN, 1)
    old, after = rest.split(END, 1)
    after = after.lstrip("\n")
    proofs = catalog.read(root)
    text = before + generated(result, proofs, old) + ("\n" + after if after else "")
    outputs.write_whole(path, text)
    run = {entry["proof"] for entry in result["proofs"]}
    of_all = all(p.key in run for p in proofs)
    put = block_results.write if of_all else block_results.merge
    put(root, "proofs", "./feltgate prove --update", per_block(result))


def per_block(result):
    """The row of each block in docs/blocks.md; seconds of base and induction."""
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


def counted(root, proofs):
    """What docs/verification/proofs.json lacks of the proofs as they are."""
    found = block_results.read(root, "proofs")
    there = {name: row["properties"] for name, row in found["blocks"].items()} if found else {}
    wanted = {}
    for proof in proofs:
        wanted[proof.block] = wanted.get(proof.block, 0) + len(proof.properties)
    return (
        []
        if there == wanted
        else [f"the properties of each block in {block_results.path_of('', 'proofs')}"]
    )


def check(root, proofs):
    """Whether the page tells of every property, defect, assumption and cover as they are now."""
    part = (root / PAGE).read_text(encoding="utf-8").split(BEGIN, 1)[1].split(END, 1)[0]
    missing = counted(root, proofs)
    count = sum(len(p.properties) for p in proofs)
    if f"{count} properties in {len(proofs)} proofs" not in part:
        missing.append(f"{count} properties in {len(proofs)} proofs")
    for proof in proofs:
        wanted = [f"`{proof.key}`", f": {proof.title}.", *proof.assumes, *proof.covers.values()]
        wanted += [f"{design} k = " for design in proof.designs]
        wanted += [f"| `{e.name}` | {e.says} | [{e.defect.stem}]" for e in proof.properties]
        missing += [text for text in wanted if text not in part]
    for text in missing:
        print(f"{PAGE}: stale, lacks: {text}; run ./feltgate prove --update", file=sys.stderr)
    return 1 if missing else 0
