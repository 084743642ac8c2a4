# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Builds targets in a configured build folder, for commands that build the programs they run."""

import fcntl
import os
import re
import subprocess
import sys
import threading
import time
from pathlib import Path

from command_line import Refused
import interrupts
from crew import Crew


class BuildError(Refused):
    """The build failed; the message has its last lines and where the others are."""


def make(command, build, targets, jobs):
    """Builds them; the output goes to COMMAND.log in the folder."""
    print(f"{command}: building {len(targets)} programs in {build}", file=sys.stderr, flush=True)
    log = build / f"{command}.log"
    with log.open("wb") as file:
        done = interrupts.run(
            ["cmake", "--build", build, "-j", str(jobs), "--target", *targets],
            stdout=file,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
        )
    if done.returncode:
        last = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()[-10:]
        raise BuildError("\n".join([f"the build failed; the whole log: {log}", *last]))


class Beside:
    """Programs that are built one after the other while the caller does other work. The launcher's
    lock is held meanwhile. Left early, the build ends."""

    POLL_S = 0.2

    def __init__(self, build, targets):
        self.build, self.targets = Path(build), list(targets)
        self.built, self.now, self.step, self.failure = set(), "", "", ""
        self._crew, self._ended = Crew(), threading.Event()
        self._thread = threading.Thread(target=self._work, daemon=True)

    def __enter__(self):
        if self.targets:
            self._thread.start()
        return self

    def __exit__(self, *_):
        self._ended.set()
        self._crew.end()
        if self.targets:
            self._thread.join()

    def ready(self, program):
        """Whether a program can be started: it is not to be built, or is built. BuildError where
        it never will be."""
        if program not in self.targets or program in self.built:
            return True
        if self.failure:
            raise BuildError(self.failure)
        return False

    def wait(self, program):
        """Until it can be started."""
        while not self.ready(program):
            time.sleep(self.POLL_S)

    def text(self):
        """What is being built, for a line of progress; "" where all is."""
        return f"building {self.now} {self.step}".rstrip() if self.now else ""

    def _work(self):
        state = self.build / "launcher"
        try:
            state.mkdir(parents=True, exist_ok=True)
            with open(state / "lock", "ab") as lock, open(state / "build.log", "ab") as log:
                self._lock(lock)
                for target in self.targets:
                    self.now = target
                    if self._make(target, log):
                        if not self._ended.is_set():
                            self.failure = f"{target} was not built; the whole log: {log.name}"
                        return
                    self.built.add(target)
        except OSError as error:
            self.failure = f"the build stopped: {error}"
        except interrupts.Interrupted:
            pass  # The caller has left.
        finally:
            self.now = ""

    def _lock(self, lock):
        """Another start may build in the same folder for minutes."""
        while True:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return
            except BlockingIOError:
                if self._ended.wait(self.POLL_S):
                    raise interrupts.Interrupted() from None

    def _make(self, target, log):
        """The status of the build of one target."""
        process = self._crew.start(
            ["ninja", "-C", self.build, target],
            env={**os.environ, "NINJA_STATUS": "[%f/%t] "},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        try:
            with process.stdout:
                for line in process.stdout:
                    log.write(line)
                    if found := re.match(rb"\[\d+/\d+\]", line):
                        self.step = found[0].decode()
        finally:
            status = self._crew.wait(process)[0]
        return status
