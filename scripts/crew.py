# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Programs that threads run in parallel. A signal reaches only the main thread, so the code that
waits there ends all programs; none is started afterwards.
"""

import contextlib
import os
import signal
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed

import interrupts
from reports.progress import Steps


class Crew:
    """Knows every program that is running."""

    def __init__(self):
        self._lock = threading.Lock()
        self._running = set()
        self._ended = False

    def start(self, command, **options):
        """subprocess.Popen, which wait() must follow; Interrupted after end()."""
        with self._lock:
            if self._ended:
                raise interrupts.Interrupted()
            process = subprocess.Popen(command, **options)
            self._running.add(process)
        return process

    def wait(self, process, limit_s=None):
        """(status, seconds of CPU time of it and of those that it waited for); the status is None
        where it was killed, for it took longer than the limit."""
        late = threading.Event()

        def kill():
            late.set()
            self.kill(process)

        timer = threading.Timer(limit_s, kill) if limit_s else None
        if timer:
            timer.start()
        try:
            os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
        except BaseException:
            self.kill(process)
            raise
        finally:
            if timer:
                timer.cancel()
            with self._lock:  # as long as it is known its number is its own
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                self._running.discard(process)
        return None if late.is_set() else process.returncode, usage.ru_utime + usage.ru_stime

    def timed(self, command, limit_s=None, **options):
        """Both at once."""
        return self.wait(self.start(command, **options), limit_s)

    def run(self, command, limit_s=None, **options):
        """subprocess.run without check=; TimeoutExpired after the limit."""
        process = self.start(command, **options)
        try:
            out, err = process.communicate(timeout=limit_s)
        except BaseException:
            process.kill()
            process.communicate()
            raise
        finally:
            with self._lock:
                self._running.discard(process)
        interrupts.check(process.returncode)
        return subprocess.CompletedProcess(command, process.returncode, out, err)

    def each(self, function, items, jobs, done):
        """function(item) of all in threads; done(item, result) here, as they come. What breaks it
        off ends every program."""
        with ThreadPoolExecutor(jobs) as pool:
            try:
                pending = {pool.submit(function, item): item for item in items}
                for future in as_completed(pending):
                    done(pending[future], future.result())
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                self.end()
                raise

    def counted(self, name, function, items, jobs, done):
        """The same with a line of progress; done(item, result, progress) returns what was done."""
        items = list(items)
        with Steps(name, len(items)) as progress:

            def step(item, result):
                progress.step(done(item, result, progress))

            self.each(function, items, jobs, step)

    def end(self):
        """Ends all that is running, politely at first."""
        with self._lock:
            self._ended = True
        self._send(signal.SIGTERM)
        give_up = time.monotonic() + interrupts.PATIENCE_S
        while self._running and time.monotonic() < give_up:
            time.sleep(0.02)
        self._send(signal.SIGKILL)

    def kill(self, process):
        """At once; wait() still follows."""
        self._send(signal.SIGKILL, process)

    def _send(self, number, process=None):
        with self._lock:
            for one in self._running if process is None else self._running & {process}:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(one.pid, number)
