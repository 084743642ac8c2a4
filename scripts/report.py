#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""One self-contained HTML page about one run: pictures inside, no network.

feltgate run calls this for --report DIR; by hand, for a replay too:
  feltgate replay hand.sr --json hand.json --csv hand.csv
  scripts/report.py out hand.json hand.csv
Writes DIR/report.html and prints its path. Documentation: docs/figures.md
"""

import argparse
import json
import sys
from pathlib import Path

import command_line
from outputs import write_whole
from reports import headline, page, run_pictures, run_section
from reports.runs import read_csv

SCHEMA = "feltgate-run/1"
MOST_ROWS = 60_000  # a picture shows no more


def read_summary(path):
    """The run's JSON; ValueError with one line for anything else."""
    try:
        summary = json.loads(Path(path).read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{path}: no JSON: {error}") from None
    found = summary.get("schema") if isinstance(summary, dict) else None
    if found != SCHEMA:
        raise ValueError(f"{path}: schema is {found!r}, not {SCHEMA!r}; give a run's --json file")
    return summary


def compared(summary):
    """The verdict of a run with which nothing is wrong."""
    good = f"{summary['clocks']:,} clocks; RTL and twin were not compared in this run"
    if "mismatches" in summary:
        good = f"0 mismatches between RTL and twin in {summary['clocks']:,} clocks"
    checked = summary.get("expectations", {}).get("checked", 0)
    return good + (f"; all {checked} expectations of the scene hold" if checked else "")


def report(summary, tables):
    """The page's text. `tables` are dictionaries of columns, as read_csv gives them."""
    subject = run_section.subject(summary)
    drawn = []
    for i, csv in enumerate(tables):
        drawn += run_pictures.pictures(f"{subject}-{i}" if i else subject, summary, csv)
    body = f"<h1>feltgate: {page.escape(subject)}</h1>"
    body += page.verdict(run_section.faults_of(summary), compared(summary))
    body += headline.html(headline.of_run(summary, run_section.steps_of(summary)))
    body += run_section.inside(summary, drawn)
    body += page.paragraph(
        "Errors are against the same chain in 113-bit arithmetic on the same sampled counts; speed "
        "is simulated seconds per second spent in the back-end. All of this is simulation.",
        soft=True,
    )
    body += page.paragraph(f"feltgate {summary.get('version', '')}", soft=True)
    return page.document(f"feltgate: {subject}", body)


def main():
    parser = argparse.ArgumentParser(prog="feltgate report", description=__doc__.splitlines()[0])
    parser.add_argument("folder", metavar="DIR", type=Path, help="where report.html is written")
    parser.add_argument("json", metavar="JSON", help="what --json wrote")
    parser.add_argument("csv", metavar="CSV", nargs="*", help="what --csv wrote")
    arguments = parser.parse_args()

    def work():
        summary = read_summary(arguments.json)
        text = report(summary, [read_csv(path, MOST_ROWS) for path in arguments.csv])
        arguments.folder.mkdir(parents=True, exist_ok=True)
        path = arguments.folder / "report.html"
        write_whole(path, text)
        print(path)
        return 0

    return command_line.ended("report", work, ValueError)


if __name__ == "__main__":
    sys.exit(main())
