# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Finds encoder recordings and decides how each is read.

Files that the project knows have fixed options and known numbers of steps; others are tried with
guesses from their own channel names. Documentation: docs/traces.md, docs/figures.md
"""

import configparser
import os
import re
import zipfile
from dataclasses import dataclass
from pathlib import Path

from reports import run_section
from reports.runs import ROOT, Job

SUFFIXES = {".sr", ".vcd", ".csv", ".tsv", ".txt", ".vec", ".fgv", ".vector", ".trace"}
TEXTS = {"readme", "license", "licence", "copying", "sha256sums"}
OWN = ROOT / "vectors" / "traces"
UNKNOWN_SECONDS = 5.0  # forecast for a length that the file does not tell

# What a correct x4 decoder finds: steps, illegal, reversals. Counted by a plain program
# (model/sim/traces/statistics.hpp), not by the decoder or its twin.
MOUSE = "avago_adns_2051_"
KNOWN = {
    (f"{MOUSE}move_mouse_fast.sr", "Y"): (4154, 0, 72),
    (f"{MOUSE}move_mouse_fast.sr", "X"): (560, 0, 73),
    (f"{MOUSE}move_mouse_up_down.sr", "Y"): (629, 0, 5),
    (f"{MOUSE}sleep_then_move.sr", "Y"): (99, 0, 1),
    (f"{MOUSE}remove_and_readd_usb.sr", "X"): (3, 1, 0),
    (f"{MOUSE}remove_and_readd_usb.sr", "Y"): (3, 1, 0),
    ("smoothieware.sr", "X"): (32000, 0, 1),
    ("smoothieware.sr", "Y"): (32000, 0, 1),
    ("qube_20230828T150615_434_696_394.csv", "theta"): (6586, 0, 99),
}

# Where a known file has two encoders, the demo takes this one.
ONE_OF = {"smoothieware.sr": "X", **{name: "Y" for name, _ in KNOWN if name.startswith(MOUSE)}}

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
    channel: str
    arguments: tuple
    seconds: float
    sure: bool = True

    @property
    def title(self):
        return f"{self.path.name} {self.channel}".strip()

    @property
    def expected(self):
        return KNOWN.get((self.path.name, self.channel))


def folder(named=None):
    """Where recordings are looked for: the named folder, FELTGATE_TRACES, ../shared/traces."""
    if named:
        return Path(named)
    return Path(os.environ.get("FELTGATE_TRACES") or ROOT.parent / "shared" / "traces")


def sigrok_metadata(path):
    """(probe names, seconds) of a .sr; raises ValueError or BadZipFile for what is not one."""
    with zipfile.ZipFile(path) as archive:
        try:
            text = archive.read("metadata").decode()
        except KeyError:
            raise ValueError("no metadata in it") from None
        size = sum(i.file_size for i in archive.infolist() if i.filename.startswith("logic-1"))
    parser = configparser.ConfigParser(strict=False, interpolation=None)
    try:
        parser.read_string(text)
        device = parser["device 1"]
        value, unit = re.match(r"([\d.]+)\s*([kMG]?)Hz", device["samplerate"], re.I).groups()
        rate = float(value) * {"": 1, "k": 1e3, "M": 1e6, "G": 1e9}[unit]
        seconds = size / int(device.get("unitsize", "1")) / rate
    except (configparser.Error, KeyError, AttributeError, ValueError) as error:
        raise ValueError(f"metadata not understood: {error}") from None
    probes = [v for k, v in device.items() if re.fullmatch(r"probe\d+", k)]
    return probes, seconds


def pairs(names):
    """[(channel, A, B)] of names that differ by a last letter A and B, such as XA, XB."""
    upper = {name.upper(): name for name in names}
    return [
        (stem.rstrip("_-") or "", upper[stem + "A"], upper[stem + "B"])
        for stem in sorted({u[:-1] for u in upper if u.endswith("A")})
        if stem + "B" in upper
    ]


def from_sigrok(path):
    probes, seconds = sigrok_metadata(path)
    found = [(c, ("--probes", f"{a},{b}")) for c, a, b in pairs(probes)]
    sure = path.name.startswith(MOUSE) or path.name == "smoothieware.sr"
    if path.name == "smoothieware.sr":  # its README: 3 and 4 are Y's STEP and DIR, 5 and 6 X's
        found = [("X", ("--step", "5", "--dir", "6")), ("Y", ("--step", "3", "--dir", "4"))]
    elif not found:
        lower = {p.lower(): p for p in probes}
        if "step" in lower and "dir" in lower:
            found = [("", ("--step", lower["step"], "--dir", lower["dir"]))]
    return [Recording(path, c, o, seconds, sure) for c, o in found or [("", ())]]


def last_number(path, column):
    """Last value of a column of a table; None where there is none."""
    with open(path, "rb") as file:
        file.seek(max(0, path.stat().st_size - 4096))
        lines = file.read().decode(errors="replace").strip().splitlines()
    try:
        return float(re.split(r"[,;\t]", lines[-1])[column])
    except (IndexError, ValueError):
        return None


def from_table(path):
    """A table: columns of position where their names tell, else as the program guesses."""
    with open(path, encoding="utf-8", errors="replace") as file:
        head = next((line for line in file if line.strip() and line[0] not in "#;"), "")
    names = [name.strip().strip('"') for name in re.split(r"[,;\t]", head)]
    times = [i for i, n in enumerate(names) if re.fullmatch(r"(t|time|timestamp)\b.*", n, re.I)]
    seconds = (last_number(path, times[0]) if times else None) or UNKNOWN_SECONDS
    angle = next((n for n in names if re.fullmatch(r"theta|angle|position_rad", n, re.I)), None)
    count = next((n for n in names if re.fullmatch(r"counts?|position", n, re.I)), None)
    if not times or not (angle or count):
        return [Recording(path, "", (), min(seconds, 1e4), False)]
    options = ("--time-column", names[times[0]], "--count-column", angle or count)
    if angle:  # 2048 counts a turn: what the QUBE-Servo has; a guess for any other file
        options += ("--scale", "2048/2pi")
    sure = path.name.startswith("qube_")
    return [Recording(path, angle or count, options, min(seconds, 1e4), sure)]


def from_vector(path):
    """Our own format: its first line has the clock, its last one the length."""
    with open(path, encoding="utf-8", errors="replace") as file:
        clock = re.search(r"clock_hz=(\d+)", file.readline())
    with open(path, "rb") as file:
        file.seek(max(0, path.stat().st_size - 64))
        end = re.search(rb"end (\d+)\s*$", file.read())
    known = clock and end
    seconds = int(end[1]) / int(clock[1]) if known else UNKNOWN_SECONDS
    return [Recording(path, "", (), seconds, path.is_relative_to(OWN))]


def looks_like(path):
    """Whether a file could be a recording at all."""
    name = path.name.lower()
    return path.suffix.lower() in SUFFIXES and name.split(".")[0] not in TEXTS


def read(path):
    with open(path, "rb") as file:
        start = file.read(16)
    if start.startswith(b"feltgate-vector"):
        return from_vector(path)
    if path.suffix.lower() == ".sr":
        return from_sigrok(path)
    if path.suffix.lower() in (".csv", ".tsv", ".txt"):
        return from_table(path)
    return [Recording(path, "", (), UNKNOWN_SECONDS, False)]


def find(where):
    """(recordings, complaints) of a folder and all below it."""
    found, complaints = [], []
    for path in sorted(Path(where).rglob("*")):
        if not path.is_file() or not looks_like(path):
            continue
        try:
            found += read(path)
        except (OSError, ValueError, zipfile.BadZipFile) as error:
            complaints.append(f"{path.name}: {error}")
    return found, complaints


def one_of_each(found):
    """Without the second encoder of a known file."""
    return [r for r in found if ONE_OF.get(r.path.name, r.channel) == r.channel]


def job(recording, number, design_name, scene):
    """The replay of a recording; a picture has some 20 000 rows whatever its length."""
    every = max(20, round(recording.seconds * 1e6 / 20000 / 10) * 10)
    arguments = ("replay", str(recording.path), *recording.arguments)
    arguments += ("--design", design_name, "--scene", scene)
    name = re.sub(r"[^A-Za-z0-9]+", "-", f"{recording.path.stem}-{recording.channel}").strip("-")
    return Job(f"replay-{number:02d}-{name}", arguments, recording.seconds, every, recording)


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
