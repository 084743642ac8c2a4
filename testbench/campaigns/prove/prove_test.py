#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The parts of `feltgate prove` that need no solver: the catalogue, options, traces, verdicts."""

import os
import shutil
import unittest
from unittest import mock

from testing import ROOT, Scratch, called
import prove
import rtl_sources
from proofs import catalog, record, results, tasks, tools, trace, unproven

TOML = """
[[proof]]
name = "p"
title = "t"
depth = 2
[proof.property.a]
says = "s"
defect = "d"
ports = "x_i y_o"
[proof.cover]
c = "reached"
"""
WRAPPER = "module p_proof; always_comb begin a: assert (1); c: cover (1); end endmodule\n"
RTL = """module b (
  input logic clk_i,
  input logic [3:0] x_i,
  output logic y_o
);
endmodule
"""


class Catalogue(Scratch):
    def setUp(self):
        super().setUp()
        self.put("testbench/wave/b/proofs/proofs.toml", TOML)
        self.put("testbench/wave/b/proofs/p.sv", WRAPPER)
        self.put("testbench/wave/b/defects.diff", "== d\nIt breaks.\n")
        self.put("rtl/core/wave/b.sv", RTL)

    def refused(self, *said):
        with self.assertRaises(catalog.CatalogError) as error:
            catalog.read(self.folder)
        for words in said:
            self.assertIn(words, str(error.exception))

    def test_a_good_one(self):
        (proof,) = catalog.read(self.folder)
        self.assertEqual((proof.key, proof.top, proof.depth), ("b.p", "p_proof", 2))
        self.assertEqual(catalog.open_ports(self.folder, [proof]), {"b": []})

    def test_a_port_in_no_property(self):
        self.put("rtl/core/wave/b.sv", RTL.replace("x_i,", "x_i,\n  input logic signed [2:0] z_i,"))
        self.assertEqual(catalog.open_ports(self.folder, catalog.read(self.folder)), {"b": ["z_i"]})

    def test_a_defect_for_proofs_alone(self):
        self.put("testbench/wave/b/defects.diff", "== d (proof)\nIt breaks.\n")
        (proof,) = catalog.read(self.folder)
        self.assertEqual(proof.properties[0].defect.name, "d")

    def test_what_is_wrong(self):
        for old, new, said in (
            ("property.a", "property.z", "no assertion 'z'"),
            ('"d"', '"e"', "no defect"),
            ("c = ", "e = ", "has the covers c"),
            ("depth = 2", "", "without 'depth'"),
            ('defect = "d"', "", "property 'a' without 'defect'"),
            ("depth = 2", "depth = 2\nspeed = 1", "unknown key speed"),
        ):
            with self.subTest(said):
                self.put("testbench/wave/b/proofs/proofs.toml", TOML.replace(old, new))
                self.refused("testbench/wave/b/proofs/proofs.toml", said)

    def test_an_assertion_that_nothing_is_said_of(self):
        self.put("testbench/wave/b/proofs/p.sv",
                   WRAPPER.replace("a: assert (1);", "a: assert (1); b: assert (1);"))
        self.refused("p.sv asserts b")
        self.put("testbench/wave/b/proofs/p.sv",
                   WRAPPER.replace("a: assert (1);", "a: assert (1); inside_b: assert (1);"))
        self.assertEqual(len(catalog.read(self.folder)), 1)


class Product(unittest.TestCase):
    def setUp(self):
        self.proofs = catalog.read(ROOT)

    def test_every_port_is_in_a_property_or_its_block_is_named(self):
        found = catalog.open_ports(ROOT, self.proofs)
        without = {block for block, names in found.items() if names}
        self.assertEqual(without, set(unproven.SOME_PORTS))
        # A block that is in a property by now is no longer one of which nothing is proven.
        self.assertEqual(found.keys() & unproven.BLOCKS.keys(), set())
        self.assertEqual(found.keys() | unproven.BLOCKS.keys(),
                         rtl_sources.module_files(ROOT).keys())

    def test_the_counts_on_record_are_of_the_proofs_as_they_are(self):
        self.assertEqual(results.counted(ROOT, self.proofs), [])

    def test_there_are_enough(self):
        self.assertGreaterEqual(sum(len(proof.properties) for proof in self.proofs), 200)

    def test_every_defect_applies_and_says_what_it_breaks(self):
        for patch in {entry.defect for proof in self.proofs for entry in proof.properties}:
            self.assertTrue(tools.patches.patched(patch, ROOT))


