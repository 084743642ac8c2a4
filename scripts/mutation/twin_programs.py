# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Test programs with mutated headers: the commands of the build folder, with another include path.

Documentation: docs/testing.md
"""

import os
import re
import shlex
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from command_line import Refused
import interrupts
from crew import Crew

HEADERS = "model/include/feltgate"


class BuildError(Refused):
    """A program that cannot be made; what a compiler said, where it did."""

    def __init__(self, text, output=""):
        super().__init__(text)
        self.output = output

    def __str__(self):
        return f"{self.args[0]}\n{self.output}".strip()


@dataclass
class Case:
    """A test case, and the mutants that it reaches."""

    program: "Program"
    name: str
    seconds: float = 0.0
    reached: set = field(default_factory=set)
    exact: set = field(default_factory=set)  # mutants of a rounding that has nothing to round


@dataclass
class Program:
    """A test program with mutants."""

    target: str
    path: Path
    cases: list = field(default_factory=list)


def ninja(build, *arguments):
    """What ninja says of the build folder; BuildError where it fails."""
    done = interrupts.run(["ninja", "-C", str(build), *arguments], **interrupts.CAPTURED)
    if done.returncode:
        raise BuildError(
            f"ninja {' '.join(arguments)}: {done.stdout.strip()[-2000:]}{done.stderr.strip()}"
        )
    return done.stdout


def link_command(line):
    """The linker's part of a line of `ninja -t commands`."""
    return next(part for part in line.split(" && ") if " -o " in part)


def dependencies(build, objects):
    """{object: the files that it was made of}."""
    found, at = {}, None
    # Its status is not 0 where it does not know one of them.
    told = interrupts.run(
        ["ninja", "-C", str(build), "-t", "deps", *objects], **interrupts.CAPTURED
    ).stdout
    for line in told.splitlines():
        if ": #deps" in line:
            at = found.setdefault(line.split(": #deps")[0], set())
        elif line.startswith(" ") and at is not None:
            at.add(os.path.realpath(build / line.strip()))
    return found


class Maker:
    """Makes programs of a build folder again, with the headers of `folder` in front of the real
    ones."""

    def __init__(self, build, root, folder, headers, count, jobs):
        self.build, self.root, self.folder, self.jobs = build, root, folder, jobs
        self.headers = {os.path.realpath(root / HEADERS / f"{h}.hpp") for h in headers}
        self.count = count
        self.objects = {}
        self.crew = Crew()

    def include(self):
        return [f"-I{self.folder / 'include'}", f"-I{self.root / 'testbench/campaigns/mutate/twin'}"]

    def compile_selector(self, compiler):
        """The object that knows which mutant was chosen."""
        out = self.folder / "mutant.o"
        source = self.root / "testbench/campaigns/mutate/twin/mutant.cpp"
        self.call(
            [
                *compiler,
                "-std=c++17",
                "-O2",
                f"-DFELTGATE_MUTANTS={self.count}",
                "-c",
                source,
                "-o",
                out,
            ]
        )
        return out

    def call(self, command):
        """Runs a compiler in the build folder; BuildError with what it said."""
        done = self.crew.run(list(map(str, command)), cwd=self.build, **interrupts.CAPTURED)
        if done.returncode:
            raise BuildError(
                f"{' '.join(map(str, command[:2]))} ... ended with {done.returncode}",
                done.stderr + done.stdout,
            )

    def plan(self, target):
        """(compile commands of the objects to be made again, link command)."""
        lines = ninja(self.build, "-t", "commands", target).splitlines()
        compiles = {}
        for line in lines:
            words = shlex.split(line.split(" && ")[0]) if " -c " in line else []
            if "-c" in words and "-o" in words:
                compiles[words[words.index("-o") + 1]] = words
        link = next(
            (
                line
                for line in reversed(lines)
                if re.search(rf" -o \S*\b{re.escape(target)}\b", line)
            ),
            None,
        )
        if link is None:
            raise BuildError(f"the build folder has no program {target}")
        compiler = shlex.split(link_command(link))[0]
        compiles = {  # Without a launcher such as ccache, whose options are none of the compiler's.
            o: words[words.index(compiler) :] for o, words in compiles.items() if compiler in words
        }
        made_of = dependencies(self.build, list(compiles))
        chosen = {o: w for o, w in compiles.items() if self.concerns(w[-1], made_of.get(o))}
        if not chosen:
            raise BuildError(f"{target} includes none of the headers")
        return chosen, link

    def concerns(self, source, made_of):
        """Whether an object is of the headers; one that ninja does not know is, where its source is
        ours."""
        if made_of is None:
            return any(
                source.startswith(f"{self.root}/{folder}/") for folder in ("model", "testbench")
            )
        return bool(self.headers & made_of)

    def compile(self, name, words):
        """One object; made once for all programs."""
        out = self.folder / "objects" / name
        out.parent.mkdir(parents=True, exist_ok=True)
        at = words.index("-o")
        words = [*words[: at + 1], str(out), *words[at + 2 :]]
        if "-MF" in words:
            words[words.index("-MF") + 1] = f"{out}.d"
        first = next(k for k, w in enumerate(words) if w.startswith("-"))
        words = [w for w in words if not w.startswith("-W") and w != "-O3"]
        self.call(
            [
                *words[:first],
                *self.include(),
                "-include",
                "mutant.hpp",
                *words[first:],
                "-O2",
                "-w",
                "-Wno-narrowing",
                "-fpermissive",
                "-fmax-errors=0",
            ]
        )
        return out

    def make(self, targets):
        """The programs; all objects first, side by side."""
        plans = {target: self.plan(target) for target in targets}
        wanted = {o: w for compiles, _ in plans.values() for o, w in compiles.items()}
        some = next(iter(wanted.values()))
        compiler = some[: next(k for k, w in enumerate(some) if w.startswith("-"))]
        selector = self.compile_selector(compiler)
        said = []

        def compiled(item):
            try:
                return self.compile(*item), ""
            except BuildError as error:
                return None, error.output or str(error)

        def note(item, result):
            self.objects[item[0]], complaint = result
            said.append(complaint)

        self.crew.each(compiled, wanted.items(), self.jobs, note)
        if any(said):
            raise BuildError("mutated headers do not compile", "".join(said))
        return [Program(target, self.link(target, *plans[target], selector)) for target in targets]

    def link(self, target, compiles, link, selector):
        """The program from its objects made again and the others as they are."""
        words = shlex.split(link_command(link))
        at = words.index("-o")
        out = self.folder / target
        mine = {o: str(self.objects[o]) for o in compiles}
        inputs = [mine.get(w, w) for w in words[at + 2 :]]
        head = [mine.get(w, w) for w in words[:at]]
        # Members of libraries that are made again come before the library, which then is not asked.
        members = [o for o in mine.values() if o not in head and o not in inputs]
        self.call([*head, *members, selector, "-o", out, *inputs])
        return out


def list_cases(program):
    """The test cases of a program, by their names."""
    for option in (["--list-test-names-only"], ["--list-tests", "--verbosity", "quiet"]):
        done = subprocess.run([program.path, *option], capture_output=True, text=True, check=False)
        names = [line.strip() for line in done.stdout.splitlines() if line.strip()]
        if names and not done.stderr:
            return [Case(program, name) for name in names]
    raise BuildError(f"{program.target} does not list its test cases")
