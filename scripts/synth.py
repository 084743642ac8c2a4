#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Area and speed of the core and its blocks on ECP5, cells on Cyclone IV E, bitstreams of boards.

Yosys and nextpnr only: nothing here ran on a chip. Recipe and figures: docs/synthesis.md.
Exit code: 0 within the budget (docs/verification/areas.json), 1 when a figure has grown past it,
2 when a tool or an argument is wrong. Of a board 1 too where its timing does not close.

  feltgate synth                                   all blocks of lever, against the budget
  feltgate synth --design lever --block core --json core.json
  feltgate synth --board ulx3s --design my.toml    a bitstream, where the timing closes
  feltgate synth --board tang_nano_9k              the same for Gowin: design lever at 54 MHz
  feltgate synth --board de0_nano                  how full its chip would be
"""

import os
import re
import sys
import tempfile
from pathlib import Path

import command_line
import outputs
import synth_board
import synth_budget
import synth_measure
import synth_report
from synth_tools import ToolError, Tools, package_of, version

SCHEMA = "feltgate-synth/1"


def arguments():
    parser = command_line.parser("synth", __doc__)
    add = {"action": "append"}
    what = "a design point or a file of your own; default: lever"
    parser.add_argument("--design", metavar="DESIGN", help=what, **add)
    what = "a block, or 'core'; default: all; of several the sum too, each as often as named"
    parser.add_argument("--block", metavar="BLOCK", help=what, **add)
    what = "the whole of a board instead of the blocks; docs/boards"
    parser.add_argument("--board", choices=synth_board.BOARDS, help=what)
    what = "the bitstream of --board ulx3s or tang_nano_9k; default ulx3s.bit, tang_nano_9k.fs"
    command_line.add_path(parser, "-o", "--output", what=what)
    parser.add_argument("--seeds", metavar="N[,N...]", default="1,2,3", help="of nextpnr; default 1,2,3")
    command_line.add_path(parser, "--json", what="write the figures here")
    command_line.add_flags(
        parser,
        update="write budget and documentation",
        no_route="area only, without nextpnr",
    )
    options = parser.parse_args()
    outputs.check(parser, json=options.json, output=options.output)
    if options.board and (options.block or len(options.design or []) > 1):
        parser.error("--board takes one --design and no --block")
    if options.output and options.board not in synth_board.ROUTED:
        parser.error(f"-o is the bitstream of --board {' or '.join(synth_board.ROUTED)}; no other is made here")
    if not re.fullmatch(r"\d+(,\d+)*", options.seeds):
        parser.error(f"--seeds {options.seeds}: wants whole numbers with commas between, as 1,2,3")
    return options


def chosen(root, blocks):
    rows = synth_measure.targets(root)
    if not blocks:
        return rows
    rows += synth_measure.beside_targets(root)
    wanted = {synth_measure.CORE if block == "core" else block for block in blocks}
    unknown = wanted - {row.module for row in rows}
    if unknown:
        names = ", ".join(sorted({row.module for row in rows} - {synth_measure.CORE}))
        raise ToolError(f"no block {', '.join(sorted(unknown))}; there are core, {names}")
    return [row for row in rows if row.module in wanted]


def progress(text):
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def update(root, measured, tools):
    """The budget, with what was measured."""
    path = root / synth_budget.FILE
    synth_budget.write(path, synth_budget.merge(synth_budget.read(path), measured, tools))
    print(f"synth: wrote {synth_budget.FILE}")


def measure(options, root):
    designs = options.design or ["lever"]
    rows = chosen(root, options.block)
    seeds = [int(seed) for seed in options.seeds.split(",")]
    keep = os.environ.get("FELTGATE_BUILD")
    measured = {}
    with tempfile.TemporaryDirectory(prefix="feltgate-synth-") as temporary:
        for given in designs:
            design = Path(given).stem
            folder = Path(keep or temporary, "synth", design)
            folder.mkdir(parents=True, exist_ok=True)
            tools, package = Tools(folder), package_of(root, given, folder / "design")
            if options.no_route or tools.nextpnr is None:
                if not options.no_route:
                    print("synth: no nextpnr-ecp5, so no speed", file=sys.stderr)
                seeds = []
            measured[design] = {}
            for index, row in enumerate(rows):
                progress(f"{design}: {row.name} ({index + 1} of {len(rows)})")
                measured[design][row.name] = synth_measure.measure(tools, root, package, row, seeds)
            progress("")
            print(synth_report.text_table(design, measured[design], options.block or ()))
            print()
    used = {"yosys": version(tools.yosys), "nextpnr": version(tools.nextpnr)}
    return measured, used


def run(options):
    """The exit code."""
    root = command_line.root()
    fine = True
    if options.board:
        measured, tools, fine = synth_board.run(options, root, progress)
    else:
        measured, tools = measure(options, root)
    if options.json:
        result = {"schema": SCHEMA, "tools": tools, "designs": measured}
        outputs.write_json(options.json, result)
    if options.update:
        update(root, measured, tools)
        return 0
    budget = synth_budget.read(root / synth_budget.FILE)
    if options.board or not measured.keys() <= budget["figures"].keys():  # one's own design has no budget
        measured = synth_budget.known(budget, measured)
    grown = synth_budget.compare(budget, measured, tools)
    if any(measured.values()):
        print("\n".join(grown) if grown else "synth: within the budget")
    return 0 if fine and not grown else 1


def main():
    options = arguments()
    return command_line.ended("synth", lambda: run(options), ValueError)


if __name__ == "__main__":
    sys.exit(main())
