# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Results of each block: docs/verification/KIND.json, and the table of docs/blocks.md.

There is one file per kind. The command that measures writes it with --update; it is committed:

  {"schema": "feltgate-results/1", "kind": "coverage", "command": "...", "machine": "...", "date":
  "2026-11-20",
   "blocks": {"dob": {"line": [40, 40], ..., "seconds": 12.5}}}

A count is [reached, of]. The keys of each kind are in KINDS; seconds are of CPU time. A missing
block, key or file is a dash in the table. Rows that are not a block of rtl/ are named in EXTRA. If
blocks are measured one by one, "dates" of a row says when each of its keys was measured, and "machines" on
which machine; the file's own date and machine hold for all others. "sources" of a row is the
fingerprint of the source on which each key was measured, so that the table can mark results of an
earlier source.
"""

import datetime
import hashlib
import json
import os
import re
from pathlib import Path

from command_line import Refused
import outputs
import rtl_sources

SCHEMA = "feltgate-results/1"
FOLDER = "docs/verification"
# kind: {key: what it is}; a key is a count [reached, of] unless it is said to be a number.
KINDS = {
    "proofs": {"properties": "proven, and seen to fail with a defect (number)"},
    "coverage": {
        "line": "lines",
        "branch": "branches",
        "toggle": "bits that changed twice at least",
        "cover": "cover points",
    },
    "mutants": {
        "rtl": "mutants of the RTL killed, of those not equivalent, by proof or by argument",
        "twin": "mutants of the twin killed, of those not equivalent, by argument",
    },
    "faults": {
        "unsafe": "single flips of the safety state that ended unsafe",
        "silent": "the same, in a torque or position that is wrong and unflagged",
    },
}
EXTRA = ("whole core", "twin of the core")  # rows beside the blocks
HEADINGS = {
    "properties": "properties proven",
    "line": "lines",
    "branch": "branches",
    "toggle": "toggles",
    "cover": "cover points",
    "rtl": "RTL mutants killed",
    "twin": "twin mutants killed",
    "unsafe": "flips unsafe",
    "silent": "flips silent",
}
DASH = "-"
EARLIER = "*"
BESIDE = ("dates", "machines", "sources")  # of a row: by key, no results


class ResultsError(Refused):
    """A file of results that is wrong; the message names it and says what."""


def path_of(root, kind):
    """The file of a kind."""
    return Path(root, FOLDER, f"{kind}.json")


def machine():
    """Cores and processor, as the kernel names it."""
    name = "processor unknown"
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            name = line.partition(":")[2].strip()
            break
    return f"{os.cpu_count()} cores, {name}"


def check(kind, blocks, where):
    """ResultsError where a row has another key than its kind, or a value that is none."""
    for block, found in blocks.items():
        for key, value in found.items():
            if key in BESIDE:
                strange = [k for k in value if k not in KINDS[kind] or k not in found]
                if strange:
                    raise ResultsError(
                        f"{where}: {block} has {key} of {', '.join(strange)}, which it has not"
                    )
                continue
            if key != "seconds" and key not in KINDS[kind]:
                known = ", ".join(KINDS[kind])
                raise ResultsError(
                    f"{where}: {block} has the key '{key}'; there are {known}, seconds, {', '.join(BESIDE)}"
                )
            pair = (
                isinstance(value, list)
                and len(value) == 2
                and all(isinstance(n, int) for n in value)
            )
            if isinstance(value, bool) or not (pair or isinstance(value, (int, float))):
                raise ResultsError(
                    f"{where}: {block}, {key}: {value!r} is no number and no [reached, of]"
                )
            if pair and not 0 <= value[0] <= value[1]:
                raise ResultsError(f"{where}: {block}, {key}: {value[0]} of {value[1]}")


def sources(root, block, key):
    """What a key of a block is measured on: its own file, of a row that is no block all of them."""
    if key == "twin" or block == EXTRA[1]:
        folder, pattern = Path(root, "model/include/feltgate"), "*.hpp"
    else:
        folder, pattern = Path(root, "rtl"), "*.sv"
    if block in EXTRA:
        return sorted(folder.glob(pattern) if pattern == "*.hpp" else (folder / "core").rglob(pattern))
    own = sorted(p for p in folder.rglob(pattern) if rtl_sources.measured_as(p.stem) == block)
    return [path for path in own if "generated" not in path.parts]


def fingerprint(root, block, key):
    """Eight digits of the sources, of which comments and blanks do not count."""
    text = "".join(path.read_text(encoding="utf-8") for path in sources(root, block, key))
    code = re.sub(r"//[^\n]*|/\*.*?\*/|\s+", "", text, flags=re.S)
    return hashlib.sha256(code.encode()).hexdigest()[:8]


def stamp(root, kind, rows):
    """Enters what the keys of these rows were measured on: the sources as they are."""
    for block, row in rows.items():
        keys = sorted(row.keys() & KINDS[kind].keys())
        if keys:
            row["sources"] = {key: fingerprint(root, block, key) for key in keys}


def today():
    return datetime.date.today().isoformat()


def merge(root, kind, command, rows):
    """Puts these rows' keys beside what the file has; each key keeps the date and the machine of
    its measurement."""
    before = read(root, kind)
    blocks = before["blocks"] if before else {}
    heads = (("dates", "date", today()), ("machines", "machine", machine()))
    for row in blocks.values():
        for many, one, _ in heads:
            known = row.keys() & KINDS[kind].keys()
            row[many] = dict.fromkeys(known, before[one]) | row.get(many, {})
    for block, found in rows.items():
        row = blocks.setdefault(block, {})
        for many, _, now in heads:
            measured = dict.fromkeys(found.keys() & KINDS[kind].keys(), now)
            row[many] = row.get(many, {}) | measured
        earlier = row.get("sources", {})
        stamp(root, kind, {block: found})
        row |= found
        row["sources"] = earlier | found.get("sources", {})
    for row in blocks.values():
        for many, _, now in heads:
            other = {key: of for key, of in sorted(row.pop(many).items()) if of != now}
            if other:
                row[many] = other
    put(root, kind, command, blocks)


def write(root, kind, command, blocks, date=None):
    """Puts the results of `command`, measured on `date` or today and on the sources as they are,
    where docs/blocks.md takes them from."""
    stamp(root, kind, blocks)
    put(root, kind, command, blocks, date)


def put(root, kind, command, blocks, date=None):
    """The file of a kind, of rows that say what they were measured on."""
    where = path_of(root, kind)
    check(kind, blocks, where)
    head = {
        "schema": SCHEMA,
        "kind": kind,
        "command": command,
        "machine": machine(),
        "date": date or today(),
    }
    # One line per block, so that a change is seen as one.
    lines = [f"  {json.dumps(key)}: {json.dumps(value)}," for key, value in head.items()]
    rows = [f"    {json.dumps(name)}: {json.dumps(blocks[name])}" for name in sorted(blocks)]
    text = "\n".join(["{", *lines, '  "blocks": {', ",\n".join(rows), "  }", "}", ""])
    where.parent.mkdir(parents=True, exist_ok=True)
    outputs.write_whole(where, text)


def read(root, kind):
    """The file's object; None where it is not there."""
    where = path_of(root, kind)
    if not where.exists():
        return None
    try:
        found = json.loads(where.read_text(encoding="utf-8"))
    except json.JSONDecodeError as error:
        raise ResultsError(f"{where}: {error}") from error
    if not isinstance(found, dict) or not isinstance(found.get("blocks"), dict):
        raise ResultsError(f"{where}: no object with blocks")
    if found.get("schema") != SCHEMA or found.get("kind") != kind:
        raise ResultsError(
            f"{where}: schema {found.get('schema')}, kind {found.get('kind')}; "
            f"wanted {SCHEMA}, {kind}"
        )
    check(kind, found["blocks"], where)
    return found


