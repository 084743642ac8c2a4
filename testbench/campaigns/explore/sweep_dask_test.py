#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A sweep over dask: a scheduler and two workers on loopback, one of them killed in mid-sweep.

Documentation: docs/explore.md
"""

import importlib.util
import json
import os
import signal
import subprocess
import sys
import time
import unittest

from bench import Bench


@unittest.skipUnless(importlib.util.find_spec("distributed"), "no python3-distributed")
class Dask(Bench):
    def start(self, module, *words):
        process = subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{module}", *map(str, words)],
            env=self.environment(FAKE_POINT_DELAY_S="0.3"),
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def start_cluster(self):
        file = self.folder / "scheduler.json"
        self.start(
            "dask_scheduler",
            "--host",
            "127.0.0.1",
            "--port",
            0,
            "--no-dashboard",
            "--scheduler-file",
            file,
        )
        self.wait_until(file.exists)
        address = json.loads(file.read_text())["address"]
        workers = [
            self.start(
                "dask_worker",
                address,
                "--nthreads",
                1,
                "--no-nanny",
                "--no-dashboard",
                "--host",
                "127.0.0.1",
                "--name",
                f"w{i}",
            )
            for i in (1, 2)
        ]
        from distributed import Client

        with Client(address, timeout=30) as client:
            client.wait_for_workers(2, timeout=60)
        return address, workers

    def wait_until(self, true):
        end = time.monotonic() + 60
        while not true():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)

    def test_a_killed_worker_costs_nothing(self):
        wanted = self.whole()
        address, workers = self.start_cluster()
        folder = self.plan("over_dask")
        self.log.unlink()
        process = subprocess.Popen(
            self.command("run", folder, "--engine", "dask", "--scheduler", address),
            env=self.environment(),
            stderr=subprocess.PIPE,
            text=True,
        )
        # Both workers are in the middle of their first chunks.
        self.wait_until(lambda: len(self.evaluations()) >= 4)
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
