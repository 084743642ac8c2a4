# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the Python commands of `feltgate COMMAND` share: look of --help, options, places, and how
they end. Exit code 2 with one message is a Refused; documentation: docs/json.md
"""

import argparse
import os
import sys
from pathlib import Path

import interrupts


class Refused(Exception):
    """What a command cannot do, for the user: why, and what to do. Base of the parts' own errors."""


def root():
    """Of the repository."""
    return Path(os.environ.get("FELTGATE_ROOT") or Path(__file__).resolve().parents[1])


def build_folder():
    return Path(os.environ.get("FELTGATE_BUILD") or root() / "build").resolve()


def ended(name, work, *errors, hint=""):
    """The exit code of work(): its own, 2 with what was refused (further `errors` too), or that of
    a signal, told with the hint."""
    interrupts.end_on_signals()
    try:
        return work()
    except (Refused, OSError, *errors) as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt as error:
        return interrupts.tell(name, error, hint)


def say(name, text):
    """A line about the work, for a person."""
    print(f"{name}: {text}", file=sys.stderr, flush=True)


def chosen(things, wanted, names, unknown):
    """Those of the things that have a wanted one among names(thing), or all; of words that none
    has, unknown(words) is raised."""
    strange = [word for word in wanted if not any(word in names(thing) for thing in things)]
    if strange:
        raise unknown(", ".join(strange))
    return [t for t in things if not wanted or any(word in names(t) for word in wanted)]


def parser(command, description, epilog=None):
    """Of `feltgate COMMAND`; texts are printed as they are, options are not abbreviated."""
    return argparse.ArgumentParser(
        allow_abbrev=False,
        prog=f"feltgate {command}",
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def whole(least):
    """The type of an option that is a whole number."""

    def number(text):
        if int(text) < least:
            raise argparse.ArgumentTypeError(f"{least} or more" if least == 0 else f"at least {least}")
        return int(text)

    return number


def share(text):
    """The type of an option that is a share."""
    if not 0 <= float(text) <= 1:
        raise argparse.ArgumentTypeError("a share is from 0 to 1")
    return float(text)


def add_number(to, name, default, what, least=0):
    """An option for a whole number of at least `least`; `what` it is goes into the help."""
    shown = "" if default is None else f"; default: {default}"
    to.add_argument(name, type=whole(least), default=default, metavar="N", help=what + shown)


def add_flags(to, **flags):
    """Options without a value: name=help."""
    for name, what in flags.items():
        to.add_argument(f"--{name.replace('_', '-')}", action="store_true", help=what)


def add_path(to, *names, what, metavar="FILE", **more):
    """An option for a path."""
    to.add_argument(*names, type=Path, metavar=metavar, help=what, **more)


def add_jobs(to, what):
    """--jobs N: how many of `what` at the same time."""
    what = f"{what} at the same time; default: one per core"
    to.add_argument("--jobs", type=whole(1), default=os.cpu_count(), metavar="N", help=what)


def add_json(to):
    """--json FILE: a Path, or None."""
    add_path(to, "--json", what="write the results here")


def add_folder(to, what):
    """-o DIR, as `out`, and its old name."""
    add_path(to, "-o", "--output", dest="out", metavar="DIR", what=what)
    to.add_argument("--out", dest="out", type=Path, help=argparse.SUPPRESS)


def add_keep(to, what):
    """--keep DIR; check_keep() looks at it."""
    add_path(to, "--keep", metavar="DIR", what=f"keep {what} in this new folder")


def check_keep(to, folder):
    """Ends with 2 where there is something in the folder, which is made if it is not there."""
    if folder and folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        to.error(f"argument --keep: {folder} is not an empty folder; name a new one")


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
