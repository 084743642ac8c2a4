# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A board in software on a pseudo-terminal, for what talks to one."""

import os
import subprocess
import unittest
from pathlib import Path


def need_terminals():
    """Skips the test on a machine without pseudo-terminals."""
    try:
        for descriptor in os.openpty():
            os.close(descriptor)
    except OSError as error:
        raise unittest.SkipTest(f"no pseudo-terminals, {error}: mount devpts at /dev/pts") from None


def board_program(words, kind=""):
    """The program of `feltgate board` with these options; kind "_rtl" has the RTL of any design."""
    design = words[words.index("--design") + 1] if "--design" in words else "lever"
    return f"feltgate_board{kind}_{design}" if kind else "feltgate_board"


class BoardProcess:
    """with BoardProcess() as board: board.port, board.order("fault 2")."""

    def __init__(self):
        need_terminals()
        self.process = subprocess.Popen(
            [Path(os.environ["FELTGATE_BUILD"]) / "feltgate_software_board"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.port = self.process.stdout.readline().strip()

    def order(self, words):
        self.process.stdin.write(words + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()
