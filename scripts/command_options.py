# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the command lines of `feltgate COMMAND` in Python share: how --help looks, some options."""

import argparse
import os
from pathlib import Path


def parser(command, description, epilog=None):
    """Of `feltgate COMMAND`; texts are printed as they are, options are not abbreviated."""
    return argparse.ArgumentParser(
        allow_abbrev=False,
        prog=f"feltgate {command}",
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def add_jobs(to, what):
    """--jobs N: how many of `what` at the same time."""
    to.add_argument(
        "--jobs",
        type=int,
        default=os.cpu_count(),
        metavar="N",
        help=f"{what} at the same time; default: one per core",
    )


def add_json(to):
    """--json FILE: a Path, or None."""
    to.add_argument("--json", type=Path, metavar="FILE", help="write the results here")
