#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The tests of a configured build folder: their names, what must be built for them, their minutes.

A test needs the built files that its command names, and those of its property REQUIRED_FILES. A
script that names neither would have everything built; `check` refuses it. docs/testing.md
"""

import argparse
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

# A test counts in the first of these groups that is among its labels.
GROUPS = ("long", "mutation", "trace", "synth", "system", "lockstep", "unit")
EVERYTHING = "all"


@dataclass(frozen=True)
class Test:
    """One CTest; paths are absolute."""

    name: str
    labels: tuple
    folder: Path
    required: tuple
    command: tuple

    @property
    def group(self):
        return next((g for g in GROUPS if g in self.labels), "other")


def listed(build, name="", configuration=""):
    """What CTest would run."""
    command = ["ctest", "--test-dir", str(build), "--show-only=json-v1"]
    command += ["-R", name] if name else []
    command += ["-C", configuration] if configuration else []
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ValueError(done.stderr.strip())
    if not done.stdout.startswith("{"):  # CTest's own words about it come first
        why = done.stdout.splitlines()[0]
        raise ValueError(f"'{name}' is no regular expression for CTest: {why}")
    return json.loads(done.stdout)["tests"]


def commands(folder):
    """{test: command}; CTest itself is silent about a program that is not built yet."""
    text = (folder / "CTestTestfile.cmake").read_text(encoding="utf-8")
    found = {}
    for name, words in re.findall(r"^ *add_test\(\[=*\[(.*?)\]=*\] (.*)\)$", text, re.M):
        quoted = re.findall(r'"((?:[^"\\]|\\.)*)"', words)
        found[name] = tuple(re.sub(r"\\(.)", r"\1", word) for word in quoted)
    for inner in re.findall(r'^subdirs\("?(.*?)"?\)$', text, re.M):
        found |= commands(folder / inner)
    return found


def tests(build, name="", configuration=""):
    known = commands(build)
    for entry in listed(build, name, configuration):
        properties = {p["name"]: p["value"] for p in entry.get("properties", ())}
        yield Test(
            name=entry["name"],
            labels=tuple(properties.get("LABELS", ())),
            folder=Path(properties.get("WORKING_DIRECTORY", build)),
            required=tuple(properties.get("REQUIRED_FILES", ())),
            command=known.get(entry["name"], ()),
        )


def outputs(build):
    """Every file that the build can make, relative to its folder."""
    command = ["ninja", "-C", str(build), "-t", "targets", "all"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return {line.rpartition(": ")[0] for line in done.stdout.splitlines()}


def made(build, test, words, makes):
    """Those of the words that the build makes; a relative path is one of the test's folder."""
    found = set()
    for word in words:
        for part in re.split(r"[\s;=]", word):
            path = test.folder / part
            if part and path.is_relative_to(build) and str(path.relative_to(build)) in makes:
                found.add(str(path.relative_to(build)))
    return found


def needs(build, test, makes):
    """What must be built for the test; None when that is not known."""
    named = made(build, test, test.command, makes)
    if test.required:
        return named | made(build, test, test.required, makes)
    if named:
        return named
    return {EVERYTHING} if str(build) in test.command else None


def print_targets(build, chosen):
    makes, targets = outputs(build), set()
    for test in chosen:
        known = needs(build, test, makes)
        targets |= {EVERYTHING} if known is None else known
    if EVERYTHING in targets:
        targets = {EVERYTHING}
    print("\n".join(sorted(targets)))
    return 0


def check(build, chosen):
    makes, wrong = outputs(build), []
    for test in chosen:
        if needs(build, test, makes) is None:
            wrong.append(f"{test.name}: what it needs is not known; add it by feltgate_script_test")
        for path in test.required:
            if not made(build, test, [path], makes) and not Path(path).exists():
                wrong.append(f"{test.name}: needs {path}, which nothing makes")
    print("\n".join(wrong) or "what each test needs is known")
    return 1 if wrong else 0


def print_list(chosen):
    width = max((len(test.name) for test in chosen), default=0)
    for test in chosen:
        print(f"{test.name:<{width}}  {' '.join(test.labels)}".rstrip())
    return 0


def print_minutes(chosen, results):
    """A table per group of a whole run's JUnit file, and the slowest tests."""
    cases = ElementTree.parse(results).getroot().iter("testcase")
    seconds = {case.get("name"): float(case.get("time", 0)) for case in cases}
    ran = [test for test in chosen if test.name in seconds]
    print("| group | tests | minutes | the longest | its seconds |\n|---|---|---|---|---|")
    for group in (*GROUPS, "other"):
        there = sorted((t for t in ran if t.group == group), key=lambda t: -seconds[t.name])
        if there:
            total, first = sum(seconds[t.name] for t in there), there[0].name
            row = f"{group} | {len(there)} | {total / 60:.1f} | `{first}` | {seconds[first]:.0f}"
            print(f"| {row} |")
    print(f"| all | {len(ran)} | {sum(seconds[t.name] for t in ran) / 60:.1f} | | |\n")
    for test in sorted(ran, key=lambda t: -seconds[t.name])[:12]:
        print(f"{seconds[test.name]:7.1f} s  {test.name}")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("verb", choices=("list", "targets", "check", "minutes"))
    parser.add_argument("--build", type=Path, required=True, help="build folder")
    parser.add_argument("--name", default="", help="regular expression of the tests' names")
    parser.add_argument(
        "--long", dest="of", action="store_const", const="Long", help="the long ones too"
    )
    parser.add_argument(
        "--whole", dest="of", action="store_const", const="Whole", help="not only their shares"
    )
    parser.add_argument("--results", type=Path, help="minutes: JUnit file of the run")
    options = parser.parse_args()
    build = options.build.resolve()
    try:
        # Who names tests gets the seeded defects of both halves.
        chosen = list(tests(build, options.name, options.of or ("Named" if options.name else "")))
        if options.verb == "minutes":
            return print_minutes(chosen, options.results)
        if options.verb == "list":
            return print_list(chosen)
        return (print_targets if options.verb == "targets" else check)(build, chosen)
    except (OSError, ValueError, subprocess.CalledProcessError, ElementTree.ParseError) as error:
        print(f"tests: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
