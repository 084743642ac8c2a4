#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs a notebook of docs/ from top to bottom and writes it with its outputs, or checks that the
committed outputs are what comes out: their text, not the pixels of the pictures.

  scripts/notebook.py docs/fixed_against_float.ipynb           run and write
  scripts/notebook.py docs/fixed_against_float.ipynb --check   run and compare

The package feltgate must be importable (docs/python.md). Exit code: 0 fine, 1 a cell failed or an
output differs, 2 a package is missing.
"""

import argparse
import difflib
import os
import sys
from pathlib import Path

try:
    import nbclient
    import nbformat
except ImportError as error:
    sys.exit(f"{error}; run: apt-get install python3-nbclient python3-ipykernel")

TIMEOUT_S = 600


def normalised(notebook):
    """Without what differs from run to run: times, versions, and pictures that have a text beside."""
    for number, cell in enumerate(notebook.cells):
        cell["id"] = f"cell-{number:02d}"
        cell.metadata = {}
        for output in cell.get("outputs", ()):
            if "metadata" in output:
                output["metadata"] = {}
            # "<Figure size 900x600 with 3 Axes>" says nothing that the picture does not.
            if "image/png" in output.get("data", {}):
                output["data"].pop("text/plain", None)
    notebook.metadata = {
        "kernelspec": notebook.metadata["kernelspec"],
        "language_info": {"name": "python"},
    }
    return notebook


def texts(notebook):
    """Every line of text that the cells put out; a picture is one line."""
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            text = output.get("text", data.get("text/plain", "[picture]"))
            yield from text.splitlines()


def run(notebook, folder):
    """Executes in place; raises nbclient's CellExecutionError with the cell and its traceback."""
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"  # pictures in the page
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # a warning of ipykernel on stderr
    resources = {"metadata": {"path": str(folder)}}
    nbclient.NotebookClient(notebook, timeout=TIMEOUT_S, resources=resources).execute()
    return normalised(notebook)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("notebook", type=Path)
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    options = parser.parse_args()
    committed = nbformat.read(options.notebook, as_version=4)
    before = list(texts(committed))
    try:
        done = run(committed, options.notebook.parent)
    except nbclient.exceptions.CellExecutionError as error:
        print(f"{options.notebook}: a cell failed\n{error}", file=sys.stderr)
        return 1
    if not options.check:
        nbformat.write(done, options.notebook)
        return 0
    after = list(texts(done))
    if before == after:
        return 0
    sys.stderr.writelines(
        f"{line}\n" for line in difflib.unified_diff(before, after, "committed", "now", lineterm=""))
    print(f"{options.notebook}: the outputs are stale; run scripts/notebook.py {options.notebook}",
          file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
