# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the tests of the host's programs share: a folder of their own in which they run, and how
lines are compared whose numbers differ from run to run."""

import os
import re
import subprocess

from testing import BUILD, ROOT, Scratch, ran


def pattern_of(line):
    """Numbers, and how columns are filled, differ from run to run."""
    line = line.replace(str(ROOT) + "/", "")
    line = re.sub(r"0x[0-9a-f]+|[-+]?\d[\d.]*(?:e[-+]?\d+)?", "#", line)
    return re.sub(r"\s+", " ", line).strip()


def patterns_of(text):
    """Its lines without what differs from run to run; of several alike in a row, one. A machine
    that is busy answers late, and then the host asks again, and says so."""
    patterns = [pattern_of(line) for line in text.splitlines() if not line.startswith("link: ")]
    return [p for n, p in enumerate(patterns) if n == 0 or p != patterns[n - 1]]


class ProgramTest(Scratch):
    """A test with a folder of its own."""

    def environment(self):
        return os.environ | {"FELTGATE_ROOT": str(ROOT)}

    def run_program(self, program, *words, status=0, typed="", timeout=120):
        """What it says, stdout first, when it ends with this status."""
        options = {"env": self.environment(), "cwd": self.folder, "timeout": timeout}
        done = ran(BUILD / program, *words, input=typed, **options)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def start_program(self, program, *words, stdin=None, stderr=subprocess.PIPE):
        """A process; who starts it ends it, or the test's end does."""
        pipes = {"stdin": stdin, "stdout": subprocess.PIPE, "stderr": stderr, "text": True}
        return self.started(BUILD / program, *words, env=self.environment(), **pipes)
