#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The parts of `feltgate coverage` that need no simulation: cover points that fit their blocks, data,
waivers, the change of Verilator's code, verdicts."""

import json
import os
import re
import unittest
from pathlib import Path
from unittest import mock

from testing import ROOT, Scratch, called, ran
import block_results
import coverage
import rtl_sources
from rtl_coverage import data, instrument, programs, report, waivers

HEAD = "# SystemC::Coverage-3\n"


def entry(page, name, count, line=3, where="TOP.b", file="rtl/b.sv"):
    pairs = {"f": f"/r/{file}", "l": line, "n": 5, "page": f"v_{page}/b", "o": name, "h": where}
    return "C '" + "".join(f"\x01{k}\x02{v}" for k, v in pairs.items()) + f"' {count}\n"


class Points(Scratch):
    def test_the_signals_of_all_points_are_there(self):
        points = sorted(ROOT.glob(f"{data.POINTS}*.sv"))
        text = "".join(path.read_text(encoding="utf-8") for path in points)
        blocks = re.findall(r"^module (\w+)_cover\b", text, re.M)
        self.assertGreater(len(blocks), 10)
        quiet = ("-Wno-SYNCASYNCNET", "-Wno-UNUSEDSIGNAL", "-Wno-MULTITOP", "-Wno-DECLFILENAME")
        rtl = [ROOT / "rtl" / name for name in rtl_sources.core_files(ROOT)]
        for design in ("lever", "paper"):
            self.ended(ran("verilator", "--lint-only", "--coverage", "-Wall", *quiet, "--top-module",
                           rtl_sources.CORE, *(f"-DCOVER_{block}" for block in blocks),
                           ROOT / "testbench/campaigns/coverage/coverage.vlt",
                           ROOT / f"rtl/generated/{design}/feltgate_pkg.sv", *rtl, *points))


class Data(Scratch):
    def read(self, *entries):
        return data.read(Path("/r"), self.put("a.dat", HEAD + "".join(entries)))

    def test_each_bit_counts_for_itself(self):
        # verilator_coverage takes the column for covered as one bit of it is.
        points = data.merged([self.read(entry("toggle", "x[0]", 9), entry("toggle", "x[1]", 0))])
        self.assertEqual({p.name: n for p, n in points.items()}, {"x[0]": 9, "x[1]": 0})

    def test_instances_add_up_but_for_the_core(self):
        counts = [self.read(entry("line", "block", 0, where="TOP.c.u1"),
                            entry("line", "block", 2, where="TOP.c.u2"))]
        self.assertEqual(list(data.merged(counts).values()), [2])
        self.assertEqual(sorted(data.instances(counts).values()), [0, 2])


class Waivers(Scratch):
    GOOD = {"block": "b", "kind": "toggle", "points": "x\\\\[1\\\\]", "most": 1,
            "reason": "its bit is never set, by the format"}

    def write(self, *tables):
        quoted = [{k: f'"{v}"' if isinstance(v, str) else v for k, v in t.items()} for t in tables]
        lines = [["[[waiver]]", *(f"{k} = {v}" for k, v in t.items()), ""] for t in quoted]
        self.put(waivers.FILE, "\n".join(line for table in lines for line in table))
        return waivers.read(self.folder)

    def test_fits_the_whole_name_of_its_block_and_kind(self):
        (waiver,) = self.write(self.GOOD)
        point = data.Point("b", "toggle", "rtl/b.sv", 3, 5, "x[1]")
        self.assertTrue(waiver.fits(point))
        self.assertTrue(self.write(self.GOOD | {"block": "a b"})[0].fits(point))
        for other in ({"name": "x[12]"}, {"block": "c"}, {"kind": "line"}):
            self.assertFalse(waiver.fits(data.Point(**{**point.__dict__, **other})), other)
        self.assertEqual(waivers.take([waiver], [point]), [])
        self.assertEqual(waivers.take([waiver], [point]), [point])  # one more than it may
        self.assertEqual(waiver.used, [point])

    def test_those_of_the_product(self):
        self.assertLessEqual(len(waivers.read(ROOT)), waivers.MOST)


class Report(unittest.TestCase):
    def made(self, counts, waived=()):
        points = {data.Point("b", kind, "rtl/b.sv", n, 1, "p"): count
                  for n, (kind, count) in enumerate(counts)}
        return report.make(points, {}, {"b": 1.5}, list(waived), ["b"])

    def test_targets(self):
        for counts, short in (
            ([("line", 1), ("toggle", 2), ("cover", 1)], []),
            ([("line", 0)], ["line"]),
            ([("branch", 0)], ["branch"]),
            ([("cover", 0)], ["cover"]),
            ([("toggle", 1)], ["toggle"]),
            ([("toggle", 2)] * 98 + [("toggle", 1)] * 2, []),
            ([("toggle", 2)] * 97 + [("toggle", 1)] * 3, ["toggle"]),
        ):
            with self.subTest(short=short):
                self.assertEqual(self.made(counts).rows[0].short(), short)


