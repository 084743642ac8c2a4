# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs feltgate_faults in parts at the same time and reads its lines."""

import json
import subprocess
import tempfile
import threading
from pathlib import Path

from command_line import Refused
import interrupts
from crew import Crew


class CampaignError(Refused):
    """What went wrong, and what to do."""


def parse(text, where):
    """An object from a line of JSON."""
    try:
        found = json.loads(text)
    except json.JSONDecodeError as error:
        raise CampaignError(f"{where}: no line of JSON: {text.strip()[:60]!r}") from error
    if not isinstance(found, dict):
        raise CampaignError(f"{where}: no object: {text.strip()[:60]!r}")
    return found


def read(path):
    """Faults of an earlier run's lines; CampaignError where there are none."""
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise CampaignError(f"{path}: {error.strerror}") from error
    found = [parse(line, path) for line in lines if line.strip() and not line.startswith("#")]
    faults = [fault for fault in found if "class" in fault]
    if not faults:
        raise CampaignError(
            f"{path}: not one line of a fault, as feltgate faults --save writes them"
        )
    return faults


def listen(crew, command, told):
    """All lines of one program, told(line) of each as it comes; raises where the program failed
    other than by what it found."""
    lines = []
    with tempfile.TemporaryFile() as errors:
        process = crew.start(
            command, stdout=subprocess.PIPE, stderr=errors, text=True, stdin=subprocess.DEVNULL
        )
        try:
            for line in process.stdout:
                lines.append(parse(line, "feltgate_faults"))
                told(lines[-1])
        except BaseException:
            crew.kill(process)
            raise
        finally:
            process.stdout.close()
            status, _ = crew.wait(process)
        if -status in interrupts.ENDING:
            raise interrupts.Interrupted(-status)
        if status not in (0, 1):
            errors.seek(0)
            said = errors.read().decode("utf-8", "replace").strip().splitlines()
            raise CampaignError(
                f"feltgate_faults {interrupts.how_it_ended(status)}: {' '.join(said[-2:])}"
            )
    return lines


def run(program, arguments, jobs, told):
    """All lines of the program in `jobs` parts at the same time; told(part, line) of each as it
    comes."""
    crew, lines, lock = Crew(), [], threading.Lock()

    def part(number):
        def one(line):
            with lock:
                told(number, line)

        command = [program, *map(str, arguments), "--parts", str(jobs), "--part", str(number)]
        return listen(crew, command, one)

    crew.each(part, range(jobs), jobs, lambda _, found: lines.extend(found))
    return lines
