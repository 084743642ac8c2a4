# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs the parts of a sweep in processes of this machine, or in dask workers with the same folders.

Both start the same command per part, such as `explore run DIR --chunk I/N`, which writes a file.
Only the name of the file comes back. Documentation: docs/speed-for-accuracy.md
"""

import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from command_line import Refused
import interrupts

SCRIPT = Path(__file__).resolve().parents[1] / "explore.py"
PARENT = "FELTGATE_EXPLORE_PARENT"  # a part whose starter is gone stops by itself
POLL_S = 0.05
CONNECT_S = 10


class EngineError(Refused):
    """A part that failed, with what it said."""


@dataclass(frozen=True)
class Part:
    """Words after `explore`, and how many points they stand for."""

    words: tuple
    points: int

    def command(self):
        return [sys.executable, "-B", str(SCRIPT), *self.words]

    def check(self, status, said):
        interrupts.check(status)
        if status:
            said = said.strip().removeprefix("explore: ")
            how = interrupts.how_it_ended(status)
            raise EngineError(said or f"explore {' '.join(self.words)}: {how}")


def stop(processes):
    """Ends the parts under way with all that they started."""
    for process in processes:
        try:
            os.killpg(process.pid, signal.SIGTERM)
        except ProcessLookupError:
            continue
    for process in processes:
        process.wait()
        process.stderr.close()


def start(part):
    return subprocess.Popen(
        part.command(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {PARENT: str(os.getpid())},
        start_new_session=True,
    )


def local(parts, jobs, finished):
    """Runs the parts, `jobs` at a time; finished(points) after each."""
    waiting, running = list(parts), {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                part = waiting.pop(0)
                with interrupts.Held():
                    running[start(part)] = part
            ended = [process for process in running if process.poll() is not None]
            for process in ended:
                part = running.pop(process)
                said = process.stderr.read()
                process.stderr.close()
                part.check(process.returncode, said)
                finished(part.points)
            if not ended:
                time.sleep(POLL_S)
    finally:
        stop(running)


def dask(parts, scheduler, jobs, finished):
    """The same over a dask scheduler's address, or over a cluster of this machine (None)."""
    try:
        from distributed import Client, LocalCluster, as_completed
    except ImportError:
        raise EngineError("no dask here; apt-get install python3-distributed") from None

    # Nested, so that it travels by value: a worker needs none of our modules.
    def run_part(command, carried, parent):
        import os
        import subprocess

        environment = os.environ | carried | {parent: str(os.getpid())}
        done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
        return done.returncode, done.stderr

    carried = {key: value for key, value in os.environ.items() if key.startswith("FELTGATE_")}
    carried |= {key: os.environ[key] for key in ("PATH", "PYTHONPATH") if key in os.environ}
    cluster = None
    if scheduler is None:
        cluster = LocalCluster(
            n_workers=jobs, threads_per_worker=1, dashboard_address=None, silence_logs=40
        )
    try:
        with Client(scheduler or cluster, timeout=CONNECT_S) as client:
            futures = {}
            for part in parts:
                # A worker that dies takes its part along; the scheduler gives it to another one.
                future = client.submit(run_part, part.command(), carried, PARENT, pure=False)
                futures[future] = part
            for future in as_completed(list(futures)):
                part = futures.pop(future)
                try:
                    status, said = future.result()
                except Exception as error:  # such as KilledWorker: it killed too many workers
                    raise EngineError(f"explore {' '.join(part.words)}: {error}") from None
                future.release()
                part.check(status, said)
                finished(part.points)
    except OSError as error:
        raise EngineError(f"dask at {scheduler or 'this machine'}: {error}") from None
    finally:
        if cluster is not None:
            cluster.close()
