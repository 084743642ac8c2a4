# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Shared parts of the scripts that draw one picture of docs/images each: look, rows, file."""

import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
BLUE, RED, GREY = "#1f6fb4", "#c0392b", "#888888"

plt.rcParams.update({"svg.hashsalt": "feltgate", "svg.fonttype": "none", "font.size": 9})


def columns(path, names):
    """{name: values} of these columns of a CSV."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in names}


def save(figure, name):
    """Writes docs/images/NAME.svg, the same bytes for the same numbers."""
    figure.savefig(ROOT / f"docs/images/{name}.svg", metadata={"Date": None, "Creator": None})


def files(count, what):
    """The files that the command line names; ends with `what` where they are not so many."""
    given = sys.argv[1:]
    if len(given) == count and not given[0].startswith("-"):
        return given
    print(what.strip())
    sys.exit(0 if given in (["-h"], ["--help"]) else 2)
