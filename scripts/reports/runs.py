# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Starts the feltgate program, several jobs at once, and reads back its JSON and CSV.

Documentation: docs/json.md, docs/figures.md
"""

import json
import os
import subprocess
import tomllib
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import islice
from pathlib import Path

import interrupts
import numpy as np
from crew import Crew
from reports.progress import Steps

ROOT = Path(os.environ.get("FELTGATE_ROOT", Path(__file__).resolve().parents[2]))
SCENES = ROOT / "vectors" / "scenes"
ENGINE_DESIGN = "lever_law"  # has an engine for laws, and a program of its own


@lru_cache
def with_own_programs():
    """Designs whose RTL is in a program of its own."""
    return {path.stem for path in (ROOT / "rtl/designs").glob("*.toml")} - {"lever", "paper"}


def build_folder():
    return Path(os.environ.get("FELTGATE_BUILD", ROOT / "build"))


def program_path(design=""):
    """Where the program of a design lies once it is built; of none, the program with every
    command."""
    path = Path(os.environ.get("FELTGATE_PROGRAM") or build_folder() / "feltgate")
    if path.name == "feltgate" and design in with_own_programs():
        return path.with_name(f"feltgate_{design}")
    if path.name == "feltgate" and design == "lever":
        small = path.with_name("feltgate_run")
        return small if os.access(small, os.X_OK) else path
    return path


def program(design=""):
    """Path of the built program; a mistake here is the caller's to report."""
    path = program_path(design)
    if not os.access(path, os.X_OK):
        raise FileNotFoundError(f"{path}: not built; start it through ./feltgate, which builds it")
    return path


@lru_cache
def read_toml(path):
    return tomllib.loads(Path(path).read_text(encoding="utf-8"))


def design(name):
    """The design point's file, as a dictionary."""
    return read_toml(ROOT / "rtl" / "designs" / f"{name}.toml")


def scene_file(name):
    return read_toml(SCENES / f"{name}.toml")


def design_of(scene):
    """The design that a scene runs on: the one that it names, its device's, or one with an engine where
    it has a law."""
    file = scene_file(scene)
    if "device" in file:
        return f"{file['device']}_law"
    if "design" in file:
        return file["design"]
    return ENGINE_DESIGN if "law" in file["core"] else "lever"


def rows_of(path):
    """How many rows a table has below its header, fast enough for hundreds of megabytes."""
    with open(path, "rb") as file:
        return sum(part.count(b"\n") for part in iter(lambda: file.read(1 << 20), b"")) - 1


def read_table(path):
    """{column: array} of a CSV whose first line names its columns."""
    with open(path, encoding="utf-8") as file:
        names = file.readline().strip().split(",")
        return dict(zip(names, np.loadtxt(file, delimiter=",", ndmin=2).T, strict=True))


