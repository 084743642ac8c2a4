#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of the RTL: would the tests notice if it were wrong in some place?

Yosys makes a netlist of each block and changes one bit at one pin of one cell: inverted, stuck, or
inverted by another bit. 400 such mutants of a block (60 % of what there is where that is less) are
in one netlist behind its ports, Verilated once and chosen at run time; the block's own test program
runs in lock-step with the twin until it notices. What survives is proven to be the same circuit
(yosys-abc), is listed in testbench/campaigns/mutate/rtl.toml with the reason, or is a gap in the test.
--show prints one mutant with its lines of source, cell and fate, and inputs for which it differs.
Method, results and what this does not say: docs/testing.md

Exit code: 0 all tests kill the share that is required, 1 one does not, 2 when a tool, a file or an
argument is wrong.

  feltgate mutate                        all blocks
  feltgate mutate limiter ramp           two blocks
  feltgate mutate limiter --count 30     a share of the mutants, chosen by --seed
  feltgate mutate limiter --again old.json
                                         what survived then, after tests have been added
  feltgate mutate limiter --show 17      one mutant
  feltgate mutate --list                 what there is; runs nothing
  feltgate mutate --twin                 the headers of the C++ twin instead
"""

import json
import sys

import block_results
import building
import command_line
import outputs
from mutation import rtl, rtl_table
from mutation.options import mutants_parser, parsed

SCHEMA = "feltgate-mutate/1"
REQUIRED = 0.99


def arguments(argv):
    parser = mutants_parser("mutate", __doc__, "BLOCK", "a block, one of its tests, or BLOCK.TEST", 0)
    command_line.add_number(parser, "--show", None, "one mutant of one test, for a person")
    what = "for the proof that a survivor is equivalent, 0: none"
    command_line.add_number(parser, "--proof-seconds", 20, what)
    what = f"put the results of these blocks into {block_results.FOLDER}/mutants.json"
    twin = "mutants of the C++ twin; its options: --twin --help"
    command_line.add_flags(parser, update=what, twin=twin)
    options = parsed(parser, argv, REQUIRED)
    command_line.refuse_beside(parser, options, "list", "show")
    command_line.refuse_beside(parser, options, "show", "update", "json", "again")
    if options.again and options.count:
        parser.error("--again tries what survived; leave --count away")
    if options.update and (options.count or not options.proof_seconds):
        parser.error("--update takes a run of all mutants, with proofs")
    return options


def chosen(found, wanted):
    """The tests of these names, or all; MutateError where there is none."""
    if not found:
        raise rtl.MutateError(
            "the build folder knows no mutants: it was configured without tests, or without yosys"
        )

    def unknown(words):
        names = ", ".join(dict.fromkeys(t.block for t in found))
        return rtl.MutateError(f"no block {words} with mutants; there are {names}")

    return command_line.chosen(found, wanted, rtl.Test.names, unknown)


def update(root, rows):
    """Puts rtl = [killed, relevant] of these blocks beside what the file has."""
    blocks = {}
    for row in rows:
        entry = blocks.setdefault(row.test.block, {"rtl": [0, 0], "seconds": 0.0})
        entry["rtl"][0] += row.dead()
        entry["rtl"][1] += row.relevant()
        entry["seconds"] = round(entry["seconds"] + row.seconds, 1)
    block_results.merge(root, "mutants", "./feltgate mutate [--twin] --update", blocks)


def report(options, root, rows):
    """Prints and writes the rows; the exit code."""
    rtl_table.print_survivors(rows, options.survivors)
    print(rtl_table.table(rows))
    bad = [row.test.name for row in rows if row.share() < options.require]
    tried = sum(row.tried() for row in rows)
    killed, relevant = sum(map(rtl.Row.dead, rows)), sum(map(rtl.Row.relevant, rows))
    print(
        f"{tried} mutants in {len(rows)} tests, {killed} of {relevant} not equivalent ones killed "
        f"({100 * killed / max(1, relevant):.1f} %); "
        f"{len(bad)} tests below {100 * options.require:.0f} %{': ' if bad else ''}{', '.join(bad)}"
    )
    if options.json:
        result = {
            "schema": SCHEMA,
            "count": options.count,
            "seed": options.seed,
            "required": options.require,
            "tests": [row.as_json() for row in rows],
        }
        outputs.write_json(options.json, result)
    if options.update:
        update(root, rows)
        print(f"mutate: wrote {block_results.path_of(root, 'mutants')}")
    return 1 if bad else 0


def earlier(path):
    """Results of an earlier --json; MutateError where it has none."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        if found["schema"] != SCHEMA:
            raise ValueError(f"its schema is not {SCHEMA}")
        for test in found["tests"]:
            rtl.check_earlier(test)
        return found
    except (OSError, ValueError, KeyError, TypeError) as error:
        missing = "it has no " if isinstance(error, KeyError) else ""
        why = error.strerror if isinstance(error, OSError) else error
        raise rtl.MutateError(
            f"{path}: no results of 'feltgate mutate --json': {missing}{why}; give such a file"
        ) from error


def check_whole(everything, tests):
    """MutateError where a block has more tests than these: its row is of all of them."""
    for block in dict.fromkeys(test.block for test in tests):
        missing = [t.name for t in everything if t.block == block and t not in tests]
        if missing:
            raise rtl.MutateError(
                f"--update takes all tests of {block}; {', '.join(missing)} is left out"
            )


def run(options):
    """The exit code."""
    results = earlier(options.again) if options.again else None
    if options.only_arguments:
        return 0
    root, build = command_line.root(), command_line.build_folder()
    everything = rtl.tests(build)
    tests = chosen(everything, options.name)
    if options.update:
        check_whole(everything, tests)
    if options.list:
        for test in tests:
            print(f"{test.name}: {test.block}, {test.program.name}")
        return 0
    if not options.no_build:
        building.make("mutate", build, [test.program.name for test in tests], options.jobs)
    for test in tests:
        test.read()
    if options.show is not None:
        if len(tests) != 1:
            raise rtl.MutateError(f"--show takes one test: {', '.join(t.name for t in tests)}")
        rtl.show(tests[0], options.show, root, options.proof_seconds)
        return 0
    return report(options, root, rtl.run(tests, root, options, results))


def main(argv=None):
    argv = sys.argv[1:] if argv is None else argv
    if "--twin" in argv:
        from mutation import twin

        return twin.main([word for word in argv if word != "--twin"])
    options = arguments(argv)
    return command_line.ended("mutate", lambda: run(options))


if __name__ == "__main__":
    sys.exit(main())
