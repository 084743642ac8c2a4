#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Jobs, their results and their progress. Documentation: docs/figures.md"""

import io
import os
import unittest
from unittest import mock

from bench import Bench  # isort: skip (puts scripts/ on the path)
from reporting import runs
from reporting.progress import Progress


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

    def test_without_a_program(self):
        with self.assertRaisesRegex(FileNotFoundError, "not built"):
            self.run_all([], FELTGATE_PROGRAM=str(self.folder / "none"))


class Bar(unittest.TestCase):
    def test_line_fits_and_counts(self):
        jobs = [runs.Job("a", (), 10.0), runs.Job("b", (), 30.0)]
        progress = Progress(jobs, io.StringIO(), width=79)
        progress.begin(jobs[1])
        run = runs.Run(jobs[1], 0, took_s=60.0)
        progress.end(jobs[1], run)
        self.assertIn("75 %  1/2", progress.line())
        self.assertLess(len(progress.line()), 79)


if __name__ == "__main__":
    unittest.main()
