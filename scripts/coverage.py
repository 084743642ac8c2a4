#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What of the RTL the block tests reach: lines, branches, bits, cover points.

Each block test is built a second time on RTL that counts (verilator --coverage) and run with its
usual stimulus. From Verilator's raw data, not from its own percentage, over all programs and
instances:

  lines, branches   reached at all; must be all of them
  toggles           each bit of each signal changed twice at least outside of a reset; must be 98 %
  cover points      named situations (testbench/coverage/BLOCK_cover.sv); must be all of them

What cannot be reached is waived, with its reason, in testbench/coverage/waivers.toml, ten times at
most. 'whole core' is what the core's own tests reach, each instance for itself; no target. What it
says and does not say: docs/coverage.md

Exit code: 0 all targets are met, 1 a block misses one or a waiver is of no use, 2 when a tool, a
file or an argument is wrong or a test fails.

  feltgate coverage                     all blocks: about ten minutes of CPU time
  feltgate coverage pwm quad_decoder    the tests of two blocks
  feltgate coverage --list              which tests there are; builds nothing
"""

import os
import sys
import tempfile
from pathlib import Path

import block_results
import building
import command_options
import interrupts
import outputs
from covering import data, programs, report, waivers

SCHEMA = "feltgate-coverage/1"
CORE = "feltgate_core"


def arguments(argv):
    parser = command_options.parser("coverage", __doc__)
    parser.add_argument(
        "block", nargs="*", metavar="BLOCK", help="run the tests of these; default: all"
    )
    parser.add_argument("--list", action="store_true", help="the tests of each block; runs nothing")
    command_options.add_jobs(parser, "tests")
    parser.add_argument(
        "--limit",
        type=int,
        default=40,
        metavar="N",
        help="list so many of the points that are not reached; default 40",
    )
    command_options.add_json(parser)
    parser.add_argument(
        "--keep",
        type=Path,
        metavar="DIR",
        help="keep Verilator's data and the logs in this new folder",
    )
    parser.add_argument("--no-build", action="store_true", help="take the programs as they are")
    parser.add_argument(
        "--update",
        action="store_true",
        help="put the results of these blocks into docs/verification/coverage.json, where all meet "
        "the targets",
    )
    options = parser.parse_args(argv)
    outputs.check(parser, json=options.json)
    if (
        options.keep
        and options.keep.exists()
        and (not options.keep.is_dir() or any(options.keep.iterdir()))
    ):
        parser.error(f"argument --keep: {options.keep} is not an empty folder; name a new one")
    if options.jobs < 1:
        parser.error("argument --jobs: at least 1")
    if options.limit < 0:
        parser.error("argument --limit: at least 0")
    return options


def chosen(everything, blocks):
    """The programs of these blocks, or all; ProgramError where a block has none."""
    there = list(dict.fromkeys(program.block for program in everything))
    unknown = [block for block in blocks if block not in there]
    if unknown:
        raise programs.ProgramError(
            f"no test of {', '.join(unknown)}; there are those of {', '.join(there)}"
        )
    return [program for program in everything if not blocks or program.block in blocks]


def measure(options, root, build, folder):
    """Builds and runs the tests; what they reached, as a report."""
    found = chosen(programs.read(build), options.block)
    if not options.no_build:
        building.make(
            "coverage", build, [f"{program.test}_cover" for program in found], options.jobs
        )
    runs = programs.run(root, found, folder, options.jobs)
    seconds = {}
    for run in runs:
        seconds[run.program.block] = seconds.get(run.program.block, 0.0) + run.seconds
    blocks = sorted({program.block for program in found})
    points = data.merged(run.counts for run in runs)
    core = data.instances(run.counts for run in runs if run.program.block == CORE)
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
        print(
            f"coverage: wrote {block_results.path_of('', 'coverage')}; "
            "scripts/check_blocks.py --write makes the table"
        )
    elif options.update:
        print(
            f"coverage: {block_results.path_of('', 'coverage')} stays as it was, "
            "for targets are missed"
        )
    return 0 if good else 1


def main(argv=None):
    root = Path(os.environ.get("FELTGATE_ROOT") or Path(__file__).resolve().parents[1]).resolve()
    build = Path(os.environ.get("FELTGATE_BUILD") or root / "build")
    options = arguments(argv)
    interrupts.end_on_signals()
    try:
        if options.list:
            for program in chosen(programs.read(build), options.block):
                print(f"{program.block:18}{program.test}")
            return 0
        if options.keep:
            options.keep.mkdir(parents=True, exist_ok=True)
            return conclude(options, root, measure(options, root, build, options.keep.resolve()))
        with tempfile.TemporaryDirectory(prefix="feltgate-coverage-") as folder:
            return conclude(options, root, measure(options, root, build, Path(folder)))
    except (
        programs.ProgramError,
        data.DataError,
        waivers.WaiverError,
        building.BuildError,
        block_results.ResultsError,
        OSError,
    ) as error:
        print(f"coverage: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt as error:
        return interrupts.tell("coverage", error)


if __name__ == "__main__":
    sys.exit(main())
