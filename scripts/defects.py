#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Seeded defects: patches beside their tests, applied to copies of the product. docs/testing.md

FILE is testbench/ROOM/BLOCK/defects.diff, NAME a defect of it; without a NAME: all for tests.

  defects.py copy FILE NAME --output DIR  the patched files, at their paths below DIR
  defects.py block BLOCK --defects FILE [NAME...] --sources S... --output OUT.sv
      one SystemVerilog file: a module of the block's name and ports that holds a copy of the block
      for each defect. The one that FELTGATE_DEFECT names has a clock and drives the outputs; `none`
      is a copy without a defect. --defects may be given for several files.
  defects.py headers FILE [NAME...] --output DIR
      the C++ files that they change, below DIR, each with the statements of all defects: those of
      the one that FELTGATE_DEFECT names are executed
  defects.py same-class A.h B.h --output FILE
      writes FILE when Verilator gave both classes the same members in the same order, so that what
      was compiled with the one may be linked with the other

  defects.py check
      every diff of every defect file below testbench, and how many there are

A defect is refused that does not apply, changes no code or does not say first what it breaks.
"""

import argparse
import sys
from pathlib import Path

from seeded_defects import block, headers, patches


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    verbs = parser.add_subparsers(dest="verb", required=True)
    copy = verbs.add_parser("copy", help="patched copies of the files that a defect changes")
    copy.add_argument("file", type=Path)
    copy.add_argument("name")
    one = verbs.add_parser("block", help="a module that holds a copy of the block for each defect")
    one.add_argument("block")
    one.add_argument(
        "--defects", nargs="+", action="append", required=True, metavar=("FILE", "NAME")
    )
    one.add_argument("--sources", type=Path, nargs="+", required=True, help="block and children")
    cpp = verbs.add_parser("headers", help="C++ files with the statements of all defects")
    cpp.add_argument("file", type=Path)
    cpp.add_argument("name", nargs="*")
    same = verbs.add_parser("same-class", help="are two Verilated classes laid out alike?")
    same.add_argument("headers", type=Path, nargs=2)
    every = verbs.add_parser("check", help="do all diffs of the tests apply?")
    for verb in (copy, one, cpp, same):
        verb.add_argument("--output", type=Path, required=True)
    for verb in (copy, one, cpp, same, every):
        verb.add_argument("--root", type=Path, default=patches.ROOT)
    options = parser.parse_args()
    try:
        root = options.root.resolve()
        if options.verb == "check":
            files = sorted((root / "testbench").glob("**/*.diff"))
            chosen = [p for file in files for p in patches.every(file)]
            for patch in chosen:
                patches.patched(patch, root)
            print(f"{len(chosen)} defects in {len(files)} files apply")
        elif options.verb == "copy":
            patches.write_copies(options.file / options.name, options.output, root)
        elif options.verb == "headers":
            chosen = patches.chosen(options.file, options.name)
            headers.write_headers(chosen, options.output, root)
        elif options.verb == "same-class":
            block.check_same_class(*options.headers)
            options.output.write_text("", encoding="utf-8")
        else:
            sources = [path.resolve().relative_to(root) for path in options.sources]
            chosen = [p for file, *names in options.defects for p in patches.chosen(file, names)]
            text = block.block_of_defects(options.block, chosen, sources, root)
            options.output.parent.mkdir(parents=True, exist_ok=True)
            options.output.write_text(text, encoding="utf-8")
    except (patches.DefectError, OSError) as error:
        print(f"defects: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