class Verdicts(unittest.TestCase):
    def test_a_row(self):
        proof = type("P", (), {"properties": [type("E", (), {"name": "a", "defect": "d"})]})
        good = tools.Result(True, 1.0)
        row = tasks.Row(proof, "lever", True)
        self.assertFalse(row.good(0))
        row.results = {tasks.BASE: good, tasks.INDUCTION: good, tasks.COVERS: good}
        self.assertTrue(row.good(0))
        self.assertFalse(row.good())  # no defect was tried
        row.caught = {"a": good}
        self.assertFalse(row.good())  # the assertion holds with its defect
        row.caught = {"a": tools.Result(False, 1.0)}
        self.assertTrue(row.good())

    def test_the_trace_ends_with_the_failing_clock(self):
        vcd = ("$scope module top $end\n$var wire 4 n0 x $end\n$scope module in $end\n"
               "$var wire 4 n1 y $end\n$upscope $end\n$upscope $end\n$enddefinitions $end\n"
               "#0\nb0001 n0\nb1111 n1\n#5\n#10\nb1000 n0\n#15\n#20\n")
        step, text = trace.table(trace.read(vcd), ())
        self.assertEqual(step, 1)
        self.assertEqual([line.split() for line in text.splitlines()],
                         [["clock", "0", "1"], ["x", "1", "-8"]])


class Recorded(Scratch):
    """What is on record as proven is what the proof reads, and nothing else."""

    def setUp(self):
        super().setUp()
        for name in ("rtl", "testbench/actuation/limiter", "testbench/campaigns/prove"):
            shutil.copytree(ROOT / name, self.folder / name)
        (self.folder / "docs/verification").mkdir(parents=True)
        rows = tasks.rows(self.proofs(), True)
        record.write(self.folder, rows, {"yosys": "1", "z3": "2"})

    def proofs(self):
        return [p for p in catalog.read(self.folder) if p.block == "limiter"]

    def known(self):
        return record.known(self.folder, self.proofs(), True)

    def change(self, name, old, new):
        text = (self.folder / name).read_text(encoding="utf-8")
        self.assertIn(old, text)
        self.put(name, text.replace(old, new, 1))

    def test_the_same_inputs_are_known(self):
        self.assertEqual(self.known(), self.proofs())
        self.change("rtl/core/actuation/limiter.sv", "module limiter", "// a comment\nmodule   limiter")
        self.assertEqual(self.known(), self.proofs())

    def test_a_change_of_any_input_is_seen(self):
        wrapper = self.proofs()[0].wrapper.relative_to(self.folder)
        for name, old, new in (
            ("rtl/core/actuation/limiter.sv", "endmodule", "logic more;\nendmodule"),
            ("rtl/generated/lever/feltgate_pkg.sv", "TORQUE_W = 21", "TORQUE_W = 22"),
            (wrapper, "endmodule", "logic more;\nendmodule"),
            ("testbench/actuation/limiter/proofs/proofs.toml", "depth = ", "depth = 1"),
        ):
            with self.subTest(name):
                before = (self.folder / name).read_text(encoding="utf-8")
                self.change(name, old, new)
                self.assertLess(len(self.known()), len(self.proofs()))
                self.put(name, before)

    def test_a_constant_that_nothing_names_does_not_count(self):
        package = "rtl/generated/lever/feltgate_pkg.sv"
        self.change(package, "endpackage", "  localparam int OF_AN_OPTION = 1;\nendpackage")
        self.assertEqual(self.known(), self.proofs())
        self.change("rtl/core/actuation/limiter.sv", "endmodule",
                    "localparam int X = feltgate_pkg::OF_AN_OPTION;\nendmodule")
        self.assertEqual(self.known(), [])

    def test_a_broken_record_is_refused_with_the_mend(self):
        for text in ("", "{", "[]", '{"schema": "another", "inputs": {}}', '{"inputs": {}}'):
            with self.subTest(text):
                self.put(record.FILE, text)
                with self.assertRaisesRegex(catalog.CatalogError, "proven.json.*--record"):
                    self.known()

    def test_the_record_is_of_proofs_that_there_are(self):
        names = {
            record.name(proof, design)
            for proof in catalog.read(ROOT)
            for design in proof.designs
        }
        self.assertEqual(record.read(ROOT).keys() - names, set())
        fast = {p.key for p in catalog.read(ROOT) if p.fast}
        self.assertEqual(fast - {n.split()[0] for n in record.read(ROOT)}, set())


class Command(Scratch):
    def status(self, *words):
        return called(prove.main, *words)

    def test_without_a_solver(self):
        self.enterContext(mock.patch.dict(os.environ, PATH="/nowhere"))
        status, _, err = self.status("limiter")
        self.assertEqual(status, 2)
        self.assertIn("no Yosys", err)


if __name__ == "__main__":
    unittest.main()
