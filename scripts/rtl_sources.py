# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The files of the RTL, in the order in which any tool can read them: packages, then each module
after those that it instantiates. scripts/check_blocks.py writes the lists."""

import re

CORE = "feltgate_core"
CELL_WRAPPERS = ("mult18_ecp5",)  # one cell of one vendor: no other vendor's source
NO_BLOCKS = ("feltgate_checks",)  # elaborated, never clocked: no twin, no test of its own block


def code_only(text):
    """SystemVerilog without comments."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def instantiated(text, names):
    """Those of the names that the text instantiates, as they appear."""
    found = re.findall(r"\b([a-z]\w*)\s*(?:#\s*\(|\s[a-z]\w*\s*\()", code_only(text))
    return [name for name in dict.fromkeys(found) if name in names]


def modules(root):
    """{name: path below rtl/} of the modules in order, and those that the core does not reach."""
    paths = {p.stem: p for p in sorted(root.glob("rtl/*.sv")) if p.stem not in CELL_WRAPPERS}
    texts = {name: path.read_text(encoding="utf-8") for name, path in paths.items()}
    ordered = {}

    def visit(name, above):
        if name in ordered or name in above:
            return
        for below in instantiated(texts[name], paths.keys() - {name}):
            visit(below, above | {name})
        ordered[name] = paths[name].name

    if CORE in paths:
        visit(CORE, frozenset())
    reached = set(ordered)
    for name in paths:
        visit(name, frozenset())
    return ordered, [name for name in paths if CORE in paths and name not in reached]


def core_files(root):
    """Files of the core below rtl/ that are equal in all designs, in order."""
    packages = sorted(path.name for path in root.glob("rtl/generated/*_pkg.sv"))
    return [*(f"generated/{name}" for name in packages), *modules(root)[0].values()]


def cell_files(root):
    """Files below rtl/ that a vendor's cells need beside them."""
    return [f"{name}.sv" for name in CELL_WRAPPERS if (root / f"rtl/{name}.sv").exists()]
