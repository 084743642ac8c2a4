# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs feltgate_faults in parts at the same time and reads its lines."""

import json
import subprocess
import tempfile
import threading
from pathlib import Path


class CampaignError(Exception):
    """What went wrong, and what to do."""


def parse(text, where):
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise CampaignError(f"{where}: no line of JSON: {text.strip()[:60]!r}") from error


def read(path):
    """Faults of an earlier run's lines."""
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise CampaignError(f"{path}: {error.strerror}") from error
    found = [parse(line, path) for line in lines if line.strip() and not line.startswith("#")]
    return [fault for fault in found if "class" in fault]


class Parts:
    """The same program several times, each with a part of the work."""

    def __init__(self, program, arguments, jobs, told):
        self.lines, self.lock, self.told = [], threading.Lock(), told
        self.errors = [tempfile.TemporaryFile() for _ in range(jobs)]
        self.running = []
        for part, errors in enumerate(self.errors):
            command = [program, *map(str, arguments), "--parts", str(jobs), "--part", str(part)]
            self.running.append(subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, text=True,
                                                 stdin=subprocess.DEVNULL))
        self.threads = [threading.Thread(target=self.listen, args=(number, process), daemon=True)
                        for number, process in enumerate(self.running)]

    def listen(self, number, process):
        for line in process.stdout:
            found = parse(line, "feltgate_faults")
            with self.lock:
                self.lines.append(found)
                self.told(number, found)

    def run(self):
        """All lines; raises where a program failed other than by what it found."""
        try:
            for thread in self.threads:
                thread.start()
            for thread in self.threads:
                thread.join()
            for process, errors in zip(self.running, self.errors):
                if process.wait() not in (0, 1):
                    errors.seek(0)
                    said = errors.read().decode("utf-8", "replace").strip().splitlines()
                    raise CampaignError(f"feltgate_faults ended with {process.returncode}: {' '.join(said[-2:])}")
        finally:
            for process in self.running:
                if process.poll() is None:
                    process.kill()
                    process.wait()
                process.stdout.close()
            for errors in self.errors:
                errors.close()
        return self.lines
