#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A sweep: the same bytes whatever the order and the parts, and after any kind of interruption.

Documentation: docs/speed-for-accuracy.md
"""

import os
import signal
import subprocess
import unittest

from bench import SPACE, Bench


class Parts(Bench):
    def test_parts_make_the_whole_and_nothing_is_done_twice(self):
        wanted = self.whole()
        self.assertEqual(wanted.count(b"\n"), 24)
        self.log.unlink()
        folder = self.folder / "parts"
        for index in (3, 1, 5, 2, 4, 2):
            self.good(self.space, "-o", folder, "--part", f"{index}/5")
            self.assertFalse((folder / "points.jsonl").exists())
        self.good(self.space, "-o", folder, "--no-route")
        self.assertEqual((folder / "points.jsonl").read_bytes(), wanted)
        self.assertEqual(len(self.evaluations()), 24)

    def test_stale_results_are_measured_again(self):
        wanted = self.whole()
        path = next((self.folder / "whole/measured").iterdir())
        path.write_text(path.read_text().replace('"sources":"', '"sources":"0'))
        self.assertEqual(self.whole(), wanted)
        self.assertEqual(len(self.evaluations()), 25)

    def test_another_space_and_wrong_parts_are_refused(self):
        self.whole()
        for text in ("0/4", "5/4", "4", "a/b", "1/0"):
            self.ended(self.explore(self.space, "--part", text), 2, "wanted I/N")
        self.space.write_text(SPACE.replace("767", "768"), encoding="utf-8")
        self.ended(self.explore(self.space, "-o", self.folder / "whole"), 2, "another space")


class Interrupted(Bench):
    def test_a_killed_sweep_goes_on(self):
        wanted = self.whole()
        for how in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT):
            with self.subTest(how.name):
                self.log.unlink()
                words = (self.space, "-o", self.folder / how.name, "--jobs", 1, "--no-route")
                env = self.environment(FAKE_POINT_DELAY_S="0.1")
                process = self.started(*self.command(*words), env=env, stderr=subprocess.DEVNULL)
                self.until(lambda: len(self.evaluations()) >= 4)
                os.kill(process.pid, how)
                self.assertNotEqual(process.wait(), 0)
                self.good(*words)
                self.assertEqual((self.folder / how.name / "points.jsonl").read_bytes(), wanted)
                self.assertLessEqual(len(self.evaluations()), 24 + 2)
                self.assertEqual(list((self.folder / how.name).rglob("*.part")), [])

    def test_a_failing_point_is_named(self):
        name = self.whole().split(b'"id":"')[3][:12].decode()
        words = (self.space, "-o", self.folder / "fails")
        done = self.ended(self.explore(*words, FAKE_POINT_FAIL=name), 2)
        said = done.stderr.splitlines()
        self.assertIn(f"point {name} cannot be built", said[-1])
        self.assertRegex(said[-1], r'^explore: point \{"[^}]*\} of lever: ')
        self.assertEqual(len(said), 2, done.stderr)


if __name__ == "__main__":
    unittest.main()
