#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Running and merging: the same bytes whatever the order, and after any kind of interruption.

Documentation: docs/speed-for-accuracy.md
"""

import os
import signal
import subprocess
import unittest

from bench import Bench


def ignore_interrupts():
    signal.signal(signal.SIGINT, signal.SIG_IGN)


class Merge(Bench):
    def test_bytes_do_not_depend_on_order_or_count(self):
        wanted = self.whole()
        folder = self.plan("parts")
        for index in (3, 1, 5, 2, 4):
            self.good("run", folder, "--chunk", f"{index}/5")
        self.good("merge", folder)
        self.assertEqual((folder / "points.jsonl").read_bytes(), wanted)
        self.assertEqual(wanted.count(b"\n"), 24)

    def test_all_at_once_is_the_same(self):
        wanted = self.whole()
        folder = self.folder / "all"
        self.good(self.space, "-o", folder, "--jobs", 3, "--no-route")
        self.assertEqual((folder / "points.jsonl").read_bytes(), wanted)

    def test_gaps_are_refused(self):
        folder = self.plan()
        self.good("run", folder, "--chunk", "1/3")
        self.good("run", folder, "--chunk", "3/3")
        self.ended(self.explore("merge", folder), 2, "missing chunks of 3: 2")
        self.assertFalse((folder / "points.jsonl").exists())

    def test_duplicates_are_refused(self):
        folder = self.plan()
        self.good("run", folder, "--chunk", "1/1")
        self.good("run", folder, "--chunk", "2/3")
        self.ended(self.explore("merge", folder), 2, "overlap")

    def test_strangers_are_refused(self):
        folder = self.plan()
        self.good("run", folder, "--chunk", "1/1")
        chunk = folder / "chunks/00001-of-00001.jsonl"
        text = chunk.read_text()
        head, first, *_ = text.splitlines()
        other = folder / "chunks/00002-of-00002.jsonl"
        for content, word in (
            (head.replace('"plan":"', '"plan":"0'), "another plan"),
            (head + "\n" + first.replace('"id":"', '"id":"0'), "not in the plan"),
            (head.replace('"sources":"', '"sources":"0'), "different sources"),
        ):
            other.write_text(content + "\n")
            self.ended(self.explore("merge", folder), 2, word)

    def test_stale_chunks_are_run_again(self):
        folder = self.plan()
        self.good("run", folder, "--chunk", "1/1")
        chunk = folder / "chunks/00001-of-00001.jsonl"
        good = chunk.read_bytes()
        chunk.write_bytes(good.replace(b'"sources":"', b'"sources":"0', 1))
        self.good("run", folder, "--chunk", "1/1")
        self.assertEqual(chunk.read_bytes(), good)


class Interrupted(Bench):
    def start(self, folder, *words, delay="0.1", before=None):
        options = {"stderr": subprocess.DEVNULL, "preexec_fn": before}
        options["env"] = self.environment(FAKE_POINT_DELAY_S=delay)
        return self.started(*self.command("run", folder, *words), **options)

    def wait_for(self, count):
        self.until(lambda: len(self.evaluations()) >= count)

    def test_what_is_done_is_not_done_again(self):
        folder = self.plan()
        for index in (1, 2, 3, 1, 2):
            self.good("run", folder, "--chunk", f"{index}/3")
        self.assertEqual(len(self.evaluations()), 24)
        self.good("run", folder, "--chunk", "1/3")
        self.assertEqual(len(self.evaluations()), 24)

    def test_a_killed_run_goes_on(self):
        wanted = self.whole()
        for how in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT):
            with self.subTest(how.name):
                folder = self.plan(how.name)
                self.log.unlink()
                # As in a shell's background job, where SIGINT is ignored.
                ignoring = how == signal.SIGTERM
                process = self.start(
                    folder, "--jobs", "1", before=ignore_interrupts if ignoring else None
                )
                self.wait_for(8)  # the first structure has six points
                os.kill(process.pid, how)
                self.assertNotEqual(process.wait(), 0)
                files = [path.name for path in (folder / "chunks").glob("[0-9]*")]
                self.assertTrue(0 < len(files) < 4, files)
                self.good("run", folder)
                self.good("merge", folder)
                self.assertEqual((folder / "points.jsonl").read_bytes(), wanted)
                # Only the chunk under way was done twice; an orphan may have begun one point more.
                self.assertLessEqual(len(self.evaluations()), 24 + 6)
                self.assertEqual(list((folder / "chunks").glob(".*")), [])

    def test_a_failing_point_is_named(self):
        folder = self.plan()
        name = self.whole().split(b'"id":"')[3][:12].decode()
        done = self.ended(self.explore("run", folder, FAKE_POINT_FAIL=name), 2)
        self.assertIn(f"point {name} cannot be built", done.stderr)
        self.assertRegex(done.stderr, r'^explore: point \{"[^}]*\} of lever: ')
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