def when(found):
    """The date of a file's results, or the first and the last one, on each machine."""
    dates = {}
    for row in found["blocks"].values():
        for key in row.keys() & KINDS[found["kind"]].keys():
            where = row.get("machines", {}).get(key, found["machine"])
            dates.setdefault(where, set()).add(row.get("dates", {}).get(key, found["date"]))
    spans = []
    for where, them in sorted((dates or {found["machine"]: {found["date"]}}).items()):
        first, last = min(them), max(them)
        spans.append(f"{first if first == last else f'{first} to {last}'}, {where}")
    return "; ".join(spans)


def cell(value):
    """A count, a number or a dash."""
    if value is None:
        return DASH
    return f"{value[0]} of {value[1]}" if isinstance(value, list) else str(value)


def marked_cell(root, block, key, row):
    """A cell, with a mark where it is known to be of an earlier source of the block."""
    of = row.get("sources", {}).get(key)
    stale = of is not None and of != fingerprint(root, block, key)
    return cell(row.get(key)) + (EARLIER if stale else "")


def table(root, names):
    """Lines of the table, one row per block, and what each kind was measured with."""
    kinds = {kind: read(root, kind) for kind in KINDS}
    measured = {kind: found["blocks"] for kind, found in kinds.items() if found}
    strange = {n for blocks in measured.values() for n in blocks} - {*names, *EXTRA}
    if strange:
        raise ResultsError(f"{FOLDER}: results of {', '.join(sorted(strange))}, which is no block")
    keys = [(kind, key) for kind, them in KINDS.items() for key in them]
    lines = [
        "| block | " + " | ".join(HEADINGS[key] for _, key in keys) + " | s of CPU |",
        "|---|" + "---|" * (len(keys) + 1),
    ]
    for name in [*names, *(extra for extra in EXTRA if any(extra in b for b in measured.values()))]:
        cells = [
            marked_cell(root, name, key, measured.get(kind, {}).get(name, {})) for kind, key in keys
        ]
        seconds = [b[name]["seconds"] for b in measured.values() if "seconds" in b.get(name, {})]
        lines.append(
            f"| {name} | " + " | ".join(cells) + f" | {round(sum(seconds)) if seconds else DASH} |"
        )
    lines.append("")
    if any(EARLIER in line for line in lines):
        lines += [f"\\{EARLIER} measured before the last change of the block's own source.", ""]
    for kind, found in kinds.items():
        if found:
            lines.append(f"- {kind}: `{found['command']}`, {when(found)}")
    return lines
