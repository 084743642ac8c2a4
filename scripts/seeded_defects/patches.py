# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Applies patches to copies, and checks the rules for a patch.

A patch is a section of a file of seeded defects, named as if that were a folder: FILE/NAME. One with the
line '== NAME (proof)' is for a proof of the block alone, no test is built with it.
"""

import re
import subprocess
import tempfile
from pathlib import Path

from command_line import Refused

ROOT = Path(__file__).resolve().parents[2]
NONE = "none"
PROOF = " (proof)"
DIFF_BEGINS = r"(--- |\+\+\+ |@@ |diff |index )"


class DefectError(Refused):
    """The message names the patch and what to change."""


def code_only(text):
    """Source without comments and white space, which no defect is made of."""
    return re.sub(r"//[^\n]*|/\*.*?\*/|\s+", " ", text, flags=re.S).split()


def names(file):
    """The defects of a file for tests and those for proofs, in its order; none where there is no such file."""
    heads = re.findall(r"^== (.*)", file.read_text(encoding="utf-8"), re.M) if file.is_file() else []
    tests = [head for head in heads if not head.endswith(PROOF)]
    return tests, [head.removesuffix(PROOF) for head in heads if head.endswith(PROOF)]


def chosen(file, some=()):
    """Patches of these names of a file; without names: all that are for tests."""
    return [Path(file, name) for name in some or names(Path(file))[0]]


def every(file):
    """Patches of a file, those for proofs too."""
    return [Path(file, name) for name in read(file)]


def read(file):
    """{name: text} of a file of defects, each after a line '== name' or '== name (proof)'."""
    head, *parts = re.split(r"^== (.*)\n", file.read_text(encoding="utf-8"), flags=re.M)
    for line in head.splitlines():
        if line and not line.startswith("#"):
            raise DefectError(f"{file}: '{line}' is before the first line '== name'; move it")
    found = {}
    for name, text in zip(parts[::2], parts[1::2]):
        name = name.removesuffix(PROOF)
        if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or name == NONE:
            raise DefectError(f"{file}: '== {name}': its name is no word like carry_lost; rename it")
        if name in found:
            raise DefectError(f"{file}: two defects {name}; rename one")
        found[name] = text.strip("\n") + "\n"
    return found


def text_of(patch):
    """What it breaks, and the diff; refused where a line is neither."""
    found = read(patch.parent)
    if patch.name not in found:
        raise DefectError(f"{patch.parent}: no defect {patch.name}; there are {', '.join(found)}")
    text = found[patch.name]
    if not text.strip() or re.match(DIFF_BEGINS, text):
        raise DefectError(f"{patch}: its first line does not say what it breaks; write it there")
    begin = re.search(rf"^{DIFF_BEGINS}", text, re.M)
    for line in text[begin.start() :].split("\n") if begin else ():
        if not re.match(rf"{DIFF_BEGINS}|[ +\-\\]|$", line):
            raise DefectError(f"{patch}: '{line}' is no line of a diff; remove or correct it")
    return text


def touched(patch):
    """Paths of the files that a patch changes, relative to the repository."""
    paths = [Path(path) for path in re.findall(r"^\+\+\+ b/(\S+)", text_of(patch), re.M)]
    if not paths:
        raise DefectError(f"{patch}: changes no file; make it with git diff")
    if len(set(paths)) < len(paths):
        raise DefectError(f"{patch}: two diffs of a file; write '== name' between two defects")
    return paths


def patched(patch, root=ROOT):
    """{path: text} of the files that a patch changes, as they are with it."""
    before, after = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for path in touched(patch):
            if not (root / path).is_file():
                raise DefectError(f"{patch}: changes {path}, which is not there")
            before[path] = (root / path).read_text(encoding="utf-8")
            Path(folder, path).parent.mkdir(parents=True, exist_ok=True)
            Path(folder, path).write_text(before[path], encoding="utf-8")
        command = ["patch", "-p1", "--fuzz=0", "--batch", "--forward", "--reject-file=-"]
        command += ["--no-backup-if-mismatch", "-d", folder]
        done = subprocess.run(
            command, input=text_of(patch), capture_output=True, encoding="utf-8", check=False
        )
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
