#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What of the RTL the block tests reach: lines, branches, bits, cover points.

Each block test is built a second time on RTL that counts (verilator --coverage) and run with its
usual stimulus. From Verilator's raw data, not from its own percentage, over all programs and
instances:

  lines, branches   reached at all; must be all of them
  toggles           each bit of each signal changed twice at least outside of a reset; must be 98 %
  cover points      named situations (testbench/campaigns/coverage/points_*.sv); must be all of them

What cannot be reached is waived, with its reason, in testbench/campaigns/coverage/waivers.toml, ten times at
most. 'whole core' is what the core's own tests reach, each instance for itself; no target. What it
says and does not say: docs/testing.md

Exit code: 0 all targets are met, 1 a block misses one or a waiver is of no use, 2 when a tool, a
file or an argument is wrong or a test fails.

  feltgate coverage                     all blocks: about ten minutes of CPU time
  feltgate coverage pwm quad_decoder    the tests of two blocks
  feltgate coverage --list              which tests there are; builds nothing
"""

import sys

import block_results
import building
import command_line
import outputs
from rtl_coverage import data, programs, report, waivers

SCHEMA = "feltgate-coverage/1"

def arguments(argv):
    parser = command_line.parser("coverage", __doc__)
    add = command_line
    parser.add_argument(
        "block", nargs="*", metavar="BLOCK", help="run the tests of these; default: all"
    )
    add.add_flags(parser, list="the tests of each block; runs nothing")
    add.add_jobs(parser, "tests")
    add.add_number(parser, "--limit", 40, "list so many of the points that are not reached")
    add.add_json(parser)
    add.add_keep(parser, "Verilator's data and the logs")
    file = "docs/verification/coverage.json"
    add.add_flags(
        parser,
        no_build="take the programs as they are",
        update=f"put the results of these blocks into {file}, where all meet the targets",
    )
    options = parser.parse_args(argv)
    outputs.check(parser, json=options.json)
    command_line.check_keep(parser, options.keep)
    return options


def chosen(everything, blocks):
    """The programs of these blocks, or all; ProgramError where a block has none."""

    def unknown(words):
        there = ", ".join(dict.fromkeys(program.block for program in everything))
        return programs.ProgramError(f"no test of {words}; there are those of {there}")

    return command_line.chosen(everything, blocks, lambda program: (program.block,), unknown)


def measure(options, root, build, folder):
    """Builds and runs the tests; what they reached, as a report."""
    found = chosen(programs.read(build), options.block)
    if not options.no_build:
        building.make("coverage", build, [f"{p.test}_cover" for p in found], options.jobs)
    runs = programs.run(root, found, folder, options.jobs)
    seconds = {}
    for run in runs:
        seconds[run.program.block] = seconds.get(run.program.block, 0.0) + run.seconds
    blocks = sorted({program.block for program in found})
    points = data.merged(run.counts for run in runs)
    core = data.instances(run.counts for run in runs if run.program.block == data.CORE)
    return report.make(points, core, seconds, waivers.read(root), blocks)


def conclude(options, root, result):
    """Prints and writes it; the exit code."""
    print(report.text(result, options.limit))
    # Of a block that was not run nothing is known.
    idle = [
        w
        for w in result.waivers
        if not w.used and (not options.block or set(w.block.split()) <= set(options.block))
    ]
    for waiver in idle:
        print(
            f"{waivers.FILE}: {waiver.block} {waiver.kind} {waiver.points.pattern}: "
            "waives nothing; delete it"
        )
    print(
        f"\n{len(result.rows)} blocks, {len(result.bad)} short of a target, "
        f"{sum(bool(w.used) for w in result.waivers)} waivers in use"
    )
    if options.json:
        outputs.write_json(options.json, report.as_json(result, SCHEMA))
    good = not result.bad and not idle
    if options.update and good:
        put = block_results.merge if options.block else block_results.write
        put(root, "coverage", "./feltgate coverage --update", report.per_block(result))
        print(f"coverage: wrote {block_results.path_of('', 'coverage')}")
    elif options.update:
        print(
            f"coverage: {block_results.path_of('', 'coverage')} stays as it was, "
            "for targets are missed"
        )
    return 0 if good else 1


def run(options):
    """The exit code."""
    root, build = command_line.root().resolve(), command_line.build_folder()
    if options.list:
        for program in chosen(programs.read(build), options.block):
            print(f"{program.block:18}{program.test}")
        return 0
    with outputs.kept_or_temporary(options.keep, "coverage") as folder:
        return conclude(options, root, measure(options, root, build, folder))


def main(argv=None):
    options = arguments(argv)
    return command_line.ended("coverage", lambda: run(options))


if __name__ == "__main__":
    sys.exit(main())
