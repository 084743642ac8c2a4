#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants: would the tests notice if the RTL, or its C++ twin, were wrong in some place?

Of the RTL, Yosys makes a netlist of each block and changes one bit at one pin of one cell: inverted,
stuck, or inverted by another bit. 400 such mutants of a block (60 % of what there is where that is
less) are in one netlist behind its ports, and the block's own test program runs in lock-step with the
twin. With --twin a header of model/include/feltgate is changed in one place: another operator, a
constant one off, a condition turned round or left out, a statement removed, arguments swapped,
another rounding. Each mutant runs until a test case fails.

What survives is printed with its place and the command that runs it: it is equivalent, or a test is
missing. The share that is killed must reach that of docs/verification/mutants.json, in whole percents;
a sample may miss it by three standard deviations. Method: docs/testing.md

Exit code: 0 all reach the share, 1 one does not, 2 when a tool, a file or an argument is wrong.

  feltgate mutate                        all blocks
  feltgate mutate observer ramp          two blocks
  feltgate mutate observer --count 30    some of the mutants, chosen by --seed
  feltgate mutate --twin ramp            200 mutants of a header
  feltgate mutate --twin ramp --list     all that there are; runs nothing
"""

import sys

import block_results
import command_line
import outputs
from mutation import rtl, runs, twin

SCHEMA = "feltgate-mutate/2"
OF_HEADER = 200  # where --count does not say


def arguments(argv):
    parser = command_line.parser("mutate", __doc__)
    what = "a block, one of its tests, BLOCK.TEST, or a header without .hpp; default: all"
    parser.add_argument("name", nargs="*", metavar="NAME", help=what)
    command_line.add_flags(parser, twin="mutants of the C++ twin", list="what there is; runs nothing")
    what = f"mutants of each, 0: all; default: all of a block, {OF_HEADER} of a header"
    command_line.add_number(parser, "--count", None, what)
    command_line.add_number(parser, "--seed", 1, "which ones, where --count leaves some out")
    share = {"type": command_line.share, "metavar": "SHARE"}
    parser.add_argument("--require", **share, help="to be killed, instead of the recorded share")
    command_line.add_jobs(parser, "programs")
    command_line.add_json(parser)
    update = f"put the results into {block_results.FOLDER}/mutants.json, where none is below what it has"
    command_line.add_flags(parser, update=update, no_build="run the programs that are there")
    command_line.add_only_arguments(parser)
    options = parser.parse_args(argv)
    command_line.refuse_beside(parser, options, "list", "update", "json", "count", "require")
    command_line.refuse_beside(parser, options, "update", "count", "require")
    outputs.check(parser, [], json=options.json)
    return options


def update(root, key, rows):
    """Puts [killed, tried] of these rows beside what the file has."""
    lower = [row.name for row in rows if row.share() < row.least]
    if lower:
        raise runs.MutateError(f"less killed than the record has: {', '.join(lower)}; nothing is written")
    results = {row.name: {key: [row.count(*runs.DEAD), len(row.verdicts)]} for row in rows}
    for row in rows if key == "rtl" else ():
        results[row.name]["seconds"] = row.seconds()
    block_results.merge(root, "mutants", "./feltgate mutate [--twin] --update", results)
    print(f"mutate: wrote {block_results.path_of('', 'mutants')}")


def run(options):
    """The exit code."""
    side, key = (twin, "twin") if options.twin else (rtl, "rtl")
    root = command_line.root()
    if options.only_arguments:
        if options.twin:
            twin.tests(root, options.name)
        return 0
    if options.list:
        print("\n".join(side.listed(options)))
        return 0
    subjects, folder = side.subjects(options)
    folder.mkdir(parents=True, exist_ok=True)
    count = options.count if options.count is not None else OF_HEADER if options.twin else 0
    found = runs.Runs(folder, options.jobs).verdicts(subjects, count, options.seed)
    rows = runs.rows_of(root, key, subjects, found, options.require)
    runs.print_rows(root, rows)
    bad = [row.name for row in rows if row.is_bad()]
    print(f"{len(found)} mutants; below their least share: {', '.join(bad) or 'none'}")
    if options.json:
        head = {"schema": SCHEMA, "of": key, "count": count, "seed": options.seed}
        outputs.write_json(options.json, head | {"rows": [row.as_json() for row in rows]})
    if options.update:
        update(root, key, rows)
    return 1 if bad else 0


def main(argv=None):
    options = arguments(argv)
    return command_line.ended("mutate", lambda: run(options))


if __name__ == "__main__":
    sys.exit(main())
