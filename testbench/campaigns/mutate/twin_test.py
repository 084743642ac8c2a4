#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of C++ headers: what is offered, and that each does what its name says.

twin_test.py VENV: the folder into which scripts/build.sh has fetched tree-sitter.
Documentation: docs/testing.md
"""

import os
import subprocess
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, called, ran

import block_results
from mutation import twin, twin_parser, twin_places, twin_results, twin_runs, twin_source

VENV = Path("none")
if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
    VENV = Path(sys.argv.pop(1))

try:
    LANGUAGE = twin_parser.cpp_language(VENV)
except twin_parser.SourceError:
    LANGUAGE = None

MUTANT = ROOT / "testbench/campaigns/mutate/twin"


def header(text, **more):
    return twin_source.Header("h", text, 0, LANGUAGE, **more)


def names(text):
    return [m.name for m in header(text).mutants]


@unittest.skipIf(LANGUAGE is None and not os.environ.get("CI"),
                 "no tree-sitter; ./feltgate mutate --twin fetches it")
class Offered(unittest.TestCase):
    def test_what_only_the_compiler_sees_stays(self):
        for text in ("constexpr int k = 3 + 2;", "static_assert(3 + 2 == 5);",
                     "template <int N = 3 + 2> struct S;",
                     "enum E { a = 1 + 1 };", "struct In { int a = 3; };", "int a[3 + 1];",
                     "void f() { if constexpr (A + 1 == 2) { } }",
                     "void f(int a) { switch (a) { case 1 + 1: default: } }"):
            self.assertEqual(names(text), [], text)

    def test_every_header_is_understood(self):
        catalogue = twin_results.read_catalogue(ROOT)
        for found in twin.parse(catalogue, ROOT, list(catalogue.tests), {}, LANGUAGE):
            every = {m.name for m in found.mutants}
            listed = {name for h, name in catalogue.survivors if h == found.name}
            self.assertEqual(listed - every, set(),
                             f"testbench/campaigns/mutate/twin.toml: {found.name} has no such mutant")


@unittest.skipIf(LANGUAGE is None and not os.environ.get("CI"), "no tree-sitter")
class Compiled(Scratch):
    def results(self, body, calls, expected):
        """The header's calls in every mutant, printed; {name: what they print}."""
        found = header(body)
        printed = f'std::printf("{"%d " * len(calls)}", {", ".join(calls)});'
        main = self.put("main.cpp", '#include "mutant.hpp"\n#include <cstdio>\n' + found.result +
                        f"\nint main() {{ {printed} }}\n")
        subprocess.run(["c++", "-std=c++17", "-w", f"-I{MUTANT}",
                        f"-DFELTGATE_MUTANTS={len(found.mutants)}", main, MUTANT / "mutant.cpp",
                        "-o", self.folder / "p"], check=True)

        def run(**more):
            done = ran(self.folder / "p", env=more, check=True)
            return [int(word) for word in done.stdout.split()]

        self.assertEqual(run(), expected)
        run(FELTGATE_MUTANTS_REACHED=str(self.folder / "reached"))
        reached = (self.folder / "reached").read_text(encoding="ascii").splitlines()
        self.reached = {int(line) for line in reached if not line.endswith("exact")}
        return {m.name: run(FELTGATE_MUTANT=str(m.number)) for m in found.mutants}

    def test_each_does_what_its_name_says(self):
        body = """
constexpr int half = 10 / 2;
constexpr int clamp(int x, int limit) {
  if (x > limit && limit >= 0) return limit;
  return x;
}
static_assert(clamp(7, 5) == 5, "constants have no mutants");
inline bool odd(int x) { return (x & 1) != 0; }
inline int count(int n) {
  int sum = 0;
  for (int k = 0; k < n; ++k) sum += k;
  return sum;
}
inline int never() { return 3; }
inline int minus(int a, int b) { return a - b; }
inline int swaps() { return minus(7, 4); }
struct Other {};
inline int mixed(int a, Other) { return a; }
inline int keeps() { return mixed(7, Other()); }
"""
        calls = ["clamp(7, 5)", "clamp(5, 5)", "clamp(7, -1)", "odd(3)", "count(3)", "half",
                 "swaps()", "keeps()"]
        got = self.results(body, calls, [5, 5, 7, 1, 3, 5, 3, 7])
        self.assertEqual(got["clamp: x > limit -> x <= limit"][0], 7)
        self.assertEqual(got["clamp: limit >= 0 -> left out of &&"][2], -1)
        self.assertEqual(got["clamp: && limit >= 0 -> || limit >= 0"][2], -1)
        self.assertEqual(got["odd: x & 1 -> x | 1"][3], 1)
        self.assertEqual(got["odd: (x & 1) != 0 -> (x & 1) == 0"][3], 0)
        self.assertEqual(got["count: sum += k -> removed"][4], 0)
        self.assertEqual(got["count: sum += k -> sum -= k"][4], -3)
        self.assertEqual(got["count: k < n -> k <= n"][4], 6)
        self.assertEqual(got["swaps: minus(7, 4) -> minus(4, 7)"][6], -3)
        self.assertEqual(len(got) - len(self.reached), 3)  # never(), and keeps() has no such call


class Verdicts(Scratch):
    def row(self, hows, survivors):
        mutants = [twin_places.Mutant(n, "h", 1, "k", f"m{n}") for n in range(len(hows))]
        catalogue = twin_results.Catalogue({"h": ["t"]}, {}, survivors)
        verdicts = [twin_runs.Verdict(m, how) for m, how in zip(mutants, hows)]
        return twin_results.Row("h", 9, verdicts, catalogue)

    def test_equivalent_ones_do_not_count(self):
        row = self.row(["killed", "hangs", "survives", "unreached"],
                       {("h", "m2"): ("equivalent", "w")})
        self.assertAlmostEqual(row.share(), 2 / 3)
        self.assertEqual((len(row.left("equivalent")), len(row.left("gap")), len(row.left(None))),
                         (1, 0, 1))

    def test_a_gap_counts(self):
        row = self.row(["killed", "survives"], {("h", "m1"): ("gap", "w")})
        self.assertAlmostEqual(row.share(), 1 / 2)

    def test_options_that_do_nothing_are_refused(self):
        for wrong in (["--jobs", "0"], ["--update", "--again", "x.json"], ["--coun", "3"],
                      ["--list", "--update"], ["--list", "--json", "x"]):
            self.assertEqual(called(twin.arguments, *wrong)[0], 2)

    def test_an_unknown_header_is_said(self):
        status, _, said = called(twin.main, "suprevisor")
        self.assertEqual(status, 2)
        self.assertIn("supervisor", said)

    def test_the_products_catalogue_has_a_row_of_the_table_for_each_header(self):
        catalogue = twin_results.read_catalogue(ROOT)
        for header in catalogue.tests:
            row = catalogue.blocks.get(header, header)
            self.assertTrue(row in block_results.EXTRA or list(ROOT.glob(f"rtl/**/{row}.sv")),
                            header)


if __name__ == "__main__":
    unittest.main()
