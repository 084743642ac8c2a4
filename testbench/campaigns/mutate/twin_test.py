#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of C++ headers: what is offered, and that each does what its name says.

twin_test.py VENV: the folder into which scripts/build.sh has fetched tree-sitter.
Documentation: docs/testing.md
"""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

from testing import ROOT, Scratch, called, ran

import block_results
from mutation import twin, twin_parser, twin_places, twin_programs, twin_results
from mutation import twin_runs, twin_source

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


class Plans(unittest.TestCase):
    """Which commands of a build folder are taken."""

    def plan(self, launcher):
        lines = [
            f"{launcher}/usr/bin/c++ -DX -O3 -MF a.o.d -o t.dir/a.o -c /r/model/a.cpp",
            ": && /usr/bin/c++ -O3  t.dir/a.o -o testbench/t  lib.a && :",
        ]
        maker = twin_programs.Maker(Path("/b"), Path("/r"), Path("/f"), ["h"], 1, 1)
        with mock.patch.object(twin_programs, "ninja", return_value="\n".join(lines)), \
                mock.patch.object(twin_programs, "dependencies", return_value={}):
            return maker.plan("t")[0]["t.dir/a.o"]

    def test_a_launcher_is_left_out_with_its_options(self):
        plain = self.plan("")
        self.assertEqual(plain[0], "/usr/bin/c++")
        for launcher in ("/usr/bin/ccache ", "/usr/bin/cmake -E env A=b /usr/bin/ccache "):
            self.assertEqual(self.plan(launcher), plain)


@unittest.skipIf(LANGUAGE is None and not os.environ.get("CI"),
                 "no tree-sitter; ./feltgate mutate --twin fetches it")
class Offered(unittest.TestCase):
    def test_operators(self):
        found = names("int f(int a, int b) { return a < b ? a + b : a << b; }")
        self.assertEqual(found, ["f: a < b -> a <= b", "f: a < b -> a >= b", "f: a + b -> a - b",
                                 "f: a << b -> a >> b"])

    def test_a_chain_loses_one_condition_at_a_time(self):
        found = names("bool f(bool a, bool b, bool c) { return a && b && c; }")
        self.assertEqual(found, ["f: a && b && c -> its opposite", "f: a -> left out of &&",
                                 "f: b -> left out of &&", "f: c -> left out of &&",
                                 "f: && b -> || b", "f: && c -> || c"])

    def test_statements(self):
        found = names("void f(int& a) { a = 3; if (a > 2) return; g(a); a += 1, a = 0; }")
        for wanted in ("f: a = 3 -> removed", "f: return -> removed", "f: g(a) -> removed",
                       "f: a = 0 -> removed"):
            self.assertIn(wanted, found)

    def test_constants(self):
        self.assertEqual(names("int f() { return 7; }"),
                         ["f: 7 in return 7 -> 7 + 1", "f: 7 in return 7 -> 7 - 1"])
        self.assertEqual(names("bool f() { return true; }"), ["f: true in return true -> false"])

    def test_rounding(self):
        found = names("int f(int x) { return round<Round::half_up, Overflow::saturate>(x); }")
        self.assertEqual(len(found), 2)
        self.assertIn("Round::truncate", found[0])
        self.assertIn("Overflow::wrap", found[1])

    def test_the_second_of_the_same_has_its_number(self):
        self.assertIn("f: a + b -> a - b #2",
                      names("int f(int a, int b) { return (a + b) * (a + b); }"))

    def test_what_only_the_compiler_sees_stays(self):
        for text in ("constexpr int k = 3 + 2;", "static_assert(3 + 2 == 5);",
                     "template <int N = 3 + 2> struct S;",
                     "enum E { a = 1 + 1 };", "struct In { int a = 3; };", "int a[3 + 1];",
                     "void f() { if constexpr (A + 1 == 2) { } }",
                     "void f(int a) { switch (a) { case 1 + 1: default: } }"):
            self.assertEqual(names(text), [], text)

    def test_functions_of_the_compiler_may_be_named(self):
        self.assertEqual(header("constexpr int f() { return 3; }", constant=["f"]).mutants, [])

    def test_a_dropped_one_is_not_offered(self):
        text = "int f(int a) { return -a; }"
        (one,) = header(text).mutants
        self.assertEqual(header(text, dropped=[one.name]).mutants, [])

    def test_lines_and_columns_survive_comments(self):
        (one,) = header("// a < b\n/* c\n */ int f(int a) { return -a; }\n").mutants
        self.assertEqual(one.line, 3)

    def test_no_c_plus_plus_is_said(self):
        with self.assertRaises(twin_parser.SourceError) as error:
            header("int f( {")
        self.assertIn("h:1", str(error.exception))

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

    def test_the_choice_is_the_seeds(self):
        mutants = [twin_places.Mutant(n, "h", 1, "k", str(n)) for n in range(50)]
        one = type("H", (), {"name": "h", "mutants": mutants})
        all_of_them, some, others = (
            twin.chosen(one, SimpleNamespace(count=c, seed=s)) for c, s in ((0, 1), (9, 1), (9, 2)))
        self.assertEqual(some, twin.chosen(one, SimpleNamespace(count=9, seed=1)))
        self.assertNotEqual(some, others)
        self.assertEqual(all_of_them, mutants)

    def test_a_compiler_drops_what_its_message_is_about(self):
        self.put("mutants/twin/h/include/feltgate/h.hpp",
                 "x\n(::feltgate_mutant::on(0) ? f(b, a) : ::feltgate_mutant::plus<1>(a, b))\n")
        one = type("H", (), {"name": "h", "mutants": [
            twin_places.Mutant(0, "h", 2, "arguments", "swap"),
            twin_places.Mutant(1, "h", 2, "arithmetic", "add")]})
        said = "a/mutants/twin/h/include/feltgate/h.hpp:2:7: error: no match\n"
        self.assertEqual(twin.refused([one], self.folder / "mutants/twin/h", said), {("h", "swap")})

    def test_results_become_rows_of_the_blocks(self):
        row = self.row(["killed", "hangs", "survives", "unreached"],
                       {("h", "m2"): ("equivalent", "w")})
        row.catalogue.blocks["h"] = "twin of the core"
        (self.folder / "docs/verification").mkdir(parents=True)
        options = type("O", (), {"seed": 1, "count": 0})
        result = twin_results.results_of([row], options, {})
        for _ in range(2):  # the second time replaces the first
            twin_results.update(self.folder, row.catalogue, result)
        blocks = block_results.read(self.folder, "mutants")["blocks"]
        self.assertEqual(blocks["twin of the core"].pop("sources").keys(), {"twin"})
        self.assertEqual(blocks, {"twin of the core": {"twin": [2, 3]}})
        written = json.loads((self.folder / twin_results.RESULTS).read_text(encoding="utf-8"))
        self.assertEqual([h["header"] for h in written["headers"]], ["h"])
        self.assertNotIn("survivors", written["headers"][0])
        self.assertEqual(written["headers"][0]["machine"], block_results.machine())

        path = self.put("old.json", json.dumps(result))
        self.assertEqual(twin_results.survivors_of(path), {("h", "m2"), ("h", "m3")})
        path.write_text("{}", encoding="utf-8")
        with self.assertRaises(twin_results.TwinError):
            twin_results.survivors_of(path)

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

    def test_a_catalogue_that_cannot_be_used(self):
        good = '[tests]\nh = ["t"]\n[block]\nh = "b"\n[[survivor]]\nheader = "h"\n' \
               'kind = "gap"\nwhy = "w"\nmutants = ["m"]\n'
        path = self.put("testbench/campaigns/mutate/twin.toml", good)
        self.assertEqual(twin_results.read_catalogue(self.folder).survivors,
                         {("h", "m"): ("gap", "w")})
        for was, becomes in (('"gap"', '"luck"'), ('"w"', '""'), ('why = "w"\n', ""),
                             ("why", "reason"), ('h = "b"', 'h = ["b"]'),
                             ('h = "b"', 'other = "b"'), ("[tests]", "[tests")):
            path.write_text(good.replace(was, becomes), encoding="utf-8")
            with self.subTest(becomes), self.assertRaises(twin_results.TwinError):
                twin_results.read_catalogue(self.folder)


if __name__ == "__main__":
    unittest.main()
