#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Writes a block with mutants, for the build: a netlist in which one is chosen at run time.

  mutants.py BLOCK --sources S... --count 400 --seed 1 --output FILE.sv

Beside the file: mutants.json, what they are, and block.il, what they change. The command that
runs them is scripts/mutate.py.
"""

import argparse
import sys
from pathlib import Path

from mutation import netlist
from seeded_defects.patches import ROOT, DefectError


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("block")
    parser.add_argument(
        "--sources", type=Path, nargs="+", required=True, help="packages, children, block"
    )
    parser.add_argument("--parameter", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--own", action="store_true", help="leave its children whole, but for their pins"
    )
    parser.add_argument("--root", type=Path, default=ROOT)
    parser.add_argument("--output", type=Path, required=True)
    options = parser.parse_args()
    root = options.root.resolve()
    sources = [p.resolve() for p in options.sources]
    sources = [p.relative_to(root) if p.is_relative_to(root / "rtl") else p for p in sources]
    try:
        netlist.write(
            options.block,
            sources,
            options.parameter,
            options.count,
            options.seed,
            options.output.resolve(),
            root,
            options.own,
        )
    except (netlist.NetlistError, DefectError, OSError) as error:
        print(f"mutants: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