def read_csv(path, most_rows=None):
    """The same of a run; of a longer one than most_rows only every so many rows.

    Raises ValueError, one line, for a file that is not one.
    """
    with open(path, encoding="utf-8") as file:
        names = file.readline().strip().split(",")
        if "time_s" not in names:
            raise ValueError(f"{path}:1: no column time_s; give a CSV written by feltgate --csv")
        start, stride = file.tell(), 1
        if most_rows:
            stride = max(1, -(-rows_of(path) // most_rows))
        if not file.readline():
            raise ValueError(f"{path}:2: no rows; run it again")
        file.seek(start)
        try:
            rows = np.loadtxt(islice(file, 0, None, stride), delimiter=",", ndmin=2)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None
    if rows.shape[1] != len(names):
        raise ValueError(f"{path}: rows are not {len(names)} columns wide; run it again")
    return dict(zip(names, rows.T, strict=True))


@dataclass(frozen=True)
class Job:
    """One start of the program. `seconds` is the device time, for order and forecast."""

    name: str
    arguments: tuple
    seconds: float
    every: int = 100
    recording: object = None  # reports.recordings.Recording of a replay

    @property
    def design(self):
        """The design that its arguments name."""
        return dict(zip(self.arguments, self.arguments[1:])).get("--design", "")


@dataclass
class Run:
    """What came of a job. `csv` is read when first asked for."""

    job: Job
    status: int
    complaint: str = ""
    summary: dict = field(default_factory=dict)
    csv_path: Path = None

    @cached_property
    def csv(self):
        return read_csv(self.csv_path)

    @property
    def ran(self):
        return bool(self.summary)

    @property
    def design(self):
        return self.summary.get("design", "lever")

    @property
    def of_axes(self):
        """Whether it is of a device of several axes: another schema, docs/json.md."""
        return self.summary.get("schema", "").startswith("feltgate-axes-run/")

    @property
    def compared_clocks(self):
        """In which RTL and twin were compared: none where only one of them ran."""
        return self.summary.get("clocks", 0) if "mismatches" in self.summary else 0

    @property
    def mismatches(self):
        return self.summary.get("mismatches", 0)

    def __getstate__(self):
        """Without the table: another process reads the file itself."""
        return {k: v for k, v in self.__dict__.items() if k != "csv"}


def scene_job(scene, design_name="lever", plant=None, sets=(), variant="", every=100):
    """A closed-loop job with RTL, twin and both references. `sets` is ((name, value), ...)."""
    arguments = ["run", scene, "--design", design_name]
    if plant:
        arguments += ["--plant", plant]
    for name, value in sets:
        arguments += ["--set", f"{name}={value}"]
    name = "-".join(part for part in (scene, design_name, plant, variant) if part)
    return Job(name, tuple(arguments), float(scene_file(scene)["duration_s"]), every)


def start(job, folder, crew):
    """Runs one job to its end; never raises for what the program does."""
    json_path, csv_path = folder / f"{job.name}.json", folder / f"{job.name}.csv"
    for path in (json_path, csv_path):
        path.unlink(missing_ok=True)
    engines = () if "--engine" in job.arguments else ("--engine", "all")
    command = [str(program(job.design)), *job.arguments, *engines, "--quiet"]
    command += ["--json", str(json_path), "--csv", str(csv_path), "--every", str(job.every)]
    quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL}
    try:
        done = crew.run(command, stderr=subprocess.PIPE, **quiet)
    except interrupts.Interrupted:
        return Run(job, -1, "interrupted")
    stderr = done.stderr.decode(errors="replace").strip()
    complaint = stderr.splitlines()[-1].removeprefix("feltgate: ") if stderr else ""
    if interrupts.ending_signal(done.returncode):
        complaint = interrupts.how_it_ended(done.returncode)
    run = Run(job, done.returncode, complaint)
    run.csv_path = csv_path
    if done.returncode in (0, 1) and json_path.exists() and csv_path.exists():
        try:
            run.summary = json.loads(json_path.read_text(encoding="utf-8"))
        except ValueError as error:
            run.complaint = f"{json_path}: {error}"
    elif not run.complaint:
        run.complaint = f"feltgate {interrupts.how_it_ended(done.returncode)} and wrote no result"
    return run


def describe(run):
    """A few words on how a run went."""
    if not run.ran:
        return f"did not run: {run.complaint}"
    broken = len(run.summary.get("expectations", {}).get("broken", []))
    return f"{run.mismatches} mismatches{f', {broken} broken expectations' if broken else ''}"


def run_all(command, jobs, folder, workers=None):
    """{name: Run} of all jobs, the longest first, on every core, with a line of progress of the command.

    An interrupt ends the programs that were started here, and no others.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for design in {"", *(job.design for job in jobs)}:
        program(design)  # complain once, not once per job
    crew, found = Crew(), {}
    with Steps(command, sum(job.seconds for job in jobs)) as progress:

        def done(job, run):
            found[job.name] = run
            progress.step(f"{job.name}: {describe(run)}", progress.done + job.seconds)

        order = sorted(jobs, key=lambda job: -job.seconds)
        crew.each(lambda job: start(job, folder, crew), order, workers or os.cpu_count(), done)
    return {job.name: found[job.name] for job in jobs}
