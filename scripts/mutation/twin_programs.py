# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Test programs with mutated headers: the commands of the build folder, with another include path.
Documentation: docs/testing.md
"""

import os
import re
import shlex

import interrupts
from crew import Crew

from .runs import Case, MutateError

HEADERS = "model/include/feltgate"
SUPPORT = "testbench/campaigns/mutate/twin"


def header_of(root, name):
    """The path of NAME.hpp below HEADERS: the axis' own comes first."""
    of_axis = f"axis/{name}.hpp"
    return of_axis if (root / HEADERS / of_axis).exists() else f"{name}.hpp"


# Warnings and a code that is not quite C++ are no matter; every error is.
OPTIONS = ["-UFELTGATE_COMPILED_TWIN", "-O2", "-w", "-Wno-narrowing", "-fpermissive", "-fmax-errors=0"]


class CompileError(MutateError):
    """What a compiler said."""

    def __init__(self, text, output):
        super().__init__(f"{text}\n{output[-4000:]}".strip())
        self.output = output


def ninja(build, *arguments):
    """What ninja says of the build folder, and its status."""
    done = interrupts.run(["ninja", "-C", str(build), *arguments], **interrupts.CAPTURED)
    return done.stdout, done.returncode


def link_command(line):
    """The linker's part of a line of `ninja -t commands`."""
    return next(part for part in line.split(" && ") if " -o " in part)


def dependencies(build, objects):
    """{object: the files that it was made of}, of those that ninja knows."""
    found, at = {}, None
    for line in ninja(build, "-t", "deps", *objects)[0].splitlines():
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
        self.headers = {os.path.realpath(root / HEADERS / header_of(root, h)) for h in headers}
        self.count, self.objects, self.crew = count, {}, Crew()

    def call(self, command):
        """Runs a compiler in the build folder."""
        done = self.crew.run(list(map(str, command)), cwd=self.build, **interrupts.CAPTURED)
        if done.returncode:
            raise CompileError(f"{command[0]} ended with {done.returncode}", done.stderr + done.stdout)

    def plan(self, target):
        """(compile commands of the objects to be made again, link command)."""
        lines, status = ninja(self.build, "-t", "commands", target)
        compiles = {}
        for line in lines.splitlines():
            words = shlex.split(line.split(" && ")[0]) if " -c " in line else []
            if "-c" in words and "-o" in words:
                compiles[words[words.index("-o") + 1]] = words
        links = [line for line in lines.splitlines() if re.search(rf" -o \S*\b{re.escape(target)}\b", line)]
        if status or not links:
            raise MutateError(f"the build folder {self.build} has no program {target}")
        compiler = shlex.split(link_command(links[-1]))[0]
        compiles = {  # Without a launcher such as ccache, whose options are none of the compiler's.
            o: words[words.index(compiler) :] for o, words in compiles.items() if compiler in words
        }
        made_of = dependencies(self.build, list(compiles))
        chosen = {o: w for o, w in compiles.items() if self.concerns(w[-1], made_of.get(o))}
        if not chosen:
            raise MutateError(f"{target} includes none of the headers")
        return chosen, links[-1]

    def concerns(self, source, made_of):
        """Whether an object is of the headers; one that ninja does not know is, where its source is
        ours."""
        if made_of is None:
            return source.startswith((f"{self.root}/model/", f"{self.root}/testbench/"))
        return bool(self.headers & made_of)

    def compile(self, name, words):
        """One object; made once for all programs."""
        out = self.folder / "objects" / name
        out.parent.mkdir(parents=True, exist_ok=True)
        words = [w for w in words if not w.startswith("-W") and w != "-O3"]
        words[words.index("-o") + 1] = str(out)
        if "-MF" in words:
            words[words.index("-MF") + 1] = f"{out}.d"
        include = [f"-I{self.folder / 'include'}", f"-I{self.root / SUPPORT}", "-include", "mutant.hpp"]
        self.call([words[0], *include, *words[1:], *OPTIONS])
        return out

    def make(self, targets):
        """{target: its program}; all objects first, side by side."""
        plans = {target: self.plan(target) for target in targets}
        wanted = {o: w for compiles, _ in plans.values() for o, w in compiles.items()}
        compiler = next(iter(wanted.values()))[0]
        selector, said = self.folder / "mutant.o", []
        self.call([compiler, "-std=c++17", "-O2", f"-DFELTGATE_MUTANTS={self.count}",
                   "-c", self.root / SUPPORT / "mutant.cpp", "-o", selector])

        def compiled(item):
            try:
                self.objects[item[0]] = self.compile(*item)
            except CompileError as error:
                return error.output
            return ""

        self.crew.each(compiled, wanted.items(), self.jobs, lambda _, output: said.append(output))
        if any(said):
            raise CompileError("mutated headers do not compile", "".join(said))
        return {target: self.link(target, *plans[target], selector) for target in targets}

    def link(self, target, compiles, link, selector):
        """The program from its objects made again and the others as they are."""
        words = shlex.split(link_command(link))
        at = words.index("-o")
        out = self.folder / target
        mine = {o: str(self.objects[o]) for o in compiles}
        head, inputs = ([mine.get(w, w) for w in some] for some in (words[:at], words[at + 2 :]))
        # Members of libraries that are made again come before the library, which then is not asked.
        members = [o for o in mine.values() if o not in head and o not in inputs]
        self.call([*head, *members, selector, "-o", out, *inputs])
        return out


def cases(program):
    """The test cases of a program."""
    for option in (["--list-test-names-only"], ["--list-tests", "--verbosity", "quiet"]):
        done = interrupts.run([str(program), *option], **interrupts.CAPTURED)
        names = [line.strip() for line in done.stdout.splitlines() if line.strip()]
        if names and not done.stderr:
            escaped = (re.sub(r"([\\,\[])", r"\\\1", name) for name in names)
            return [Case([str(program), "--abort", name]) for name in escaped]
    raise MutateError(f"{program} does not list its test cases")
