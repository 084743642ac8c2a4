# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of the C++ twin: would the tests notice if a line of its headers were wrong?

A header of model/include/feltgate is changed in one place at a time: another operator, a constant
one off, a condition turned round or left out, a statement removed, arguments swapped, another
rounding. All of them are compiled into the header's test programs once and chosen at run time. A
first run without any notes which test cases reach which mutants; each is then run by those until
one fails, within a limit of CPU time. What survives is listed with its reason in
testbench/campaigns/mutate/twin.toml, equivalent or a gap, or is printed. A mutant is named by its function
and what it changes, so that the list outlives a change of other lines. Method, results and what
this does not say: docs/testing.md

Exit code: 0 all headers have the share that is required killed, 1 one has not, 2 when a tool, a
file or an argument is wrong.

  feltgate mutate --twin                         200 mutants of every header
  feltgate mutate --twin ramp supervisor         those of two headers
  feltgate mutate --twin ramp --count 0          all that there are
  feltgate mutate --twin ramp --list             their names; runs nothing
  feltgate mutate --twin ramp --again old.json   what survived then, after tests have changed
"""

import json
import re
import shutil
import time
import zlib

import building
import command_line
import outputs
from command_line import say

from . import twin_parser, twin_programs, twin_results, twin_runs, twin_source
from .options import mutants_parser, parsed
from .rtl import chosen
from .twin_results import TwinError

REQUIRED = 0.95
SHARE = 200  # mutants of a header, where it offers so many


def parse(catalogue, root, names, dropped, language):
    """The mutated headers; numbers run through all of them."""
    headers, first = [], 0
    for name in names:
        text = (root / twin_programs.HEADERS / f"{name}.hpp").read_text(encoding="utf-8")
        header = twin_source.Header(
            name, text, first, language, catalogue.constant.get(name, ()), dropped.get(name, ())
        )
        first += len(header.mutants)
        headers.append(header)
    return headers


def folder_of(build, names):
    """One for each set of headers: what others have made must not come between."""
    some = "-".join(names[:3])
    more = f"-{len(names) - 3}-more-{zlib.crc32(' '.join(names).encode()):08x}"
    more = more if len(names) > 3 else ""
    return build / "mutants/twin" / (some + more)


def write_headers(headers, folder):
    shutil.rmtree(folder / "include", ignore_errors=True)
    for header in headers:
        path = folder / "include/feltgate" / f"{header.name}.hpp"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(header.result, encoding="utf-8")


def refused(headers, folder, output):
    """The mutants that a compiler's message is about: those of its line, the risky ones first."""
    lines = {
        h.name: (folder / "include/feltgate" / f"{h.name}.hpp")
        .read_text(encoding="utf-8")
        .splitlines()
        for h in headers
    }
    # A compiler cache may shorten the paths.
    path = rf"mutants/twin/{re.escape(folder.name)}/include/feltgate/(\w+)\.hpp:(\d+):\d+:"
    places = set(re.findall(rf"{path} +error", output)) or set(
        re.findall(rf"{path} +required from", output)
    )
    bad = set()
    for name, line in places:
        header = next(h for h in headers if h.name == name)
        numbers = {
            int(n)
            for n in re.findall(
                r"feltgate_mutant::\w+[<(](?:-1, )?(\d+)", lines[name][int(line) - 1]
            )
        }
        here = [m for m in header.mutants if m.number in numbers]
        for kinds in (("arguments",), ("constant",), ("arithmetic", "rounding"), None):
            some = [m for m in here if kinds is None or m.kind in kinds]
            if some:
                bad |= {(m.header, m.name) for m in some}
                break
    return bad


