# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Budget of `feltgate synth`: the last measurements, which --update writes, and how much a figure may
grow past them."""

import datetime
import json
import os
import platform

import outputs

AREA = ("lut4_equivalents", "ff", "cyclone_cells", "cyclone_ff")
EXACT = ("mult18", "bram", "m9k", "memory_bits")
AREA_MARGIN = 0.03  # of the figure, and
AREA_SLACK = 4  # cells more: a small block may not grow by a fraction of one
SPEED_MARGIN = 0.10  # seeds alone move Fmax by half of this
FILE = "docs/verification/areas.json"


def read(path):
    if not path.exists():
        return {"measured": {}, "figures": {}}
    return json.loads(path.read_text(encoding="utf-8"))


def stamp(tools):
    """When, on what and with what a figure was measured."""
    machine = f"{platform.machine()}, {os.cpu_count()} cores"
    return {"date": datetime.date.today().isoformat(), "machine": machine, **tools}


def merge(budget, measured, tools):
    """The budget with the measured rows replaced; a row keeps the figures not measured now."""
    figures = {design: dict(rows) for design, rows in budget["figures"].items()}
    for design, rows in measured.items():
        there = figures.setdefault(design, {})
        for name, row in rows.items():
            there[name] = there.get(name, {}) | row
    return budget | {"measured": stamp(tools), "figures": figures}


def text_of(table, indent=""):
    """JSON of a table; of one that holds tables a line each, so that a change is seen as one."""
    if not any(isinstance(value, dict) for value in table.values()):
        return json.dumps(table)
    lines = [f"{indent} {json.dumps(key)}: {text_of(of, indent + ' ')}" for key, of in table.items()]
    return "{\n" + ",\n".join(lines) + f"\n{indent}}}"


def write(path, budget):
    outputs.write_whole(path, text_of(budget) + "\n")


def compare(budget, measured, tools):
    """One line for each figure past its budget."""
    grown = []
    for design, rows in measured.items():
        for name, row in rows.items():
            was = budget["figures"].get(design, {}).get(name)
            if was is None:
                grown.append(f"synth: {design}, {name}: no budget; synth --update writes it")
                continue
            for key, value in row.items():
                if key in was and past(key, value, was[key]):
                    grown.append(f"synth: {design}, {name}: {key} {value}, budget {was[key]}")
    before = budget["measured"].get("yosys")
    if grown and before and before != tools["yosys"]:
        grown.append(f"synth: the budget is of {before}, this is {tools['yosys']}")
    return grown


def known(budget, measured):
    """Those of the measured rows that have a budget."""
    return {
        design: {name: row for name, row in rows.items() if name in budget["figures"].get(design, {})}
        for design, rows in measured.items()
    }


def past(key, value, was):
    if key in AREA:
        return value > was * (1 + AREA_MARGIN) + AREA_SLACK
    if key in EXACT:
        return value > was
    return key == "fmax_mhz" and value < was * (1 - SPEED_MARGIN)
