#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs every command line of the pages; command_rules.py says how. A line without a rule fails, and
so does one that the program refuses. FELTGATE_BUILD has the programs.

  commands_test.py [TEXT] [--configured DIR]   only the lines that contain TEXT; DIR is the folder
                                               that cmake and ctest are asked about
"""

import argparse
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "scripts"))
import command_lines  # noqa: E402
import command_rules
import sandbox

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("text", nargs="?", default="", help="only the lines that contain it")
parser.add_argument("--configured", type=Path, help="configured build folder")
ARGUMENTS = parser.parse_args()
BUILD = Path(os.environ["FELTGATE_BUILD"]).resolve()
CONFIGURED = (ARGUMENTS.configured or BUILD).resolve()
HERE = Path(__file__).resolve().parent
# The launcher's options are read by its own function; what it would then do is left out.
LAUNCHER = """set -euo pipefail
ROOT=$PWD BUILD=$1; shift
say() { echo "$*" >&2; }; die() { say "$*"; exit 2; }
need_packages() { exit 0; }
source scripts/run_tests.sh
run_tests "build test" "$@"
"""


def program_of(words, folder):
    """argv for the words of a line that begins with feltgate."""
    command, rest = words[1], words[2:]
    if command == "generate":
        return [BUILD / "feltgate_generate", folder, *rest]
    if command in ("bench", "extremes"):
        return [BUILD / f"feltgate_{command}", *rest]
    if command in ("help", "--help", "--version"):
        return ["bash", folder / "feltgate", command]
    return [BUILD / "feltgate", command, *rest]


def argv_of(line, rule, folder):
    text = line.words.replace(" ...", "")
    text = re.sub(r"(^| )/(tmp|shared|data)/", rf"\1{folder}/\2/", text)
    text = re.sub(r" > \S+$", "", text)
    words = command_rules.filled([w for w in shlex.split(text) if w != "--yes"])
    words = [w for w in words if not re.match(r"[A-Z_]+=", w)]
    if rule.how == "PARSED":
        if not words[0].endswith(".py"):
            words[:2] = [f"scripts/{words[1]}.py"]
        return [sys.executable, HERE / "parse_only.py", *words]
    if rule.how == "LAUNCHER":
        return ["bash", "-c", LAUNCHER, "test", BUILD, *words[2:]]
    words += shlex.split(rule.more)
    if words[0] == "ctest":
        return [str(CONFIGURED) if word == "build" else word for word in words]
    if words[0].endswith(".py"):
        return [sys.executable, *words]
    if words[0] in ("c++", "./a.out"):
        return words
    return program_of(words, folder)


def wrong_names(words, folder):
    """Of a line that is not run: what of the things that it names is not there."""
    cache = (CONFIGURED / "CMakeCache.txt").read_text(encoding="utf-8")
    for word in words[1:]:
        option = re.match(r"-D(\w+)=", word)
        if option and f"\n{option[1]}:" not in cache:
            return f"CMake knows no option {option[1]}"
        if re.match(r"(?:rtl|model|testbench|scripts|vectors|docs)/", word):
            if not (folder / word).exists():
                return f"{word} is not there"
        if word.endswith(".tcl") and not list(folder.glob(f"rtl/boards/*/{word}")):
            return f"no board has a {word}"
        if word.startswith("scripts/") and word.endswith(".sh"):
            subprocess.run(["bash", "-n", folder / word], check=True)
    return None


def wrong_with(line, names, folder):
    """What is wrong, or None; and the CPU seconds."""
    if line.names_only:
        name = line.words.split()[1]
        return None if name in names else f"there is no subcommand {name}", 0
    rule = command_rules.rule_of(re.sub(r"^(?:[A-Z_]+=\S+ )+", "", line.words))
    if rule is None:
        return "testbench/repository/docs/command_rules.py has no rule for it; add one", 0
    if rule.how == "NAMED":
        return wrong_names(shlex.split(line.words), folder), 0
    if rule.how == "ELSEWHERE":
        return None, 0
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [str(word) for word in argv_of(line, rule, folder)],
        cwd=folder,
        env=sandbox.environment(folder, BUILD),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        timeout=300,
        check=False,
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode in rule.status:
        return None, spent
    end = "\n    ".join(done.stdout.strip().splitlines()[-8:])
    wanted = " or ".join(map(str, rule.status))
    return f"ended with {done.returncode}, not {wanted}:\n    {end}", spent


def subcommands():
    text = subprocess.run(
        ["bash", sandbox.pages.ROOT / "feltgate", "--help"],
        capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    return set(re.findall(r"^  (?:\./feltgate )?([a-z]+) +\S", text, re.M))


def main():
    names, failed, seen, total = subcommands(), 0, set(), 0.0
    with tempfile.TemporaryDirectory() as scratch:
        folder = sandbox.make(Path(scratch).resolve() / "feltgate")
        for line in command_lines.all_lines():
            # ./feltgate is the launcher and its program alike: once is enough.
            once = (line.names_only, line.words.removeprefix("./"))
            if ARGUMENTS.text not in line.words or once in seen:
                continue
            seen.add(once)
            began = time.monotonic()
            # A folder takes the report of one run.
            shutil.rmtree(folder / "out", ignore_errors=True)
            wrong, spent = wrong_with(line, names, folder)
            total += spent
            if wrong:
                failed += 1
                print(f"{line.where}: `{line.words}`: {wrong}", flush=True)
            else:
                took = time.monotonic() - began
                print(f"ok {spent:6.2f} s CPU {took:6.2f} s  {line.words}", flush=True)
    print(f"{len(seen)} command lines, {failed} wrong, {total:.1f} s of CPU time")
    return 1 if failed or not seen else 0


if __name__ == "__main__":
    sys.exit(main())
