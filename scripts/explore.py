#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Sweeps over design points: error, delay, area and speed of each, the front, a page.

Documentation: docs/speed-for-accuracy.md
"""

import argparse
import dataclasses
import importlib
import os
import sys
from pathlib import Path

import command_line
from exploration import chunks, engines, explore_page, front, merge, meter, presets, routes, space
from exploration import plan as plans

VERBS = ("plan", "run", "merge", "route", "page", "picture", "presets", "point")
EXAMPLES = """examples:
  feltgate explore smoke                          plan, run, merge, route, page in one go
  feltgate explore plan trade -o /data/trade      then, here or on many machines:
  feltgate explore run /data/trade --chunk 3/16   one of 16 parts; --chunk left out: all of them
  feltgate explore run /data/trade --engine dask --scheduler tcp://head:8786
  feltgate explore merge /data/trade              refuses gaps and duplicates
  feltgate explore route /data/trade              Fmax of the points on the front
  feltgate explore page /data/trade               explore.html: hover a dot, get its design file
  feltgate explore page vectors/spaces/trade.csv  the same of the shipped table, at once
  feltgate explore picture /data/trade            explore.svg
  feltgate explore presets /data/trade            fast.toml, balanced.toml, exact.toml
  feltgate explore point my_point.toml            one design point alone

A run that was stopped is continued by the same command. Exit code: 0 done, 1 a point's RTL
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
        raise plans.PlanError(
            f"{name} is a scene, and explore takes a space of design points; what its rate costs a "
            f"scene's torque is in: ./feltgate rates {scene.stem}"
        )
    if not Path(name).exists():
        known = ", ".join(sorted(path.stem for path in spaces.glob("*.toml")))
        raise plans.PlanError(
            f"{name} is neither a verb ({', '.join(VERBS)}), nor a space ({known}), nor a file"
        )
    return Path(name)


def default_folder(name):
    return command_line.build_folder() / "explore" / Path(name).stem


def add_engine(parser):
    parser.add_argument(
        "--jobs", type=int, metavar="N", help="chunks at a time; default: all cores"
    )
    parser.add_argument("--engine", choices=("local", "dask"), default="local")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of dask; default: a local cluster")


def parser_of_verbs():
    parser = command_line.parser("explore", __doc__.splitlines()[0], EXAMPLES)
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="SPACE.toml | VERB")
    everything = verbs.add_parser(
        "all", help="SPACE.toml alone: all of the below, one after another"
    )
    make = verbs.add_parser(
        "plan", help="write the points of a space into a folder", **help_of("plan")
    )
    for one in (everything, make):
        one.add_argument("space", metavar="SPACE", help="a file, or a name in vectors/spaces")
        command_line.add_folder(one, "default: explore/ in build")
    everything.add_argument("--no-route", action="store_true", help="leave out place and route")
    run = verbs.add_parser("run", help="evaluate a plan, or one chunk of it", **help_of("run"))
    run.add_argument("--chunk", metavar="I/N", help="only part I of N; default: all, in parallel")
    merge = verbs.add_parser("merge", help="join the chunks into points.jsonl", **help_of("merge"))
    route = verbs.add_parser(
        "route", help="place and route the points of the front, and merge", **help_of("route")
    )
    route.add_argument("--point", metavar="ID", help="only this point, and no merge")
    for one in (run, merge, route):
        one.add_argument("folder", type=Path, metavar="DIR")
    for name, what in (
        ("page", "write explore.html"),
        ("picture", "write explore.svg; needs matplotlib"),
        ("presets", "write fast, balanced and exact as design files"),
    ):
        one = verbs.add_parser(name, help=what, **help_of(name))
        one.add_argument("folder", type=Path, metavar="DIR | TABLE.csv")
        command_line.add_folder(one, "default: DIR, or explore/ in build")
    for one in (everything, run, route):
        add_engine(one)
    verbs.add_parser("point", help="evaluate one design point", add_help=False)
    return parser


def sources_of(plan):
    return plans.sources_digest(command_line.root(), {point["base"] for point in plan.points})


def execute(options, parts, finished):
    jobs = options.jobs or os.cpu_count() or 1
    if options.engine == "dask":
        engines.dask(parts, options.scheduler, jobs, finished)
    else:
        engines.local(parts, jobs, finished)


