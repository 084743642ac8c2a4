# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Budget of `feltgate synth`: the last measurements, and how much a figure may grow past them."""

import datetime
import os
import platform
import tomllib

AREA = ("lut4_equivalents", "ff", "cyclone_cells", "cyclone_ff")
EXACT = ("mult18", "bram", "m9k", "memory_bits")
AREA_MARGIN = 0.03  # of the figure, and
AREA_SLACK = 4  # cells more: a small block may not grow by a fraction of one
SPEED_MARGIN = 0.10  # seeds alone move Fmax by half of this
HEAD = """# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Written by `feltgate synth --update` from what it measured; docs/synthesis.md is made from it.
# A run fails when area grows by more than {area:.0%} and {slack} cells, or Fmax falls by more than
# {speed:.0%}, or a multiplier or block RAM is added.
"""


def read(path):
    if not path.exists():
        return {"measured": {}, "figures": {}, "scene_sets": {}}
    return {"scene_sets": {}} | tomllib.loads(path.read_text(encoding="utf-8"))


def stamp(tools):
    """When, on what and with what a figure was measured."""
    machine = f"{platform.machine()}, {os.cpu_count()} cores"
    return {"date": datetime.date.today().isoformat(), "machine": machine, **tools}


def merge_scene_sets(budget, measured, tools):
    """The budget with the measured scene sets, {design: {set: row}}, replaced."""
    sets = {design: dict(rows) for design, rows in budget["scene_sets"].items()}
    for design, rows in measured.items():
        sets.setdefault(design, {}).update(rows)
    return budget | {"scene_sets": sets, "scene_sets_measured": stamp(tools)}


def merge(budget, measured, tools):
    """The budget with the measured rows replaced; a row keeps the figures not measured now."""
    figures = {design: dict(rows) for design, rows in budget["figures"].items()}
    for design, rows in measured.items():
        there = figures.setdefault(design, {})
        for name, row in rows.items():
            there[name] = there.get(name, {}) | row
    return budget | {"measured": stamp(tools), "figures": figures}


def entries(table):
    return [
        f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value}"
        for key, value in table.items()
    ]


def write(path, budget):
    lines = [HEAD.format(area=AREA_MARGIN, slack=AREA_SLACK, speed=SPEED_MARGIN), "[measured]"]
    lines += entries(budget["measured"])
    if "scene_sets_measured" in budget:
        lines += ["", "[scene_sets_measured]", *entries(budget["scene_sets_measured"])]
    for kind in ("figures", "scene_sets"):
        for design, rows in budget[kind].items():
            for name, row in rows.items():
                lines += ["", f'[{kind}.{design}."{name}"]', *entries(row)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


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
