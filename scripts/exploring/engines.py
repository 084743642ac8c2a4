# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Who runs the chunks: processes of this machine, or dask workers anywhere with the same folders.

Either starts the same command per chunk, `explore run DIR --chunk I/N`, which writes the chunk file;
nothing but its name comes back. Documentation: docs/explore.md
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from exploring import chunks

SCRIPT = Path(__file__).resolve().parents[1] / "explore.py"
POLL_S = 0.05
# A worker that dies takes its chunk along; the scheduler gives it to another this many times.
RETRIES = 5
CONNECT_S = 10


class EngineError(Exception):
    """A chunk that failed, with what it said."""


def command(plan, index, count):
    return [sys.executable, "-B", str(SCRIPT), "run", str(plan.folder), "--chunk", f"{index}/{count}"]


def plain(said):
    """What a chunk said, without the name that is put before it again."""
    return said.strip().removeprefix("explore: ")


def open_chunks(plan, count, sources, meter):
    """Numbers of the chunks that are not there yet."""
    chunks.sweep_up(plan)
    left = []
    for index in range(1, count + 1):
        if chunks.is_done(plan, index, count, sources):
            meter.skip(len(plan.chunk(index, count)))
        else:
            left.append(index)
    return left


def stop(processes):
    """Ends the chunks under way with all that they started."""
    for process in processes:
        try:
            os.killpg(process.pid, signal.SIGTERM)
        except ProcessLookupError:
            continue
    for process in processes:
        process.wait()


def local(plan, count, sources, jobs, meter):
    """Runs what is missing, `jobs` chunks at a time."""
    waiting = open_chunks(plan, count, sources, meter)
    running = {}
    environment = os.environ | {"FELTGATE_EXPLORE_PARENT": str(os.getpid())}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                index = waiting.pop(0)
                process = subprocess.Popen(
                    command(plan, index, count),
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.PIPE,
                    text=True,
                    env=environment,
                    start_new_session=True,
                )
                running[process] = index
            ended = [process for process in running if process.poll() is not None]
            for process in ended:
                index = running.pop(process)
                said = process.stderr.read()
                process.stderr.close()
                if process.returncode:
                    raise EngineError(plain(said) or f"chunk {index}/{count}: no word on why")
                meter.finish(len(plan.chunk(index, count)))
            if not ended:
                time.sleep(POLL_S)
    finally:
        stop(running)


def dask(plan, count, sources, scheduler, jobs, meter):
    """The same over a dask scheduler's address, or over a cluster of this machine (None)."""
    try:
        from distributed import Client, LocalCluster, as_completed
    except ImportError:
        raise EngineError("no dask here; apt-get install python3-distributed") from None

    # Nested, so that it travels by value: a worker needs none of our modules.
    def run_chunk(words, more):
        import os
        import subprocess

        environment = os.environ | more | {"FELTGATE_EXPLORE_PARENT": str(os.getpid())}
        done = subprocess.run(words, capture_output=True, text=True, env=environment, check=False)
        return done.returncode, done.stdout.strip() or done.stderr.strip()

    waiting = open_chunks(plan, count, sources, meter)
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
            for index in waiting:
                words = command(plan, index, count)
                future = client.submit(run_chunk, words, carried, pure=False, retries=RETRIES)
                futures[future] = index
            for future in as_completed(list(futures)):
                index = futures.pop(future)
                status, said = future.result()
                future.release()
                if status:
                    raise EngineError(plain(said) or f"chunk {index}/{count}: no word on why")
                meter.finish(len(plan.chunk(index, count)))
    except OSError as error:
        raise EngineError(f"dask at {scheduler or 'this machine'}: {error}") from None
    finally:
        if cluster is not None:
            cluster.close()
