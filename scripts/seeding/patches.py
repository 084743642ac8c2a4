# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Applies patches to copies, and checks the rules for a patch."""

import re
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NONE = "none"


class DefectError(Exception):
    """The message names the patch and what to change."""


def code_only(text):
    """Source without comments and white space, which no defect is made of."""
    return re.sub(r"//[^\n]*|/\*.*?\*/|\s+", " ", text, flags=re.S).split()


def summary(patch):
    """The first line of a patch: what it breaks."""
    line = patch.read_text(encoding="utf-8").partition("\n")[0].strip()
    if not line or re.match(r"(---|\+\+\+|@@|diff|index|Index)", line):
        raise DefectError(f"{patch}: its first line does not say what it breaks; write it there")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", patch.stem) or patch.stem == NONE:
        raise DefectError(f"{patch}: its name is no word like missing_carry; rename it")
    return line


def touched(patch):
    """Paths of the files that a patch changes, relative to the repository."""
    text = patch.read_text(encoding="utf-8")
    paths = [Path(path) for path in re.findall(r"^\+\+\+ b/(\S+)", text, re.M)]
    if not paths:
        raise DefectError(f"{patch}: changes no file; make it with git diff")
    return paths


def patched(patch, root=ROOT):
    """{path: text} of the files that a patch changes, as they are with it."""
    summary(patch)
    before, after = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for path in touched(patch):
            if not (root / path).is_file():
                raise DefectError(f"{patch}: changes {path}, which is not there")
            before[path] = (root / path).read_text(encoding="utf-8")
            Path(folder, path).parent.mkdir(parents=True, exist_ok=True)
            Path(folder, path).write_text(before[path], encoding="utf-8")
        command = ["patch", "-p1", "--fuzz=0", "--batch", "--forward", "--reject-file=-"]
        command += ["--no-backup-if-mismatch", "-d", folder, "-i", patch.resolve()]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise DefectError(f"{patch}: does not apply; make it again\n{done.stdout}{done.stderr}")
        for path in before:
            after[path] = Path(folder, path).read_text(encoding="utf-8")
            if code_only(after[path]) == code_only(before[path]):
                raise DefectError(f"{patch}: changes no code of {path}")
    return after


def write_copies(patch, output, root=ROOT):
    """Writes the patched files below `output`; returns their paths there."""
    paths = []
    for path, text in patched(patch, root).items():
        (output / path).parent.mkdir(parents=True, exist_ok=True)
        (output / path).write_text(text, encoding="utf-8")
        paths.append(output / path)
    return paths
