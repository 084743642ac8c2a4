# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The programs that count: each block test again, built by CMake (scripts/cmake/coverage.cmake) and run."""

import os
import subprocess
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from . import data

LIST = "coverage/programs.txt"


class ProgramError(Exception):
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
    path = build / LIST
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise ProgramError(f"{path}: {error.strerror}; configure with -DFELTGATE_TESTS=ON") from error
    return [Program(test, block, Path(where)) for test, block, where in (line.split(" ", 2) for line in lines)]


def make(build, programs, jobs):
    """Builds what is not there or stale."""
    command = ["cmake", "--build", str(build), f"-j{jobs}", "--target", *(f"{p.test}_cover" for p in programs)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ProgramError("\n".join(["building failed:", *done.stdout.splitlines()[-30:], done.stderr.strip()]))


def run_one(root, program, folder):
    file = folder / f"{program.test}.dat"
    log = folder / f"{program.test}.log"
    environment = os.environ | {"FELTGATE_COVERAGE": str(file), "FELTGATE_MISMATCH_DIR": str(folder)}
    with log.open("wb") as out:
        try:
            process = subprocess.Popen([program.path], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                       stdout=out, stderr=subprocess.STDOUT)
        except OSError as error:
            raise ProgramError(f"{program.path}: {error.strerror}; it is not built") from error
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        said = log.read_text(encoding="utf-8", errors="replace").splitlines()[-20:]
        raise ProgramError("\n".join([f"{program.test} ended with {process.returncode}:", *said]))
    if not file.exists():
        raise ProgramError(f"{program.test} wrote no coverage data")
    return Run(program, data.read(root, file), usage.ru_utime + usage.ru_stime)


def run(root, programs, folder, jobs, progress):
    """The runs of all, in the order of the programs."""
    with ThreadPoolExecutor(jobs) as pool:
        pending = {pool.submit(run_one, root, program, folder): program for program in programs}
        try:
            runs = {}
            for number, future in enumerate(as_completed(pending), 1):
                runs[pending[future].test] = future.result()
                progress(number, len(pending), pending[future].test)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return [runs[program.test] for program in programs]
