# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Blocks with mutants of the RTL: the test programs that CMake has linked with netlists of mutants."""

import json

import building
import command_line

from .runs import Case, MutateError, Mutant, Subject


def programs(build):
    """{program: the test's name and its block} of all that the build folder is configured with."""
    found = {}
    for path in sorted(build.glob("testbench/**/*_mutants.netlist/test.json")):
        found[path.parent.with_suffix("")] = json.loads(path.read_text(encoding="utf-8"))
    if not found:
        raise MutateError(f"{build} knows no mutants: it was configured without tests, or without yosys")
    return found


def mutants_of(program):
    path = program.with_name(f"{program.name}.netlist") / "mutants.json"
    if not path.exists():
        raise MutateError(f"{path} is missing; build the target {program.name}")
    return [Mutant(**entry) for entry in json.loads(path.read_text(encoding="utf-8"))]


def wanted(options):
    """{program: its test and block} of the names, or all; with --update of all tests of a block."""
    known = programs(command_line.build_folder())

    def names(program):  # a test may have the name of its block
        test, block = known[program]["test"], known[program]["block"]
        return block, test, f"{block}.{test}"

    def unknown(words):
        there = ", ".join(dict.fromkeys(entry["block"] for entry in known.values()))
        return MutateError(f"no block {words} with mutants; there are {there}")

    found = command_line.chosen(list(known), options.name, names, unknown)
    blocks = {known[program]["block"] for program in found} if options.update else ()
    return {p: entry for p, entry in known.items() if p in found or entry["block"] in blocks}


def listed(options):
    """Lines of --list."""
    return [f"{one['test']}: {one['block']}, {program.name}" for program, one in wanted(options).items()]


def subjects(options):
    """(the tests of the names, or all, and a folder for what they write)."""
    build, found = command_line.build_folder(), wanted(options)
    if not options.no_build:
        building.make("mutate", build, [program.name for program in found], options.jobs)
    return [
        Subject(one["test"], one["block"], mutants_of(program), [Case([str(program), "--abort"])])
        for program, one in found.items()
    ], build / "mutants/rtl"
