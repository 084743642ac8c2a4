#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Sweeps over design points: error, delay, area and speed of each, the front, a page.

Documentation: docs/speed-for-accuracy.md
"""

import argparse
import importlib
import sys
from pathlib import Path

import command_line
from exploration import front, points_table, space
from exploration import sweep as sweeps

VERBS = ("page", "point")
EXAMPLES = """examples:
  feltgate explore smoke                          four points: does it work here?
  feltgate explore trade                          the shipped space: points.csv, explore.html
  feltgate explore page vectors/spaces/trade.csv  explore.html and explore.svg of the shipped table, at once
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
    command_line.add_jobs(everything, "points")
    page = verbs.add_parser("page", help="explore.html and explore.svg of a table", **help_of("page"))
    page.add_argument("table", type=Path, metavar="TABLE.csv", help="a space, of the same name, stands beside it")
    command_line.add_folder(page, "default: explore/ in build")
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
    found = space.read_space(root, find_space(options.space))
    sweep = sweeps.start(root, found, options.out or default_folder(options.space))
    points = found.points
    structures = len({space.structure(point) for point in points})
    print(f"explore: {len(points)} points of {structures} structures in {sweep.folder}", file=sys.stderr)
    sweeps.run(sweep, points, options.jobs)
    rows = points_table.write(sweep, points, root)
    if not options.no_route:
        on_front = {row["id"] for row in front.find(rows)}
        sweeps.run(sweep, [p for p in points if space.point_id(p) in on_front], options.jobs, sweeps.ROUTED)
        rows = points_table.write(sweep, points, root)
    print(sweep.folder / points_table.TABLE)
    print(importlib.import_module("exploration.explore_page").write(sweep.folder, found, rows)[-1])
    return report_mismatches(rows)


def act_page(options):
    rows = points_table.read_table(options.table)
    found = space.read_space(command_line.root(), options.table.with_suffix(".toml"))
    folder = options.out or default_folder(options.table)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise sweeps.SweepError(f"{folder}: is no folder; give -o a folder's name") from None
    print("\n".join(map(str, importlib.import_module("exploration.explore_page").write(folder, found, rows))))
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
    act = act_all if options.verb == "all" else act_page
    return command_line.ended("explore", lambda: act(options), hint=hint)


if __name__ == "__main__":
    sys.exit(main())
