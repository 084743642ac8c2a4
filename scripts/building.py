# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Builds targets in a configured build folder, for commands that build the programs they run."""

import subprocess
import sys

from command_line import Refused
import interrupts


class BuildError(Refused):
    """The build failed; the message has its last lines and where the others are."""


def make(command, build, targets, jobs):
    """Builds them; the output goes to COMMAND.log in the folder."""
    print(f"{command}: building {len(targets)} programs in {build}", file=sys.stderr, flush=True)
    log = build / f"{command}.log"
    with log.open("wb") as file:
        done = interrupts.run(
            ["cmake", "--build", build, "-j", str(jobs), "--target", *targets],
            stdout=file,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
        )
    if done.returncode:
        last = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()[-10:]
        raise BuildError("\n".join([f"the build failed; the whole log: {log}", *last]))
