# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Shared parts of the Python command lines of `feltgate COMMAND`: look of --help, some options."""

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


def add_only_arguments(to):
    """--only-arguments, for the launcher: nothing is fetched or built for what is refused."""
    to.add_argument("--only-arguments", action="store_true", help=argparse.SUPPRESS)


def is_given(value):
    """Whether an option is not as it is without a word; a number 0 is a word."""
    return value is not None and value is not False


def refuse_beside(to, options, alone, *others):
    """Ends with 2 where an option would leave others without effect; names as Python has them."""
    given = [name for name in others if is_given(getattr(options, name))]
    if is_given(getattr(options, alone)) and given:
        words = ", ".join(f"--{name.replace('_', '-')}" for name in given)
        to.error(f"--{alone.replace('_', '-')} does nothing with {words}: leave one of them away")


def add_json(to):
    """--json FILE: a Path, or None."""
    to.add_argument("--json", type=Path, metavar="FILE", help="write the results here")
