# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Which inputs were proven: docs/verification/proven.json, so that they are not proven every time.

  {"schema": "feltgate-proven/1", "tools": {...}, "inputs": {"ramp.steps lever": "16 hex digits"}}

The digits are a hash of everything that decides base, induction and covers: the sources as the
proof reads them, without comments and without constants and functions that nothing names, its depths and cuts,
and the scripts that run them. They do not depend on the programs: what one version has proven is
proven. `tools` are those of the last entries.
"""

import hashlib
import json
import re
import tempfile
from collections import Counter
from pathlib import Path

import outputs
from seeded_defects.patches import code_only

from . import catalog, tasks, tools

SCHEMA = "feltgate-proven/1"
FILE = "docs/verification/proven.json"


def name(proof, design):
    return f"{proof.key} {design}"


def without_unnamed(texts):
    """The texts without the constants and functions of packages that no other line names: those of
    an option, say, that the proof does not read."""
    words = Counter(re.findall(r"\w+", " ".join(texts)))
    constant = r" localparam [\w \[\]:-]*?(\w+) = [^;]*;"
    function = r" function automatic [^;]*?(\w+) ?\([^;]*;.*?endfunction"

    def named(found):
        inside = re.findall(r"\w+", found[0]).count(found[1])
        return found[0] if words[found[1]] > inside else ""

    texts = [re.sub(function, named, t) for t in texts]
    return [re.sub(constant, named, t) for t in texts]


def digest(root, proof, design):
    """16 hex digits of what decides the proof on a design."""
    found = hashlib.sha256()
    fields = (proof.top, proof.depth, proof.cover_depth, proof.defines, proof.cut, proof.abstract)
    found.update(repr((fields, design)).encode())
    for script in (tools, tasks):
        _, _, code = Path(script.__file__).read_text(encoding="utf-8").split('"""', 2)  # behind its head
        found.update(code.encode())
    with tempfile.TemporaryDirectory(prefix="feltgate-prove-") as folder:
        names = tools.copy_sources(root, proof, design, None, Path(folder))
        texts = [" ".join(code_only(Path(folder, n).read_text(encoding="utf-8"))) for n in names]
        for source, text in zip(names, without_unnamed(texts)):
            found.update(f"\n{source}: {text}".encode())
        if any("$readmemh" in text for text in texts):
            found.update(Path(folder, "parameters.mem").read_bytes())
    return found.hexdigest()[:16]


def read(root):
    """{proof and design: digits}; nothing where there is no record. CatalogError for a broken one."""
    path = Path(root, FILE)
    if not path.is_file():
        return {}
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        if found["schema"] != SCHEMA:
            raise ValueError(f"its schema is {found['schema']}, not {SCHEMA}")
        return dict(found["inputs"])
    except (ValueError, KeyError, TypeError) as error:
        raise catalog.CatalogError(
            f"{FILE}: is no record of proofs ({error}); take that of git, or remove it and run "
            "./feltgate prove --fast --record"
        ) from error


def known(root, proofs, first_only):
    """The proofs of which all inputs are on record."""
    inputs = read(root)
    return [
        proof
        for proof in proofs
        if all(
            inputs.get(name(proof, design)) == digest(root, proof, design)
            for design in tasks.designs(proof, first_only)
        )
    ]


def write(root, rows, versions):
    """Enters the inputs of these rows, all of them good, beside those that the record has."""
    inputs = read(root)
    for row in rows:
        inputs[name(row.proof, row.design)] = digest(root, row.proof, row.design)
    ordered = dict(sorted(inputs.items()))
    outputs.write_json(Path(root, FILE), {"schema": SCHEMA, "tools": versions, "inputs": ordered})