def make(catalogue, root, build, names, folder, language, options):
    """(headers, programs); what does not compile is dropped."""
    targets = list(dict.fromkeys(t for name in names for t in catalogue.tests[name]))
    if not options.no_build:  # objects and libraries as they are serve the mutated ones
        building.make("mutate", build, targets, options.jobs)
    # Known from the last time; a mutant that is no longer there drops nothing.
    memory = folder.parent / "not_compiled.json"
    known = json.loads(memory.read_text(encoding="utf-8")) if memory.exists() else {}
    dropped = {name: set(known[name]) for name in names if name in known}
    for attempt in range(8):
        headers = parse(catalogue, root, names, dropped, language)
        write_headers(headers, folder)
        count = sum(len(h.mutants) for h in headers)
        again = f", attempt {attempt + 1}" if attempt else ""
        say("mutate", f"compiling {count} mutants of {len(headers)} headers{again}")
        maker = twin_programs.Maker(build, root, folder, names, max(count, 1), options.jobs)
        try:
            programs = maker.make(targets)
            found = known | {name: sorted(mutants) for name, mutants in dropped.items()}
            outputs.write_whole(memory, json.dumps(found))
            return headers, programs, dropped
        except twin_programs.BuildError as error:
            bad = refused(headers, folder, error.output)
            if not bad:
                raise TwinError(f"{error.args[0]}\n{error.output[-4000:]}") from None
            for name, mutant in bad:
                dropped.setdefault(name, set()).add(mutant)
    raise TwinError("the mutated headers do not compile, whatever is dropped")


def run(options):
    """The exit code."""
    root, build = command_line.root(), command_line.build_folder()
    catalogue = twin_results.read_catalogue(root)
    names = options.name or list(catalogue.tests)
    unknown = [n for n in names if n not in catalogue.tests]
    if unknown:
        raise TwinError(
            f"no header {', '.join(unknown)} in {twin_results.CATALOGUE}; "
            f"there are {', '.join(catalogue.tests)}"
        )
    survived = twin_results.survivors_of(options.again) if options.again else None
    if options.only_arguments:
        return 0
    language = twin_parser.cpp_language(build / "venv-mutate")
    if options.list:
        for header in parse(catalogue, root, names, {}, language):
            print(
                f"{header.name}: {len(header.mutants)} mutants, "
                f"tested by {', '.join(catalogue.tests[header.name])}"
            )
            for mutant in header.mutants if options.name else ():
                print(f"  {mutant.line}: {mutant.name}")
        return 0
    start = time.monotonic()
    folder = folder_of(build, names)
    made = make(catalogue, root, build, names, folder, language, options)
    headers, programs, dropped = made
    runs = twin_runs.Runs(folder, options.jobs)
    cases = runs.survey(programs)
    say(
        "mutate",
        f"{len(cases)} test cases, {sum(c.seconds for c in cases):.0f} s of CPU; "
        f"{time.monotonic() - start:.0f} s so far",
    )
    tried = [m for h in headers for m in chosen(h, options)]
    if options.again:
        tried = [
            m
            for h in headers
            for m in h.mutants
            if (m.header, m.name) in survived and (m.header, m.name) not in catalogue.survivors
        ]
    # A header's own tests only, also where another's reach it.
    own = {
        h.name: [c for c in cases if c.program.target in catalogue.tests[h.name]] for h in headers
    }
    verdicts = runs.verdicts([(m, own[m.header]) for m in tried])
    rows = [
        twin_results.Row(
            h.name, len(h.mutants), [v for v in verdicts if v.mutant.header == h.name], catalogue
        )
        for h in headers
    ]
    twin_results.print_survivors(rows, options.survivors)
    print(twin_results.table(rows))
    bad = [row.header for row in rows if row.share() < options.require]
    dead = sum(v.how in twin_results.DEAD for v in verdicts)
    print(
        f"{len(verdicts)} mutants of {len(rows)} headers, {dead} killed, "
        f"{len(bad)} headers below {100 * options.require:.0f} %; {time.monotonic() - start:.0f} s"
    )
    result = twin_results.results_of(rows, options, dropped)
    if options.json:
        outputs.write_json(options.json, result)
    if options.update:
        twin_results.update(root, catalogue, result)
        print(f"mutate: wrote {twin_results.RESULTS}")
    return 1 if bad else 0


def arguments(argv):
    parser = mutants_parser("mutate --twin", __doc__, "HEADER", "without .hpp", SHARE)
    what = f"put the results of these headers into {twin_results.RESULTS}, their sums where "
    command_line.add_flags(parser, update=what + "docs/blocks.md has them")
    options = parsed(parser, argv, REQUIRED)
    if options.update and options.again:
        parser.error("--update takes a run without --again")
    return options


def main(argv):
    options = arguments(argv)
    return command_line.ended("mutate", lambda: run(options))