def run_all(plan, options):
    """Every chunk that is not there yet."""
    count = max(1, len(plan.groups()))
    missing = chunks.missing(plan, count, sources_of(plan))
    parts = [
        engines.Part(
            ("run", str(plan.folder), "--chunk", f"{index}/{count}"),
            len(plan.chunk(index, count)),
        )
        for index in missing
    ]
    with meter.Meter(plan.folder, len(plan.points)) as shown:
        shown.skip(len(plan.points) - sum(part.points for part in parts))
        execute(options, parts, shown.finish)


def route_all(plan, options):
    """Every point of the front that is not routed yet."""
    done = routes.read(plan.folder, sources_of(plan))
    names = [row["id"] for row in front.find(merge.read(plan.folder))]
    parts = [
        engines.Part(("route", str(plan.folder), "--point", name), 1)
        for name in names
        if name not in done
    ]
    with meter.Meter(plan.folder, len(names), "routed") as shown:
        shown.skip(len(names) - len(parts))
        execute(options, parts, shown.finish)


def run_chunk(plan, text):
    index, count = plans.parse_chunk(text)
    parent = os.environ.get(engines.PARENT)
    print(chunks.run(plan, index, count, sources_of(plan), int(parent) if parent else None))


def make_plan(options):
    found = space.read_space(command_line.root(), find_space(options.space))
    plan = plans.make(found, options.out or default_folder(options.space))
    print(
        f"explore: {len(plan.points)} points of {len(plan.groups())} structures in {plan.folder}",
        file=sys.stderr,
    )
    return plan


def report_mismatches(rows):
    """Exit status: 1 when the RTL of a point is not its twin."""
    wrong = [row["id"] for row in rows if row["result"].get("mismatches")]
    if wrong:
        print(f"explore: RTL and twin differ at {', '.join(wrong)}", file=sys.stderr)
    return 1 if wrong else 0


def act_all(options):
    plan = make_plan(options)
    run_all(plan, options)
    print(merge.merge(plan, command_line.root()))
    if not options.no_route:
        route_all(plan, options)
        merge.merge(plan, command_line.root())
    rows = merge.read(plan.folder)
    print(explore_page.write(plan, rows, command_line.root()))
    return report_mismatches(rows)


def merged(options):
    """(plan, rows) of a folder, or of a committed table with its space file beside it."""
    if options.folder.suffix != ".csv":
        plan = plans.load(options.folder)
        rows = merge.read(plan.folder)
    else:
        table = options.folder
        rows = merge.read_table(table)
        found = space.read_space(command_line.root(), table.with_suffix(".toml"))
        plan = plans.Plan(default_folder(table.stem), found.name, found.description, (), "")
    if options.out:
        plan = dataclasses.replace(plan, folder=options.out)
    try:
        plan.folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise plans.PlanError(f"{plan.folder}: is no folder; give -o a folder's name") from None
    return plan, rows


def show(options):
    """page, picture and presets: what is made of the merged figures."""
    plan, rows = merged(options)
    if options.verb == "page":
        paths = [explore_page.write(plan, rows, command_line.root())]
    elif options.verb == "picture":
        paths = [importlib.import_module("exploration.explore_picture").write(plan, rows)]
    else:
        paths = presets.write(plan, rows, command_line.root())
    print("\n".join(map(str, paths)))


def act(options):
    if options.verb == "all":
        return act_all(options)
    if options.verb == "plan":
        print(make_plan(options).folder)
        return 0
    if options.verb in ("page", "picture", "presets"):
        show(options)
        return 0
    plan = plans.load(options.folder)
    if options.verb == "run" and options.chunk:
        run_chunk(plan, options.chunk)
    elif options.verb == "run":
        run_all(plan, options)
    elif options.verb == "route" and options.point:
        print(routes.run(plan, options.point, sources_of(plan)))
    else:
        if options.verb == "route":
            route_all(plan, options)
        print(merge.merge(plan, command_line.root()))
        return report_mismatches(merge.read(plan.folder))
    return 0


def main():
    words = sys.argv[1:]
    if words[:1] == ["point"]:
        point = importlib.import_module("exploration.point")
        return command_line.ended("explore", lambda: point.main(words[1:]))
    if words and words[0] not in VERBS and not words[0].startswith("-"):
        words.insert(0, "all")
    options = parser_of_verbs().parse_args(words)
    hint = "; the same command goes on from here"
    return command_line.ended("explore", lambda: act(options), chunks.Orphaned, hint=hint)


if __name__ == "__main__":
    sys.exit(main())
