# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The programs with counters: each block test, built a second time by CMake
(scripts/cmake/coverage.cmake) and run."""

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

from command_line import Refused
import interrupts
from crew import Crew

from . import data

LIST = "coverage/programs.txt"


class ProgramError(Refused):
    """A program that cannot be built, fails, or leaves no data."""


@dataclass(frozen=True)
class Program:
    test: str
    block: str
    path: Path


@dataclass
class Run:
    program: Program
    counts: dict
    seconds: float


def read(build):
    """The programs that the build folder is configured with."""
    path = build / LIST
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise ProgramError(
            f"{path}: {error.strerror}; configure with -DFELTGATE_TESTS=ON"
        ) from error
    return [
        Program(test, block, Path(where))
        for test, block, where in (line.split(" ", 2) for line in lines)
    ]


def run_one(root, program, folder, crew):
    """One test, with what it counted; ProgramError where it fails or leaves nothing."""
    file = folder / f"{program.test}.dat"
    log = folder / f"{program.test}.log"
    environment = os.environ | {
        "FELTGATE_COVERAGE": str(file),
        "FELTGATE_MISMATCH_DIR": str(folder),
    }
    with log.open("wb") as out:
        try:
            status, seconds = crew.timed(
                [program.path],
                cwd=folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
            )
        except OSError as error:
            raise ProgramError(f"{program.path}: {error.strerror}; it is not built") from error
    if -status in interrupts.ENDING:
        raise interrupts.Interrupted(-status)
    if status:
        said = log.read_text(encoding="utf-8", errors="replace").splitlines()[-20:]
        raise ProgramError("\n".join([f"{program.test} {interrupts.how_it_ended(status)}:", *said]))
    if not file.exists():
        raise ProgramError(f"{program.test} wrote no coverage data")
    return Run(program, data.read(root, file), seconds)


def run(root, programs, folder, jobs):
    """The runs of all, in the order of the programs."""
    crew, runs = Crew(), {}

    def note(program, found, _):
        runs[program.test] = found
        return program.test

    crew.counted("coverage", lambda p: run_one(root, p, folder, crew), programs, jobs, note)
    return [runs[program.test] for program in programs]
