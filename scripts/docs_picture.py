# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Shared parts of the scripts that draw pictures of docs/images: look, rows, file."""

import csv
import inspect
import sys
import tomllib
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
BLUE, RED, GREY = "#1f6fb4", "#c0392b", "#888888"

plt.rcParams.update({"svg.hashsalt": "feltgate", "svg.fonttype": "none", "font.size": 9})


def columns(path, names=None):
    """{name: array} of these columns of a CSV, or of all."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in names or rows[0]}


def vectors(path):
    """A TOML file of vectors/, such as devices/stylus."""
    return tomllib.loads((ROOT / f"vectors/{path}.toml").read_text(encoding="utf-8"))


def save(figure, name):
    """Writes docs/images/NAME.svg, the same bytes for the same numbers."""
    figure.savefig(ROOT / f"docs/images/{name}.svg", metadata={"Date": None, "Creator": None})


def draw(what, *pictures, **others):
    """For the command line NAME FILE... writes docs/images/NAME.svg: the figure that the function of
    this name makes of so many files. Where there is none it ends with `what` and their texts."""
    known = {picture.__name__: picture for picture in pictures} | others
    name, *files = sys.argv[1:] or [""]
    if name not in known or len(files) != len(inspect.signature(known[name]).parameters):
        print(what)
        for picture in pictures:
            print(f"{picture.__name__}: {inspect.getdoc(picture)}\n")
        sys.exit(0 if name in ("-h", "--help") else 2)
    save(known[name](*files), name)
