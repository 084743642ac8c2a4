# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Headers of the twin with mutants: all of a header's are compiled into the programs that test it
(testbench/campaigns/mutate/twin.toml). What does not compile is left out. Documentation: docs/testing.md
"""

import json
import re
import shutil
import tomllib
import zlib

import building
import command_line
import outputs
from command_line import say

from . import twin_places, twin_programs, twin_source
from .runs import MutateError, Subject

TESTS = "testbench/campaigns/mutate/twin.toml"
ATTEMPTS = 8


def tests(root, names):
    """{header: programs that test it} of the names, or all."""
    known = tomllib.loads((root / TESTS).read_text(encoding="utf-8"))
    unknown = [name for name in names if name not in known]
    if unknown:
        raise MutateError(f"no header {', '.join(unknown)} in {TESTS}; there are {', '.join(known)}")
    return {name: known[name] for name in names or known}


def parse(root, names, dropped):
    """The mutated headers; numbers run through all of them, from 1."""
    language = twin_places.cpp_language(command_line.build_folder() / "venv-mutate")
    headers, first = [], 1
    for name in names:
        path = root / twin_programs.HEADERS / twin_programs.header_of(root, name)
        text = path.read_text(encoding="utf-8")
        headers.append(twin_source.Header(name, text, first, language, dropped.get(name, ())))
        first += len(headers[-1].mutants)
    return headers


def listed(options):
    """Lines of --list: the headers, of named ones their mutants."""
    root = command_line.root()
    of = tests(root, options.name)
    for header in parse(root, of, {}):
        yield f"{header.name}: {len(header.mutants)} mutants, tested by {', '.join(of[header.name])}"
        for mutant in header.mutants if options.name else ():
            yield f"  {mutant.where[0]}: {mutant.what}"


def folder_of(build, names):
    """One for each set of headers: what others have made must not come between."""
    more = f"-{len(names) - 3}-more-{zlib.crc32(' '.join(names).encode()):08x}" if len(names) > 3 else ""
    return build / "mutants/twin" / ("-".join(names[:3]) + more)


def write_headers(root, headers, folder):
    shutil.rmtree(folder / "include", ignore_errors=True)
    for header in headers:
        path = folder / "include/feltgate" / twin_programs.header_of(root, header.name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(header.result, encoding="utf-8")


def refused(headers, folder, output):
    """{(header, mutant)} that a compiler's message is about: those of its line, the risky ones first."""
    # A compiler cache may shorten the paths.
    path = rf"mutants/twin/{re.escape(folder.name)}/include/feltgate/(?:axis/)?(\w+)\.hpp:(\d+):\d+:"
    places = re.findall(rf"{path} +error", output) or re.findall(rf"{path} +required from", output)
    bad = set()
    for name, line in set(places):
        header = next(h for h in headers if h.name == name)
        text = header.result.splitlines()[int(line) - 1]
        numbers = set(map(int, re.findall(r"feltgate_mutant::\w+[<(](?:-1, )?(\d+)", text)))
        here = [m for m in header.mutants if m.number in numbers]
        for kinds in (("arguments",), ("constant",), ("arithmetic", "rounding"), None):
            some = [m for m in here if kinds is None or header.kinds[m.number] in kinds]
            if some:
                bad |= {(name, m.what) for m in some}
                break
    return bad


def make(root, build, of, folder, jobs):
    """(headers, {program: path})."""
    targets = list(dict.fromkeys(target for targets in of.values() for target in targets))
    # Known from the last time; a mutant that is no longer there drops nothing.
    memory = folder.parent / "not_compiled.json"
    dropped = json.loads(memory.read_text(encoding="utf-8")) if memory.exists() else {}
    for attempt in range(ATTEMPTS):
        headers = parse(root, of, dropped)
        write_headers(root, headers, folder)
        count = sum(len(h.mutants) for h in headers)
        say("mutate", f"compiling {count} mutants of {len(headers)} headers, attempt {attempt + 1}")
        maker = twin_programs.Maker(build, root, folder, list(of), count + 1, jobs)
        try:
            programs = maker.make(targets)
            outputs.write_whole(memory, json.dumps(dropped))
            return headers, programs
        except twin_programs.CompileError as error:
            bad = refused(headers, folder, error.output)
            if not bad:
                raise
            for name, what in sorted(bad):
                dropped.setdefault(name, []).append(what)
    raise MutateError("the mutated headers do not compile, whatever is dropped")


def subjects(options):
    """(the headers of the names, or all, and the folder of their programs)."""
    root, build = command_line.root(), command_line.build_folder()
    of = tests(root, options.name)
    if not options.no_build:  # objects and libraries as they are serve the mutated ones
        building.make("mutate", build, sorted({t for them in of.values() for t in them}), options.jobs)
    folder = folder_of(build, list(of))
    headers, programs = make(root, build, of, folder, options.jobs)
    cases = {target: twin_programs.cases(path) for target, path in programs.items()}
    # A header's own tests only, also where another's reach it.
    return [
        Subject(h.name, h.name, h.mutants, [case for target in of[h.name] for case in cases[target]])
        for h in headers
    ], folder
