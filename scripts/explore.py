#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Sweeps over design points: error, delay, area and speed of each, the front, a page.

Documentation: docs/speed-for-accuracy.md
"""

import argparse
import dataclasses
import importlib
import sys
from pathlib import Path

import command_line
from exploration import front, points_table, presets, space
from exploration import sweep as sweeps

VERBS = ("page", "presets", "point")
EXAMPLES = """examples:
  feltgate explore smoke                          four points: does it work here?
  feltgate explore trade                          the shipped space: points.csv, explore.html
  feltgate explore trade -o /data/trade --part 3/16
                                                  one of 16 parts, on machines that share the folder
  feltgate explore page vectors/spaces/trade.csv  explore.html and explore.svg of the shipped table, at once
  feltgate explore presets /data/trade            fast.toml, balanced.toml, exact.toml
  feltgate explore point my_point.toml            one design point alone

A sweep that was stopped is continued by the same command. Exit code: 0 done, 1 a point's RTL
differs from its twin, 2 wrong use.
"""


def help_of(verb):
    """How a verb's own help ends: its lines of the examples, and the exit codes."""
    shown = [line for line in EXAMPLES.splitlines() if f"explore {verb} " in line]
    codes = EXAMPLES[EXAMPLES.index("Exit code") :]
    return {
        "epilog": "\n".join(["examples:", *shown, codes]),
        "formatter_class": argparse.RawDescriptionHelpFormatter,
        "allow_abbrev": False,
    }


def find_space(name):
    spaces = command_line.root() / "vectors/spaces"
    if "/" not in name and (spaces / f"{name}.toml").is_file():
        return spaces / f"{name}.toml"
    scene = command_line.root() / "vectors/scenes" / f"{Path(name).stem}.toml"
    if scene.is_file() and (name == scene.stem or Path(name).resolve() == scene.resolve()):
        raise sweeps.SweepError(
            f"{name} is a scene, and explore takes a space of design points; what its rate costs a "
            f"scene's torque is in: ./feltgate rates {scene.stem}"
        )
    if not Path(name).exists():
        known = ", ".join(sorted(path.stem for path in spaces.glob("*.toml")))
        raise sweeps.SweepError(
            f"{name} is neither a verb ({', '.join(VERBS)}), nor a space ({known}), nor a file"
        )
    return Path(name)


def default_folder(name):
    return command_line.build_folder() / "explore" / Path(name).stem


def parser_of_verbs():
    parser = command_line.parser("explore", __doc__.splitlines()[0], EXAMPLES)
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="SPACE.toml | VERB")
    everything = verbs.add_parser("all", help="SPACE.toml alone: evaluate its points, route the front, write the page")
    everything.add_argument("space", metavar="SPACE", help="a file, or a name in vectors/spaces")
    command_line.add_folder(everything, "default: explore/ in build")
    everything.add_argument("--no-route", action="store_true", help="leave out place and route")
    everything.add_argument("--part", metavar="I/N", help="evaluate only part I of N, and no more")
    command_line.add_jobs(everything, "points")
    for name, what in (
        ("page", "write explore.html and explore.svg"),
        ("presets", "write fast, balanced and exact as design files"),
    ):
        one = verbs.add_parser(name, help=what, **help_of(name))
        one.add_argument("folder", type=Path, metavar="DIR | TABLE.csv")
        command_line.add_folder(one, "default: DIR, or explore/ in build")
    verbs.add_parser("point", help="evaluate one design point", add_help=False)
    return parser


def report_mismatches(rows):
    """Exit status: 1 when the RTL of a point is not its twin."""
    wrong = [row["id"] for row in rows if row["result"].get("mismatches")]
    if wrong:
        print(f"explore: RTL and twin differ at {', '.join(wrong)}", file=sys.stderr)
    return 1 if wrong else 0


def act_all(options):
    root = command_line.root()
    part = sweeps.parse_part(options.part) if options.part else None
    found = space.read_space(root, find_space(options.space))
    sweep = sweeps.start(root, found, options.out or default_folder(options.space))
    structures = len({space.structure(point) for point in sweep.points})
    print(f"explore: {len(sweep.points)} points of {structures} structures in {sweep.folder}", file=sys.stderr)
    sweeps.run(sweep, sweep.part(*part) if part else sweep.points, options.jobs)
    if part:
        return 0
    rows = points_table.write(sweep, root)
    if not options.no_route:
        on_front = {row["id"] for row in front.find(rows)}
        chosen = [point for point in sweep.points if space.point_id(point) in on_front]
        sweeps.run(sweep, chosen, options.jobs, sweeps.ROUTED)
        rows = points_table.write(sweep, root)
    print(sweep.folder / points_table.LINES)
    print(importlib.import_module("exploration.explore_page").write(sweep, rows)[-1])
    return report_mismatches(rows)


def merged(options):
    """(plan, rows) of a folder, or of a committed table with its space file beside it."""
    if options.folder.suffix != ".csv":
        plan = sweeps.load(options.folder)
        rows = points_table.read(plan.folder)
    else:
        table = options.folder
        rows = points_table.read_table(table)
        found = space.read_space(command_line.root(), table.with_suffix(".toml"))
        plan = sweeps.Sweep(default_folder(table.stem), found.name, found.description)
    if options.out:
        plan = dataclasses.replace(plan, folder=options.out)
    try:
        plan.folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise sweeps.SweepError(f"{plan.folder}: is no folder; give -o a folder's name") from None
    return plan, rows


def show(options):
    """page and presets: what is made of the results."""
    plan, rows = merged(options)
    if options.verb == "page":
        paths = importlib.import_module("exploration.explore_page").write(plan, rows)
    else:
        paths = presets.write(plan, rows, command_line.root())
    print("\n".join(map(str, paths)))
    return 0


def main():
    words = sys.argv[1:]
    if words[:1] == ["point"]:
        point = importlib.import_module("exploration.point")
        return command_line.ended("explore", lambda: point.main(words[1:]))
    if words[:1] == ["worker"]:
        return command_line.ended("explore", lambda: sweeps.worker(*words[1:]))
    if words and words[0] not in VERBS and not words[0].startswith("-"):
        words.insert(0, "all")
    options = parser_of_verbs().parse_args(words)
    hint = "; the same command goes on from here"
    act = act_all if options.verb == "all" else show
    return command_line.ended("explore", lambda: act(options), hint=hint)


if __name__ == "__main__":
    sys.exit(main())
