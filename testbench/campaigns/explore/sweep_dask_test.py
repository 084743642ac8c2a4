#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A sweep over dask: a scheduler and two workers on loopback, one of them killed in mid-sweep.

Documentation: docs/speed-for-accuracy.md
"""

import importlib.util
import json
import os
import signal
import subprocess
import sys
import unittest

from bench import Bench


@unittest.skipUnless(importlib.util.find_spec("distributed"), "no python3-distributed")
class Dask(Bench):
    def start(self, module, *words):
        options = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        options["env"] = self.environment(FAKE_POINT_DELAY_S="0.3")
        return self.started(sys.executable, "-m", f"distributed.cli.{module}", *words, **options)

    def start_cluster(self):
        file = self.folder / "scheduler.json"
        here = ("--no-dashboard", "--host", "127.0.0.1")
        self.start("dask_scheduler", *here, "--port", 0, "--scheduler-file", file)
        self.until(file.exists)
        address = json.loads(file.read_text())["address"]
        one = (address, *here, "--nthreads", 1, "--no-nanny")
        workers = [self.start("dask_worker", *one, "--name", name) for name in ("w1", "w2")]
        from distributed import Client

        with Client(address, timeout=30) as client:
            client.wait_for_workers(2, timeout=60)
        return address, workers

    def test_a_killed_worker_costs_nothing(self):
        wanted = self.whole()
        address, workers = self.start_cluster()
        folder = self.plan("over_dask")
        self.log.unlink()
        command = self.command("run", folder, "--engine", "dask", "--scheduler", address)
        options = {"env": self.environment(), "stderr": subprocess.PIPE, "text": True}
        process = self.started(*command, **options)
        # Both workers are in the middle of their first chunks.
        self.until(lambda: len(self.evaluations()) >= 4)
        os.kill(workers[0].pid, signal.SIGKILL)
        workers[0].wait()
        said = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 0, said)
        self.good("merge", folder)
        self.assertEqual((folder / "points.jsonl").read_bytes(), wanted)
        self.assertGreater(len(self.evaluations()), 24, "the killed worker lost nothing: too late?")

    def test_a_cluster_of_this_machine(self):
        wanted = self.whole()
        folder = self.plan("local_cluster")
        self.good("run", folder, "--engine", "dask", "--jobs", 2)
        self.good("merge", folder)
        self.assertEqual((folder / "points.jsonl").read_bytes(), wanted)

    def test_no_scheduler_is_said(self):
        folder = self.plan("nobody")
        done = self.explore("run", folder, "--engine", "dask", "--scheduler", "tcp://127.0.0.1:9")
        self.assertEqual(done.returncode, 2)
        self.assertIn("dask at tcp://127.0.0.1:9", done.stderr)


if __name__ == "__main__":
    unittest.main()
