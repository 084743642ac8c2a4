# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A board in software on a pseudo-terminal, for what talks to one."""

import os
import subprocess
from pathlib import Path


class BoardProcess:
    """with BoardProcess() as board: board.port, board.order("fault 2"). Of its line this noise."""

    def __init__(self, *noise):
        self.process = subprocess.Popen(
            [Path(os.environ["FELTGATE_BUILD"]) / "feltgate_software_board", *map(str, noise)],
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
