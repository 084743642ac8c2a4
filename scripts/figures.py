#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Redraws the paper's figures 7, 10, 11, 14, 16, 17, 19, 21 and 22 from runs of the RTL.

Each has the ideal curve, the paper's numbers and our results. Writes figures.html (pictures inside), figures.json, and each picture as SVG and PNG.
Documentation: docs/figures.md
"""

import json
import sys

import command_line
import outputs
from outputs import write_whole
from reports import all_figures, page, paper_pictures, runs
from reports.recordings import all_faults

SCHEMA = "feltgate-figures/1"
EPILOG = """\
  feltgate figures
  feltgate figures --design paper -o figures
  feltgate figures --docs                the pictures of docs/figures.md, in 3 minutes
Exit code: 0 nothing broken, 1 a mismatch or a broken expectation, 2 unusable input."""
DESIGNS = ("lever", "paper")
INTRODUCTION = (
    "The figures of A. G. Rodríguez Ramírez, M. Nandayapa, O. O. Vergara Villegas and F. García "
    "Luna, “Haptic Augmentation Towards a Smart Learning Environment: The Haptic Lever Design”, "
    "redrawn from this project's RTL. The paper's curves were measured on a device; ours are a "
    "simulation of the core, clock by clock, on a modelled motor, lever and hand. Design paper "
    "has the published numbers; lever has the constants of the motor that is really there."
)
LEGEND = (
    "Blue is the torque that paper observes, purple its motor's, green that of lever's motor, dashed the "
    "ideal. The long motions of the paper ran on the RTL's bit-exact twin alone."
)


def write(folder, drawn, found):
    """Pictures, figures.json and figures.html; the path of the page."""
    for figure in drawn:
        for picture in figure.pictures:
            picture.write(folder)
    wrong = all_faults(found)
    clocks = sum(run.compared_clocks for run in found.values())
    mismatches = sum(run.mismatches for run in found.values())
    summary = {
        "schema": SCHEMA,
        "clocks": clocks,
        "mismatches": mismatches,
        "broken": wrong,
        "figures": [figure.summary() for figure in drawn],
    }
    text = json.dumps(summary, indent=1, ensure_ascii=False)
    write_whole(folder / "figures.json", text + "\n")
    body = "<h1>The Haptic Lever's figures, redrawn from RTL</h1>"
    body += page.verdict(wrong, f"0 mismatches between RTL and twin in {clocks:,} clocks")
    body += page.paragraph(INTRODUCTION) + page.paragraph(LEGEND)
    body += "".join(figure.html() for figure in drawn)
    path = folder / "figures.html"
    write_whole(path, page.document("feltgate: figures of the paper", body))
    return path


def arguments():
    parser = command_line.parser(
        "figures",
        "Redraws the figures of the Haptic Lever paper from runs of the RTL.",
        EPILOG,
    )
    command_line.add_folder(parser, "default: figures in build")
    what = "only lever or only paper; default: both"
    parser.add_argument("--design", choices=DESIGNS, metavar="DESIGN", help=what)
    command_line.add_flags(parser, docs="the nine pictures of docs/figures.md alone, from the twin, to docs/images")
    arguments = parser.parse_args()
    outputs.check_folder(parser, "-o", arguments.out)
    return arguments


def run_docs(arguments):
    """The nine pictures, into docs/images or the folder; the exit code."""
    folder = (arguments.out or command_line.root() / "docs" / "images").resolve()
    jobs = paper_pictures.jobs()
    with outputs.new_folder(folder):
        found = runs.run_all("figures", jobs, runs.build_folder() / "figures" / "data")
        wrong = all_faults(found)
        if not wrong:
            for number in paper_pictures.NUMBERS:
                paper_pictures.draw(number, lambda job: found.get(paper_pictures.by_twin(job).name)).write(folder)
    for line in wrong:
        print(f"figures: {line}", file=sys.stderr)
    print(folder)
    return 1 if wrong else 0


def run(arguments):
    """The exit code."""
    if arguments.docs:
        return run_docs(arguments)
    folder = (arguments.out or runs.build_folder() / "figures").resolve()
    designs = (arguments.design,) if arguments.design else DESIGNS
    jobs = all_figures.jobs(designs)
    with outputs.new_folder(folder):
        found = runs.run_all("figures", jobs, folder / "data")
        drawn = all_figures.draw(found, designs, png=True)
        path = write(folder, drawn, found)
    wrong = all_faults(found)
    for line in wrong:
        print(f"figures: {line}", file=sys.stderr)
    print(path)
    return 1 if wrong else 0


def main():
    given = arguments()
    return command_line.ended("figures", lambda: run(given))


if __name__ == "__main__":
    sys.exit(main())
