#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""`feltgate mutate` of the RTL: the netlist with its mutants, and the command with a stand-in for a test."""

import json
import os
import re
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from testing import Scratch, called
import block_results
import mutate
from mutation import netlist, runs

COUNTER = """module counter (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       up_i,
  output logic [3:0] count_o,
  output logic       kept_o
);
  logic kept_q = 1'b1;
  logic [3:0] words [0:3];
  logic [3:0] read_q;
  always_ff @(posedge clk_i) begin
    if (up_i) words[count_o[1:0]] <= count_o;
    read_q <= words[~count_o[1:0]];
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) count_o <= 4'd0;
    else if (up_i) count_o <= count_o + 4'd1;
  end
  always_ff @(posedge clk_i) if (up_i) kept_q <= !kept_q;
  assign kept_o = kept_q ^ (read_q == 4'd3);
endmodule
"""
PAIR = """module pair (
  input  logic       clk_i,
  input  logic       up_i,
  input  logic       halt_i,
  output logic [3:0] count_o,
  output logic       kept_o
);
  logic up;
  assign up = up_i && !halt_i;
  counter u_counter (.clk_i(clk_i), .rst_ni(1'b1), .up_i(up), .count_o(count_o), .kept_o(kept_o));
endmodule
"""


@unittest.skipUnless(shutil.which("yosys"), "no yosys")
class Netlist(unittest.TestCase):
    def written(self, top, own=False):
        """(text, mutants) of a block, in a folder with a blank."""
        root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (root / "rtl").mkdir()
        for name, text in (("counter", COUNTER), ("pair", PAIR)):
            (root / f"rtl/{name}.sv").write_text(text, encoding="utf-8")
        sources = [Path(f"rtl/{name}.sv") for name in ("counter", "pair")[: 1 + (top == "pair")]]
        folder = root / "with a blank"
        netlist.write(top, sources, [], 1000, 1, folder / f"{top}.sv", root, own)
        text = (folder / f"{top}.sv").read_text(encoding="utf-8")
        return text, json.loads((folder / "mutants.json").read_text(encoding="utf-8"))

    def test_the_netlist_has_the_ports_of_the_block_and_its_mutants(self):
        text, mutants = self.written("counter")
        self.assertEqual(re.findall(r"^module (\w+)", text, re.M), ["counter", "counter_mutants"])
        self.assertIn("feltgate_chosen_mutant()", text)
        self.assertGreater(len(mutants), 50)
        self.assertEqual([m["number"] for m in mutants], list(range(1, len(mutants) + 1)))
        self.assertEqual(self.written("counter")[1], mutants)
        pins = {re.search(r"of \S+[.](\w+)", m["what"])[1] for m in mutants}
        self.assertFalse(pins & set(netlist.LEFT_OUT))
        self.assertTrue(all(re.fullmatch(r"rtl/counter.sv:\d+", w) for m in mutants for w in m["where"]))

    def test_a_value_at_power_up_stays(self):
        text, mutants = self.written("counter")
        self.assertIn("reg kept_q = 1'h1;", text)
        self.assertFalse([m for m in mutants if "Q, kept_q" in m["what"]])

    def test_only_its_own_cells_and_the_pins_of_its_child_change(self):
        text, mutants = self.written("pair", own=True)
        self.assertEqual(re.findall(r"^module (\w+)", text, re.M), ["pair", "pair_mutants"])
        cells = {re.search(r"of (\S+)[.]\w+", m["what"])[1] for m in mutants}
        self.assertEqual(cells, {"$logic_not", "$logic_and", "u_counter"})


class Command(Scratch):
    """The test program is a script that looks at FELTGATE_MUTANT."""

    def setUp(self):
        super().setUp()
        folder = "testbench/wave/b/b_mutants.netlist"
        self.put(f"{folder}/test.json", '{"test": "b_test", "block": "b"}')
        mutants = [{"number": n, "what": "w", "where": ["rtl/b.sv:2"]} for n in range(1, 5)]
        self.put(f"{folder}/mutants.json", json.dumps(mutants))
        self.put("rtl/b.sv", "module b;\n  assign w = a;\n")
        self.say("case $FELTGATE_MUTANT in 0|4) exit 0;; 3) kill -SEGV $$;; *) exit 1;; esac")

    def say(self, script):
        self.put_program("testbench/wave/b/b_mutants", script)

    def record(self, killed, tried):
        block_results.write(self.folder, "mutants", "measured", {"b": {"rtl": [killed, tried]}})

    def call(self, *arguments):
        places = {"FELTGATE_BUILD": str(self.folder), "FELTGATE_ROOT": str(self.folder)}
        with mock.patch.dict(os.environ, places):
            return called(mutate.main, "--no-build", *arguments)

    def test_a_survivor_is_printed_and_the_share_must_be_that_of_the_record(self):
        self.record(76, 100)
        code, out, _ = self.call("--json", str(self.folder / "out.json"))
        self.assertEqual(code, 1)
        self.assertIn("b_test 4 survives: w\n    rtl/b.sv:2: assign w = a;\n    FELTGATE_MUTANT=4 ", out)
        self.assertIn("4 mutants; below their least share: b", out)
        (row,) = json.loads((self.folder / "out.json").read_text())["rows"]
        self.assertEqual((row["killed"], row["crashes"], row["killed_share"]), (2, 1, 0.75))
        self.record(759, 1000)  # whole percents
        self.assertEqual(self.call()[0], 0)
        self.assertEqual(self.call("--require", "0.76")[0], 1)

    def test_without_a_record_there_is_a_least_share_too(self):
        self.assertEqual(self.call()[0], 1)

    def test_a_record_only_rises(self):
        self.record(76, 100)
        code, _, err = self.call("--update")
        self.assertEqual((code, "less killed than the record has: b" in err), (2, True))
        self.say('[ "$FELTGATE_MUTANT" = 0 ]')
        self.assertEqual(self.call("b", "--update")[0], 0)
        self.assertEqual(block_results.read(self.folder, "mutants")["blocks"]["b"]["rtl"], [4, 4])

    def test_a_sample_may_be_worse_by_chance(self):
        row = runs.Row("b", 400, [runs.Verdict(None, None, runs.KILLED, 0.0)] * 40, 0.9)
        self.assertAlmostEqual(row.limit(), 0.765, 3)
        row.offered = 40
        self.assertEqual(row.limit(), 0.9)

    def test_what_hangs_is_dead(self):
        self.say("case $FELTGATE_MUTANT in 0) exit 0;; 1) while :; do :; done;; esac; exit 1")
        with mock.patch.object(runs, "MORE_S", 0.5):
            self.assertRegex(self.call()[1], r"b +4 +4 +3 +0 +1 +100.0 %")

    def test_a_test_that_fails_without_a_mutant_kills_nothing(self):
        self.say("exit 1")
        code, _, err = self.call()
        self.assertEqual((code, "killed without a mutant" in err), (2, True))

    def test_a_test_that_somebody_else_ended_kills_nothing(self):
        self.say('[ "$FELTGATE_MUTANT" = 0 ] || kill -TERM $$')
        self.assertEqual(self.call()[0], 128 + 15)


if __name__ == "__main__":
    unittest.main()
