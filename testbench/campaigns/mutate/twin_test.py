#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of C++ headers: each does what its name says, and some are killed.

twin_test.py BUILD OPTION...: the folder with the programs, and what mutate --twin is called with.
Documentation: docs/testing.md
"""

import os
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

from testing import ROOT, Scratch, ran

import mutate
from mutation import twin, twin_places, twin_source

BUILD, OPTIONS = Path(sys.argv[1] if len(sys.argv) > 1 else "none"), sys.argv[2:]
try:
    LANGUAGE = twin_places.cpp_language(BUILD / "venv-mutate")
except twin_places.SourceError:
    LANGUAGE = None
NO_PARSER = LANGUAGE is None and not os.environ.get("CI")
MUTANT = ROOT / "testbench/campaigns/mutate/twin"


@unittest.skipIf(NO_PARSER, "no tree-sitter; ./feltgate test fetches it")
class Compiled(Scratch):
    def results(self, body, calls, expected):
        """The header's calls in every mutant, printed; {name: what they print}."""
        found = twin_source.Header("h", body, 1, LANGUAGE)
        printed = f'std::printf("{"%d " * len(calls)}", {", ".join(calls)});'
        main = self.put("main.cpp", '#include "mutant.hpp"\n#include <cstdio>\n' + found.result +
                        f"\nint main() {{ {printed} }}\n")
        subprocess.run(["c++", "-std=c++17", "-w", f"-I{MUTANT}",
                        f"-DFELTGATE_MUTANTS={len(found.mutants) + 1}", main, MUTANT / "mutant.cpp",
                        "-o", self.folder / "p"], check=True)

        def run(**more):
            done = ran(self.folder / "p", env=more, check=True)
            return [int(word) for word in done.stdout.split()]

        self.assertEqual(run(), expected)
        run(FELTGATE_MUTANTS_REACHED=str(self.folder / "reached"))
        self.reached = (self.folder / "reached").read_text(encoding="ascii").splitlines()
        return {m.what: run(FELTGATE_MUTANT=str(m.number)) for m in found.mutants}

    def test_every_header_is_understood(self):
        with mock.patch.object(twin_places, "cpp_language", lambda _: LANGUAGE):
            self.assertTrue(all(h.mutants for h in twin.parse(ROOT, twin.tests(ROOT, []), {})))

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


@unittest.skipIf(NO_PARSER or not OPTIONS, "no tree-sitter; ./feltgate test fetches it")
class Share(unittest.TestCase):
    def test_some_mutants_are_killed_as_on_record(self):
        with mock.patch.dict(os.environ, FELTGATE_BUILD=str(BUILD)):
            self.assertEqual(mutate.main(["--twin", "--no-build", *OPTIONS]), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
