# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Finds encoder recordings and decides how each is read.

Files that the project knows have fixed options and known numbers of steps; the program guesses how others are to be
read. Documentation: docs/traces.md, docs/figures.md
"""

import os
import re
from dataclasses import dataclass
from pathlib import Path

from reports import run_section
from reports.runs import ROOT, Job

SUFFIXES = {".sr", ".vcd", ".csv", ".tsv", ".txt", ".vec", ".fgv", ".vector", ".trace"}
TEXTS = {"readme", "license", "licence", "copying", "sha256sums"}
OWN = ROOT / "vectors" / "traces"
SECONDS = 5.0  # forecast of a length

# Of each encoder in a file: its options, and what a correct x4 decoder finds: steps, illegal, reversals. Counted by a
# plain program (model/sim/traces/capture.hpp), not by the decoder or its twin. The demo takes the first.
X, Y = ("X", ("--probes", "XA,XB")), ("Y", ("--probes", "YA,YB"))
TABLE = ("--time-column", "t", "--count-column", "theta", "--scale", "2048/2pi")
KNOWN = {
    "avago_adns_2051_move_mouse_fast.sr": ((*Y, (4154, 0, 72)), (*X, (560, 0, 73))),
    "avago_adns_2051_move_mouse_up_down.sr": ((*Y, (629, 0, 5)), (*X, None)),
    "avago_adns_2051_sleep_then_move.sr": ((*Y, (99, 0, 1)), (*X, None)),
    "avago_adns_2051_remove_and_readd_usb.sr": ((*Y, (3, 1, 0)), (*X, (3, 1, 0))),
    # Its README: 3 and 4 are Y's STEP and DIR, 5 and 6 X's.
    "smoothieware.sr": (("X", ("--step", "5", "--dir", "6"), (32000, 0, 1)),
                        ("Y", ("--step", "3", "--dir", "4"), (32000, 0, 1))),
    "qube_20230828T150615_434_696_394.csv": (("theta", TABLE, (6586, 0, 99)),),
}

SOURCES = """\
No recordings were found. Public ones, free to use:
  sigrokproject/sigrok-dumps: mouse_sensors/avago_adns_2051 (quadrature of a mouse moved by hand),
    stepper_motor/smoothieware (STEP/DIR of a motion controller); public domain
  decargroup/closed_loop_koopman: dataset/ (angle of a servo with a 2048-count encoder); MIT
Put them anywhere and give the folder: feltgate demo --traces DIR, or FELTGATE_TRACES."""


@dataclass(frozen=True)
class Recording:
    """One encoder in one file. `sure`: the options are known to be right, so failing is a fault."""

    path: Path
    channel: str = ""
    arguments: tuple = ()
    expected: tuple | None = None
    sure: bool = False

    @property
    def title(self):
        return f"{self.path.name} {self.channel}".strip()


def folder(named=None):
    """Where recordings are looked for: the named folder, FELTGATE_TRACES, ../shared/traces."""
    if named:
        return Path(named)
    return Path(os.environ.get("FELTGATE_TRACES") or ROOT.parent / "shared" / "traces")


def looks_like(path):
    """Whether a file could be a recording at all."""
    name = path.name.lower()
    return path.suffix.lower() in SUFFIXES and name.split(".")[0] not in TEXTS


def find(where, everything=True):
    """The recordings of a folder and all below it; not everything: of a known file one encoder."""
    found = []
    for path in sorted(Path(where).rglob("*")):
        if path.name in KNOWN:
            known = [Recording(path, *of, sure=True) for of in KNOWN[path.name]]
            found += known if everything else known[:1]
        elif path.is_file() and looks_like(path):
            found.append(Recording(path, sure=path.is_relative_to(OWN)))
    return found


def job(recording, number, design_name, scene):
    """The replay of a recording."""
    arguments = ("replay", str(recording.path), *recording.arguments)
    arguments += ("--design", design_name, "--scene", scene)
    name = re.sub(r"[^A-Za-z0-9]+", "-", f"{recording.path.stem}-{recording.channel}").strip("-")
    return Job(f"replay-{number:02d}-{name}", arguments, SECONDS, 250, recording)


def faults(run):
    """What is wrong with a replayed recording: numbers that differ from the known ones."""
    recording = run.job.recording
    if not run.ran:
        return [f"{recording.title}: {run.complaint}"] if recording.sure else []
    p = run.summary["position"]
    got = (p["steps"], p["illegal"], p["reversals"])
    if recording.expected and got != recording.expected:
        return [f"{recording.title}: steps, illegal, reversals are {got}, not {recording.expected}"]
    return []


def all_faults(found):
    """What went wrong in {name: Run}, one line each."""
    lines = []
    for run in found.values():
        if run.ran:
            lines += run_section.faults_of(run.summary)
        elif run.job.recording is None:
            lines.append(f"{run.job.name}: {run.complaint}")
        if run.job.recording is not None:
            lines += faults(run)
    return lines