class Instrument(unittest.TestCase):
    FILES = {
        "Vb.cpp": "Vb::Vb() : rst_ni{x} {}\nvoid Vb::eval_step() {\n"
                  "    if (VL_UNLIKELY(!vlSymsp->__Vm_didInit)) {\n    }\n}\n",
        "Vb__Syms.h": "    std::atomic<uint32_t> __Vcoverage[2];\n",
        "Vb_1.cpp": 'a->__vlCoverInsert(&(vlSymsp->__Vcoverage[0]), first, "b.sv", 1, 2, ".b", '
                    '"v_toggle/b", "x", "");\n'
                    'a->__vlCoverInsert(&(vlSymsp->__Vcoverage[1]), first, "b.sv", 1, 2, ".b", '
                    '"v_line/b", "block", "");\n'
                    "vlSymsp->__Vcoverage[0].fetch_add(1, std::memory_order_relaxed);\n"
                    "vlSymsp->__Vcoverage[1].fetch_add(1, std::memory_order_relaxed);\n",
    }

    def test_toggles_wait_for_the_reset_lines_do_not(self):
        text = instrument.changed(self.FILES, "Vb")
        self.assertIn("__Vcoverage[0] += vlSymsp->coverage_toggles;", text["Vb_1.cpp"])
        self.assertIn("__Vcoverage[1] += 1;", text["Vb_1.cpp"])
        self.assertIn("static inline uint32_t __Vcoverage[2];", text["Vb__Syms.h"])
        self.assertIn("this->rst_ni", text["Vb.cpp"])

    def test_another_verilator(self):
        for file, old, new in (("Vb.cpp", "eval_step", "step"), ("Vb_1.cpp", "(1,", "(2,"),
                               ("Vb__Syms.h", "__Vcoverage", "counts"),
                               ("Vb_1.cpp", "v_toggle", "v_bit")):
            with self.subTest(file), self.assertRaises(instrument.InstrumentError):
                instrument.changed(self.FILES | {file: self.FILES[file].replace(old, new)}, "Vb")


class Command(Scratch):
    """With a stand-in for the tests, which writes what it is told."""

    def setUp(self):
        super().setUp()
        self.put(waivers.FILE, "")
        places = dict.fromkeys(("FELTGATE_ROOT", "FELTGATE_BUILD"), str(self.folder))
        self.enterContext(mock.patch.dict(os.environ, places))
        self.put("build.ninja", "")
        self.program_is("exit 0")

    def program_is(self, *lines):
        path = self.put_program("b_cover", "\n".join(lines))
        self.put(programs.LIST, f"b b {path}\n")

    def counting(self, count):
        self.put("data",
                 (HEAD + entry("line", "block", count)).replace("/r/", f"{self.folder}/"))
        self.program_is(f'cp "{self.folder}/data" "$FELTGATE_COVERAGE"')

    def status(self, *words):
        return called(coverage.main, "--no-build", *words)

    def test_all_is_reached(self):
        self.counting(1)
        status, out, err = self.status("--json", f"{self.folder}/j")
        self.assertEqual((status, err), (0, ""))
        self.assertIn("1 blocks, 0 short of a target", out)
        found = json.loads((self.folder / "j").read_text(encoding="utf-8"))
        self.assertEqual((found["schema"], found["not_reached"]), (coverage.SCHEMA, []))

    def test_a_line_is_not(self):
        self.counting(0)
        status, out, _ = self.status()
        self.assertEqual(status, 1)
        self.assertIn("rtl/b.sv:3: line block", out)

    def test_a_waiver_of_no_use(self):
        self.counting(1)
        self.put(waivers.FILE,
                 '[[waiver]]\nblock="b"\nkind="line"\npoints="x"\nmost=1\n'
                 'reason="a line that is not there"\n')
        status, out, _ = self.status()
        self.assertEqual(status, 1)
        self.assertIn("waives nothing; delete it", out)

    def test_tests_that_fail(self):
        for lines, said in ((["echo a difference", "exit 3"], "a difference"),
                            (["exit 0"], "wrote no coverage data")):
            with self.subTest(said):
                self.program_is(*lines)
                status, _, err = self.status()
                self.assertEqual(status, 2)
                self.assertIn(said, err)

    def test_rows_of_some_blocks_are_put_beside_the_others(self):
        self.put("rtl/b.sv", "module b;\nendmodule\n")
        self.put("rtl/c.sv", "module c;\nendmodule\n")
        block_results.write(self.folder, "coverage", "earlier", {"c": {"line": [3, 3]}})
        self.counting(0)
        self.assertEqual(self.status("--update", "b")[0], 1)
        self.assertEqual(list(block_results.read(self.folder, "coverage")["blocks"]), ["c"])
        self.counting(1)
        self.assertEqual(self.status("--update", "b")[0], 0)
        found = block_results.read(self.folder, "coverage")["blocks"]
        self.assertEqual((found["b"]["line"], found["c"]["line"]), ([1, 1], [3, 3]))


if __name__ == "__main__":
    unittest.main()
