# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Results of each block: docs/verification/KIND.json, of which `feltgate docs` makes a table.

The command that measures writes its kind's file with --update; it is committed. A row of "blocks" has the keys of
KINDS, CPU seconds, and for each key where, when and on which commit it was measured. A count is [reached, of]. What
is missing is a dash in the table. A row that is not a block of rtl/ is CORE or a header of the twin.
"""

import datetime
import json
import os
import subprocess
from pathlib import Path

from command_line import Refused
import outputs

SCHEMA = "feltgate-results/2"
FOLDER = "docs/verification"
# kind: {key: its heading}
KINDS = {
    "proofs": {"properties": "properties proven"},
    "coverage": {"line": "lines", "branch": "branches", "toggle": "toggles", "cover": "cover points"},
    "mutants": {"rtl": "RTL mutants killed", "twin": "twin mutants killed"},
    "faults": {"unsafe": "flips unsafe", "silent": "flips silent"},
}
CORE = "whole core"  # a row beside the blocks
HEADERS = "model/include/feltgate"
DASH = "-"


class ResultsError(Refused):
    """A file of results that is wrong; the message names it and says what."""


def path_of(root, kind):
    """The file of a kind."""
    return Path(root, FOLDER, f"{kind}.json")


def machine():
    """Cores and processor, as the kernel names it."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return f"{os.cpu_count()} cores, {names[0] if names else 'processor unknown'}"


def today():
    return datetime.date.today().isoformat()


def stamp(root):
    """Date, commit and machine of a measurement that is made now."""
    words = ["git", "-C", str(root), "describe", "--always", "--dirty", "--exclude=*"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return f"{today()}, {done.stdout.strip() or 'no commit'}, {machine()}"


def check(kind, blocks, where):
    """ResultsError where a row has another key than its kind, or a value that is none."""
    for block, found in blocks.items():
        for key, value in found.items():
            if key in ("seconds", "measured"):
                continue
            number = isinstance(value, (int, float)) and not isinstance(value, bool)
            pair = isinstance(value, list) and len(value) == 2 and 0 <= value[0] <= value[1]
            if key not in KINDS[kind] or not (number or pair):
                raise ResultsError(f"{where}: {block}, {key}: {value!r} is no {kind} of a block")


def merge(root, kind, command, rows):
    """Puts these rows' keys beside what the file has."""
    before = read(root, kind)
    write(root, kind, command, rows, before["blocks"] if before else {})


def write(root, kind, command, rows, before=None):
    """Puts the results of `command`, measured now, into the file of a kind, beside rows of `before`."""
    now, blocks = stamp(root), dict(before or {})
    for name, found in rows.items():
        row = blocks.get(name, {})
        measured = row.get("measured", {}) | dict.fromkeys(found.keys() & KINDS[kind].keys(), now)
        blocks[name] = row | found | {"measured": dict(sorted(measured.items()))}
    where = path_of(root, kind)
    check(kind, blocks, where)
    # One line per block, so that a change is seen as one.
    lines = [f"    {json.dumps(name)}: {json.dumps(blocks[name])}" for name in sorted(blocks)]
    head = json.dumps({"schema": SCHEMA, "kind": kind, "command": command})[1:-1]
    where.parent.mkdir(parents=True, exist_ok=True)
    outputs.write_whole(where, "\n".join([f"{{{head},", '  "blocks": {', ",\n".join(lines), "  }", "}", ""]))


def read(root, kind):
    """The file's object; None where it is not there."""
    where = path_of(root, kind)
    if not where.exists():
        return None
    try:
        found = json.loads(where.read_text(encoding="utf-8"))
        if (found["schema"], found["kind"]) != (SCHEMA, kind):
            raise ValueError(f"is no {SCHEMA} of {kind}")
        check(kind, found["blocks"], where)
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ResultsError(f"{where}: {error}") from error
    return found


def cell(value):
    """A count, a number or a dash."""
    if value is None:
        return DASH
    return f"{value[0]} of {value[1]}" if isinstance(value, list) else str(value)


def table(root, names):
    """Lines of the table, one row per block, and what each kind was measured with."""
    kinds = {kind: found for kind in KINDS if (found := read(root, kind))}
    beside = sorted({name for found in kinds.values() for name in found["blocks"]} - set(names))
    strange = [name for name in beside if name != CORE and not Path(root, HEADERS, f"{name}.hpp").exists()]
    if strange:
        raise ResultsError(f"{FOLDER}: results of {', '.join(strange)}, which is no block")
    keys = [(kind, key) for kind, them in KINDS.items() for key in them]
    lines = ["| block | " + " | ".join(KINDS[kind][key] for kind, key in keys) + " | s of CPU |",
             "|---|" + "---|" * (len(keys) + 1)]
    for name in [*names, *beside]:
        of = {kind: found["blocks"].get(name, {}) for kind, found in kinds.items()}
        seconds = sum(row.get("seconds", 0) for row in of.values())
        cells = [cell(of.get(kind, {}).get(key)) for kind, key in keys] + [str(round(seconds)) if seconds else DASH]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    for kind, found in kinds.items():
        stamps = sorted(s for row in found["blocks"].values() for s in row.get("measured", {}).values())
        span = "; ".join(dict.fromkeys((stamps[0], stamps[-1]))) if stamps else "never"
        lines += ["", f"{kind}: `{found['command']}`, from first to last: {span}"]
    return lines
