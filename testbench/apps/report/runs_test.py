#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Jobs, their results and their progress. Documentation: docs/figures.md"""

import fcntl
import io
import os
import time
import unittest
from unittest import mock

from bench import Bench  # isort: skip (puts scripts/ on the path)
from building import Beside, BuildError
from reports import runs
from reports.progress import Progress


class Csv(Bench):
    def table(self, text):
        path = self.folder / "run.csv"
        path.write_text(text)
        return path

    def test_columns(self):
        csv = runs.read_csv(self.table("time_s,duty\n1,2\n3,4\n"))
        self.assertEqual(list(csv["duty"]), [2, 4])

    def test_long_tables_are_thinned_evenly(self):
        path = self.table("time_s,duty\n" + "".join(f"{i:06d},1\n" for i in range(10_000)))
        time = runs.read_csv(path, most_rows=100)["time_s"]
        self.assertLessEqual(len(time), 101)
        self.assertEqual(len(set(time[1:] - time[:-1])), 1)

    def test_short_first_rows_do_not_thin_the_rest(self):
        rows = "".join(f"{i},{'0' if i < 9000 else '0.123456789012345'}\n" for i in range(10_000))
        time = runs.read_csv(self.table("time_s,duty\n" + rows), most_rows=1000)["time_s"]
        self.assertEqual(len(time), 1000)

    def test_complaints_name_the_file(self):
        for text in ("", "a,b\n1,2\n", "time_s,duty\n", "time_s,duty\n1,x\n", "time_s\n1,2\n"):
            with self.subTest(text), self.assertRaisesRegex(ValueError, "run.csv"):
                runs.read_csv(self.table(text))


class Jobs(Bench):
    def run_all(self, jobs, **environment):
        self.stream = io.StringIO()
        variables = mock.patch.dict(os.environ, self.environment(**environment), clear=True)
        with variables, Progress(jobs, self.stream) as progress:
            return runs.run_all(jobs, self.folder / "data", progress)

    def test_results_keep_the_order_of_the_jobs(self):
        jobs = [runs.scene_job(s, every=500) for s in ("torque_step", "membrane")]
        found = self.run_all(jobs)
        self.assertEqual(list(found), ["torque_step-lever", "membrane-lever"])
        self.assertEqual(found["membrane-lever"].summary["scene"], "membrane")
        self.assertIn("[2/2]", self.stream.getvalue())
        self.assertAlmostEqual(found["membrane-lever"].csv["time_s"][-1], 3.0, places=6)

    def test_mismatches_are_told(self):
        job = runs.scene_job("torque_step", every=500)
        run = self.run_all([job], FAKE_MISMATCHES="7")[job.name]
        self.assertEqual((run.status, run.mismatches), (1, 7))
        self.assertIn("7 mismatches, 1 broken expectations", self.stream.getvalue())

    def test_what_cannot_run_is_told_and_stale_results_are_gone(self):
        (self.folder / "data").mkdir()
        (self.folder / "data" / "x.json").write_text('{"mismatches": 0}')
        run = self.run_all([runs.Job("x", ("replay", "nowhere.sr"), 1.0)])["x"]
        self.assertFalse(run.ran)
        self.assertEqual(run.status, 2)
        self.assertIn("nowhere.sr", run.complaint)

    def test_the_first_and_what_can_start_go_before_the_longest(self):
        jobs = [runs.Job(n, ("run", "damper"), s) for n, s in (("a", 9), ("b", 5), ("c", 1))]
        begun, free = [], set("bc")
        with mock.patch.object(runs, "start", lambda job, *_: begun.append(job.name) or runs.Run(job, 0)):

            def ended(run):
                if run.job.name == "b":
                    free.add("a")

            runs.run_all(jobs, self.folder / "data", mock.MagicMock(), 1, first=("c",),
                         ready=lambda job: job.name in free, ended=ended)
        self.assertEqual(begun, ["c", "b", "a"])

    def test_a_program_that_cannot_be_built_ends_all(self):
        def ready(job):
            raise BuildError("no")

        with self.assertRaises(BuildError):
            runs.run_all([runs.Job("a", (), 1.0)], self.folder / "data", mock.MagicMock(),
                         ready=ready)

    def test_without_a_program(self):
        with self.assertRaisesRegex(FileNotFoundError, "not built"):
            self.run_all([], FELTGATE_PROGRAM=str(self.folder / "none"))


class Building(Bench):
    """Programs that are built while others run."""

    def builds(self, script):
        self.put_program("ninja", script)
        path = f"{self.folder}:{os.environ['PATH']}"
        self.enterContext(mock.patch.dict(os.environ, PATH=path))
        return Beside(self.folder, ["one", "two"])

    def test_one_after_the_other(self):
        with self.builds(f'echo "[7/9] $3"; echo $3 >> {self.folder}/done') as builds:
            self.assertTrue(builds.ready("another"))
            builds.wait("two")
            self.assertTrue(builds.ready("one"))
        self.assertEqual((self.folder / "done").read_text(), "one\ntwo\n")
        self.assertEqual(builds.text(), "")

    def test_a_failure_is_told(self):
        with self.builds('test "$3" = one') as builds:
            with self.assertRaisesRegex(BuildError, "two was not built; the whole log: .*build.log"):
                builds.wait("two")
            self.assertTrue(builds.ready("one"))

    def test_left_early_it_ends(self):
        with self.builds(f"echo $$ > {self.folder}/pid.part; mv {self.folder}/pid.part {self.folder}/pid; exec sleep 300") as builds:
            self.until((self.folder / "pid").exists)
        self.assertRaises(ProcessLookupError, os.kill, int((self.folder / "pid").read_text()), 0)
        self.assertFalse((self.folder / "done").exists())
        self.assertEqual((builds.text(), builds.failure), ("", ""))

    def test_another_start_is_waited_for_and_can_be_left(self):
        (self.folder / "launcher").mkdir()
        with open(self.folder / "launcher" / "lock", "wb") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            with self.builds(f"touch {self.folder}/done"):
                time.sleep(0.5)
        self.assertFalse((self.folder / "done").exists())


if __name__ == "__main__":
    unittest.main()
