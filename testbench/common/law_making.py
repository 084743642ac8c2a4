# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the tests of the commands that write a law share: a folder in which they run, a refusal."""

import os

from testing import BUILD, ROOT, Scratch, ran  # noqa: F401


class LawMaking(Scratch):
    """In a scratch folder; a test of `feltgate COMMAND`."""

    COMMAND = ""

    def run_it(self, *words):
        """The program with these words."""
        return ran(BUILD / "feltgate", *words, cwd=self.folder)

    def refused(self, said, *words):
        """One line with what is wrong and what to do, and no file."""
        before = sorted(os.listdir(self.folder))
        done = self.ended(self.run_it(self.COMMAND, *words, "-o", "out.law"), 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(said, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
