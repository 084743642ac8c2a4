#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The parts of `feltgate synth` that need no tool: budget, wrappers, tables, critical paths."""

import copy
import unittest

from testing import ROOT, Scratch

import synth_budget
import synth_measure
import synth_path

ROW = {"lut4_equivalents": 200, "ff": 100, "mult18": 2, "bram": 1, "fmax_mhz": 150.0}
TOOLS = {"yosys": "yosys 0.70", "nextpnr": "nextpnr 0.11"}


class Budget(Scratch):
    def grown(self, **changes):
        budget = {"measured": TOOLS, "figures": {"lever": {"dob": ROW}}}
        return synth_budget.compare(budget, {"lever": {"dob": ROW | changes}}, TOOLS)

    def test_same_figures_pass(self):
        self.assertEqual(self.grown(), [])

    def test_each_figure_past_its_margin_fails(self):
        for key, within, past in (
            ("lut4_equivalents", 210, 211),
            ("ff", 107, 108),
            ("mult18", 2, 3),
            ("bram", 1, 2),
            ("fmax_mhz", 135.0, 134.9),
        ):
            with self.subTest(key):
                self.assertEqual(self.grown(**{key: within}), [])
                self.assertIn(key, self.grown(**{key: past})[0])

    def test_written_and_read_again(self):
        path = self.folder / "areas.json"
        measured = {"lever": {"core without read-back, inferred": ROW}}
        merged = synth_budget.merge(synth_budget.read(path), measured, TOOLS)
        synth_budget.write(path, merged)
        self.assertEqual(synth_budget.read(path), merged)
        # A later run of another row keeps this one.
        again = synth_budget.merge(synth_budget.read(path), {"lever": {"dob": ROW}}, TOOLS)
        self.assertEqual(set(again["figures"]["lever"]), {"dob", *measured["lever"]})


class Wrapper(unittest.TestCase):
    PORTS = [
        ("clk_i", "input", 1),
        ("rst_ni", "input", 1),
        ("x_i", "input", 4),
        ("y_o", "output", 3),
        ("tick_count_o", "output", 32),
    ]

    def test_open_ports_are_left_out(self):
        target = synth_measure.Target("core", "b", {"N": "1"}, open_ports=("tick_count_o",))
        area = synth_measure.area_top(target, self.PORTS)
        self.assertIn("output logic [2:0] y_o", area)
        self.assertNotIn("[31:0] tick_count_o", area)
        self.assertIn(".tick_count_o()", area)
        speed = synth_measure.speed_top(target, self.PORTS)
        self.assertIn("logic [3:0] in_q, in_q2;", speed)
        self.assertIn("logic [2:0] out, out_q, shift_q;", speed)
        self.assertIn("b #(.N(1)) u_dut", speed)

    def test_every_open_port_is_a_port_of_the_core(self):
        core = (ROOT / "rtl/core/feltgate_core.sv").read_text(encoding="utf-8")
        for port in synth_measure.SNAPSHOT_PORTS:
            self.assertRegex(core, rf"\boutput logic [^;]*\b{port}\b")


class CriticalPath(unittest.TestCase):
    NETLIST = {
        "cells": {
            "a": {"type": "TRELLIS_FF", "connections": {"Q": [5], "DI": [1]}},
            "b": {"type": "TRELLIS_FF", "connections": {"Q": [6], "DI": [2]}},
            "z_LUT4_Z_TRELLIS_FF_Q": {
                "type": "TRELLIS_FF",
                "connections": {"Q": [7]},
                "attributes": {"src": "scenes.sv:183.3-200.6|cells_map.v:73.1-73.9"},
            },
        },
        "netnames": {
            "u_dut.u_dob.sum_q": {"bits": [4, 5]},
            "u_dut.tau_o": {"bits": [3, 5]},
            "u_dut.y_q": {"bits": [6]},
            "u_dut.x_LUT4_Z": {"bits": [6]},
        },
    }

    def test_registers_by_the_names_of_the_rtl(self):
        names = synth_path.signal_names(copy.deepcopy(self.NETLIST))
        self.assertEqual(synth_path.cell_label("a", self.NETLIST, names), "u_dob.sum_q[1]")
        self.assertEqual(synth_path.cell_label("b", self.NETLIST, names), "y_q")
        # A name made up from a neighbour's says nothing: the place in the source does.
        label = synth_path.cell_label("z_LUT4_Z_TRELLIS_FF_Q", self.NETLIST, names)
        self.assertEqual(label, "scenes.sv:183")


if __name__ == "__main__":
    unittest.main()
