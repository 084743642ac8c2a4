# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A copy of the repository in which the command lines of the pages run: its scenes last a few
milliseconds, and the files that the pages call "yours" are there. Nothing outside it is written."""

import math
import os
import re
import shutil
import sys
import zipfile

import pages

SCENE_S = 0.03  # long enough to arm and to move
SKIPPED = shutil.ignore_patterns(".git", "build", "build-*", "__pycache__", "*.part")


def shortened(scene):
    """A scene that ends early, without the events and expectations that lie beyond."""
    lines, kept, skip = scene.splitlines(), [], False
    for line in lines:
        if line.startswith("["):
            skip = line.startswith(("[[event]]", "[[expect]]"))
        if not skip:
            kept.append(re.sub(r"^duration_s *=.*", f"duration_s = {SCENE_S}", line))
    text = "\n".join(kept) + "\n"
    return re.sub(r"^arm_s *=.*$", "arm_s = 0.002", text, flags=re.M)


def quadrature(count):
    """(A, B) at a count; upwards 00, 01, 11, 10."""
    return ((count >> 1) & 1, ((count >> 1) ^ count) & 1)


def write_sigrok(path, probes, samples, rate_hz=100_000):
    """A .sr of up to 8 probes; `samples` are tuples of their levels."""
    names = "\n".join(f"probe{n}={name}" for n, name in enumerate(probes, 1))
    metadata = (
        "[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\n"
        f"total probes={len(probes)}\nsamplerate={rate_hz}\nunitsize=1\n{names}\n"
    )
    data = bytes(sum(level << n for n, level in enumerate(sample)) for sample in samples)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("version", "2")
        archive.writestr("metadata", metadata)
        archive.writestr("logic-1-1", data)


def write_recordings(folder):
    """hand.sr: a quadrature of 40 counts forth and back; axis.sr: STEP and DIR; log.csv: angles;
    moved.csv and moved.vec: as a host records them."""
    counts = [round(40 * math.sin(k / 300)) for k in range(2000)]
    write_sigrok(folder / "hand.sr", ("XA", "XB", "other"), [(*quadrature(c), 0) for c in counts])
    steps = [(0, 0, 0, 0, k // 20 % 2, k < 1000) for k in range(2000)]
    write_sigrok(folder / "axis.sr", ("1", "2", "3", "4", "5", "6"), steps)
    rows = "".join(f"{k / 1000},{0.05 * math.sin(k / 10):.6f}\n" for k in range(30))
    (folder / "log.csv").write_text("t,theta\n" + rows, encoding="utf-8")
    rows = "".join(f"{k / 1000},{k // 3}\n" for k in range(20))
    (folder / "moved.csv").write_text("time_s,position\n" + rows, encoding="utf-8")
    head = "feltgate-vector 1 design=lever clock_hz=50000000 signals=A,B,Z\n0 0 0 0\n"
    rows = "900 0 1 0\n1800 1 1 0\n2700 1 0 0\nend 50000\n"
    (folder / "moved.vec").write_text(head + rows, encoding="utf-8")


def make(folder):
    """Fills `folder` and returns it; its tmp, shared and data stand for /tmp, /shared and /data."""
    shutil.copytree(pages.ROOT, folder, ignore=SKIPPED, symlinks=True, dirs_exist_ok=True)
    for path in (folder / "vectors/scenes").glob("*.toml"):
        path.write_text(shortened(path.read_text(encoding="utf-8")), encoding="utf-8")
    for place in ("path/to", "tmp", "shared", "data"):
        (folder / place).mkdir(parents=True, exist_ok=True)
    for source, copies in {
        "vectors/scenes/membrane.toml": ("path/to/my.toml", "fast.toml", "my_scene.toml"),
        "vectors/spaces/smoke.toml": ("my_space.toml",),
        "rtl/laws/detent.law": ("my.law",),
        "vectors/plants/p24.toml": ("my.toml", "vectors/plants/mine.toml"),
        "rtl/designs/lever.toml": ("my_design.toml", "my_point.toml", "rtl/designs/mine.toml"),
    }.items():
        for copy in copies:
            shutil.copy(folder / source, folder / copy)
    write_recordings(folder)
    return folder


def environment(folder, build):
    """Of every program started there. Its build folder is a new one, so that no report, sweep or
    waveform lands in the real one."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith("FELTGATE_")}
    return kept | {
        "FELTGATE_ROOT": str(folder),
        "FELTGATE_BUILD": str(folder / "build-of-docs"),
        "FELTGATE_PROGRAM": str(build / "feltgate"),
        "FELTGATE_PYTHON": sys.executable,
        "PYTHONDONTWRITEBYTECODE": "1",
    }
