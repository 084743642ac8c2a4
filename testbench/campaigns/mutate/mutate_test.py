#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The parts of `feltgate mutate` that need no test program: netlist, proofs, reasons, figures."""

import contextlib
import io
import json
import os
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from testing import Scratch, called
import mutate
from crew import Crew
from mutation import equivalence, netlist, rtl, rtl_table

# dead_q stays 0, so that what it adds is no matter; spare is what a mutant of the word must change.
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
LINE = ("mutate -mode cnot1 -module b -cell $add$rtl/b.sv:2$1 -port Y -portbit 3 -ctrlbit 1 "
        "-wire w -wirebit 2 -src rtl/b.sv:2.1-2.9 -src rtl/b.sv:1.1-1.4")


@unittest.skipUnless(shutil.which("yosys") and shutil.which("yosys-abc"), "no yosys")
class Netlist(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (cls.root / "rtl").mkdir()
        (cls.root / "rtl/counter.sv").write_text(COUNTER, encoding="utf-8")
        cls.folder = cls.root / "with a blank"
        netlist.write("counter", [Path("rtl/counter.sv")], [], 1000, 1, cls.folder / "counter.sv",
                      cls.root)
        cls.found = json.loads((cls.folder / "mutants.json").read_text(encoding="utf-8"))
        cls.mutants = cls.found["mutants"]

    def mutant(self, **wanted):
        return next(m for m in self.mutants if all(m.get(k) == v for k, v in wanted.items()))

    def verdicts(self, *mutants):
        with tempfile.TemporaryDirectory() as work:
            design = equivalence.Joined(self.folder, "counter", list(mutants), Path(work), Crew())
            return [design.prove(m, 10)[0] for m in mutants]

    def test_a_value_at_power_up_stays(self):
        text = (self.folder / "counter.sv").read_text(encoding="utf-8")
        self.assertRegex(text, r"reg kept_q = 1'h1;")
        self.assertFalse([m for m in self.mutants if m.get("wire") == "kept_q"
                          and m["port"] == "Q"])

    def test_the_same_seed_gives_the_same_mutants(self):
        other = self.root / "again"
        netlist.write("counter", [Path("rtl/counter.sv")], [], 1000, 1, other / "counter.sv",
                      self.root)
        self.assertEqual((other / "mutants.json").read_text(),
                         (self.folder / "mutants.json").read_text())

    def test_different(self):
        count = self.mutant(type="$adffe", port="Q")
        self.assertEqual(self.verdicts(count), [equivalence.DIFFERENT])

    def test_none_is_equivalent(self):
        count = dict(self.mutant(type="$adffe", port="Q"))
        with tempfile.TemporaryDirectory() as work:
            design = equivalence.Joined(self.folder, "counter", [count], Path(work), Crew())
            design.numbers[count["number"]] = 0
            self.assertEqual(design.prove(count, 10)[0], equivalence.EQUIVALENT)

    def test_stuck_where_it_is_constant_is_equivalent(self):
        # Of count_o + 1, the operand 1.
        adder = next(m for m in self.mutants if m["type"] == "$add")
        same = adder | {"port": "B", "bit": 0, "mode": "const1"}
        same.pop("by_bit", None)
        self.assertEqual(self.verdicts(same), [equivalence.EQUIVALENT])

    def test_a_memory_with_another_clock_is_refused(self):
        text = (self.folder / "block.il").read_text(encoding="utf-8")
        for old, new in (("RD_CLK_ENABLE 1'0", "RD_CLK_ENABLE 1'1"),
                         ("WR_CLK_ENABLE 1'1", "WR_CLK_ENABLE 1'0"),
                         (r"WR_CLK \clk_i", "WR_CLK $and$1")):
            self.assertIn(old, text)
            with self.assertRaisesRegex(netlist.NetlistError, "memory words"):
                equivalence.without_memories(text.replace(old, new))

    def test_a_mutant_at_a_memory(self):
        read = self.mutant(type="$mem_v2", port="RD_DATA", mode="inv")
        wrote = self.mutant(type="$mem_v2", port="WR_DATA")
        count = self.mutant(type="$adffe", port="Q")
        self.assertEqual(self.verdicts(read, count, wrote), 3 * [equivalence.DIFFERENT])

    def test_a_pin_of_a_memory_stuck_where_it_is_constant_is_equivalent(self):
        # The upper bit of what is written is made a constant 0.
        text = (self.folder / "block.il").read_text(encoding="utf-8")
        data = re.search(r"connect \\WR_DATA (\S+)", text).group(1)
        (self.folder / "block.il").write_text(
            text.replace(f"connect \\WR_DATA {data}", f"connect \\WR_DATA {{ 1'0 {data} [2:0] }}"),
            encoding="utf-8")
        self.addCleanup((self.folder / "block.il").write_text, text, encoding="utf-8")
        wrote = self.mutant(type="$mem_v2", port="WR_DATA")
        wrote = {k: v for k, v in wrote.items() if k != "by_bit"} | {"mode": "const0"}
        verdicts = self.verdicts(wrote | {"bit": 3}, wrote | {"bit": 2, "number": 9999})
        self.assertEqual(verdicts, [equivalence.EQUIVALENT, equivalence.DIFFERENT])


@unittest.skipUnless(shutil.which("yosys") and shutil.which("yosys-abc"), "no yosys")
class OfItsOwn(unittest.TestCase):
    """A block whose child, with a memory in it, is measured by itself."""

    @classmethod
    def setUpClass(cls):
        root = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (root / "rtl").mkdir()
        for name, text in (("counter", COUNTER), ("pair", PAIR)):
            (root / f"rtl/{name}.sv").write_text(text, encoding="utf-8")
        cls.folder = root / "own"
        sources = [Path("rtl/counter.sv"), Path("rtl/pair.sv")]
        netlist.write("pair", sources, [], 1000, 1, cls.folder / "pair.sv", root, own=True)
        cls.test = rtl.Test("pair", "pair", cls.folder, cls.folder / "pair")
        cls.test.read()

    def test_only_its_own_cells_and_the_pins_of_its_child_change(self):
        self.assertLess(self.test.database, 100)
        types = {m["type"] for m in self.test.mutants}
        self.assertEqual(types, {"$logic_not", "$logic_and", "u_counter"})
        pins = {m["port"] for m in self.test.mutants if m["type"] == "u_counter"}
        self.assertTrue({"count_o"} <= pins <= {"rst_ni", "up_i", "count_o", "kept_o"})

    def test_pins_of_the_child_are_proven_with_its_memory_cut_out(self):
        pin = next(m for m in self.test.mutants if m["type"] == "u_counter")
        pin = {k: v for k, v in pin.items() if k != "by_bit"} | {"port": "rst_ni", "bit": 0}
        same, other = (pin | {"mode": f"const{n}", "number": 2 - n} for n in (1, 0))
        with tempfile.TemporaryDirectory() as work:
            design = self.test.joined([same, other], Path(work), Crew())
            self.assertIn("memory_1_RD_DATA", design.blif)
            found = [design.prove(m, 10)[0] for m in (same, other)]
        self.assertEqual(found, [equivalence.EQUIVALENT, equivalence.DIFFERENT])


class Reasons(Scratch):
    def setUp(self):
        super().setUp()
        self.put("rtl/b.sv", "one\n  assign w = a + 1;\n")
        self.mutant = netlist.parse(LINE, {"$add$rtl/b.sv:2$1": ("$add", "")}) | {"number": 1}

    def listed(self, text):
        self.put(rtl.LISTED, text)
        return rtl.Listed(self.folder, "b")

    def test_every_key_must_fit(self):
        whole = ('[[b]]\nline = "w = a + 1"\nwire = "w"\npin = "[$]add[.]Y"\nbits = [3]\n'
                 'modes = ["cnot1"]\nkind = "gap"\nwhy = "x"\n')
        self.assertEqual(self.listed(whole).entry(self.mutant), ("gap", "x"))
        for key, other in (("w = a", "v = a"), ('wire = "w"', 'wire = "v"'), ("add", "sub"),
                           ("[3]", "[2]"), ("cnot1", "inv")):
            self.assertEqual(self.listed(whole.replace(key, other)).entry(self.mutant), ("", ""))

    def test_figures(self):
        test = rtl.Test("b", "b", self.folder, self.folder / "b_mutants", 1, 100,
                        [self.mutant | {"number": n} for n in range(1, 6)])
        gap = '[[b]]\nline = "w = a"\nkind = "gap"\nwhy = "seen"\n'
        row = rtl.Row(test, self.listed(gap))
        row.fates = {1: rtl.KILLED, 2: rtl.HANGS, 3: rtl.SURVIVES, 4: rtl.SURVIVES, 5: rtl.KILLED}
        row.proofs = {3: (equivalence.EQUIVALENT, ""),
                      4: (equivalence.DIFFERENT, "differs in clock 2")}
        self.assertEqual((row.equivalent(), row.relevant(), row.of(rtl.GAP), row.share()),
                         (1, 4, 1, 0.75))
        row.listed = self.listed(gap.replace("gap", "equivalent"))
        self.assertEqual((row.relevant(), row.of(rtl.ARGUED), row.share()), (3, 1, 1.0))
        row.listed = self.listed(gap)
        self.assertIn("75.0 %", rtl_table.table([row]))
        said = row.as_json()
        self.assertEqual((said["killed"], said["hangs"], len(said["survivors"])), (3, 1, 1))
        with contextlib.redirect_stdout(io.StringIO()) as output:
            rtl_table.print_survivors([row], False)
        self.assertEqual(output.getvalue(), "")

    def test_an_unproven_survivor_counts_against_the_test(self):
        test = rtl.Test("b", "b", self.folder, self.folder / "b_mutants", 1, 100, [self.mutant])
        row = rtl.Row(test, self.listed(""), {1: rtl.SURVIVES}, {1: (equivalence.UNKNOWN, "")})
        self.assertEqual((row.share(), len(row.survivors())), (0.0, 1))


class Programs(Scratch):
    """Stands in for a test program: a script that looks at FELTGATE_MUTANT."""

    def setUp(self):
        super().setUp()
        folder = "testbench/wave/b/b_mutants.netlist"
        self.put(f"{folder}/test.json", '{"test": "b", "block": "b"}')
        mutants = [netlist.parse(LINE, {}) | {"number": n} for n in range(1, 5)]
        found = {"block": "b", "seed": 1, "own": False, "database": 9, "mutants": mutants}
        self.put(f"{folder}/mutants.json", json.dumps(found))
        self.say("case $FELTGATE_MUTANT in 0|4) exit 0;; 3) kill -SEGV $$;; "
                 "*) echo mismatch at clock 3; exit 1;; esac")

    def say(self, script):
        self.program = self.put_program("testbench/wave/b/b_mutants", script)

    def call(self, *arguments):
        os.environ["FELTGATE_BUILD"] = str(self.folder)
        return called(mutate.main, "--no-build", "--proof-seconds", "0", *arguments)

    def test_fates(self):
        code, out, _ = self.call("--json", str(self.folder / "out.json"))
        self.assertEqual(code, 1)
        self.assertIn("3 of 4 not equivalent ones killed (75.0 %); 1 tests below 99 %: b", out)
        self.assertIn("b 4: bit 3 of", out)
        (entry,) = json.loads((self.folder / "out.json").read_text())["tests"]
        self.assertEqual((entry["killed"], entry["crashes"]), (3, 1))

    def test_what_survived_again(self):
        results = self.folder / "out.json"
        self.call("--json", str(results))
        self.assertIn("3 of 4 not", self.call("--again", str(results))[1])
        # Only the survivor is tried: a program that kills nothing else now changes nothing else.
        self.say('[ "$FELTGATE_MUTANT" != 4 ]')
        code, out, _ = self.call("--again", str(results))
        self.assertEqual(code, 0)
        self.assertIn("4 of 4 not equivalent ones killed (100.0 %)", out)

    def test_results_of_other_mutants_are_refused(self):
        results = self.folder / "out.json"
        self.call("--json", str(results))
        found = json.loads(results.read_text())
        for change, says in (({"tests": []}, "no run of all mutants of b as they are now"),
                             ({"tests": [found["tests"][0] | {"database": 99}]}, "no run of all"),
                             ({"tests": [{"test": "b"}]}, "it has no 'seed'; give such a file"),
                             ({"schema": "other/1"}, "its schema is not"),
                             (None, "no results of")):
            results.write_text(json.dumps(found | change if change else []))
            code, _, err = self.call("--again", str(results))
            self.assertEqual((code, says in err), (2, True), err)

    def test_the_required_share(self):
        self.assertEqual(self.call("--require", "0.7")[0], 0)

    def test_a_share_is_the_same_again(self):
        self.assertEqual(self.call("--count", "2", "--seed", "5")[1],
                         self.call("--count", "2", "--seed", "5")[1])

    def test_a_program_that_fails_without_a_mutant(self):
        self.say("exit 1")
        code, _, err = self.call()
        self.assertEqual(code, 2)
        self.assertIn("b_mutants killed without a mutant", err)

    def test_what_is_unknown(self):
        self.assertIn("no block c with mutants; there are b", self.call("c")[2])
        self.assertEqual([self.call(*w)[0] for w in (["c"], ["--show", "9"])], [2, 2])
        self.folder = self.folder / "none"  # the file is looked at before the build folder
        self.assertIn("/nonexist: no results of", self.call("--again", "/nonexist")[2])

    def test_options_that_mean_nothing(self):
        for words in (["--require", "99"], ["--require", "nan"], ["--count", "-1"],
                      ["--proof-seconds", "-1"], ["--update", "--count", "2"],
                      ["--list", "--update"], ["--update", "--proof-seconds", "0"],
                      ["--show", "1", "--json", "x"],
                      ["--again", str(Path(__file__)), "--count", "2"], ["--list", "--show", "0"]):
            with self.subTest(words):
                self.assertEqual(called(mutate.arguments, *words)[0], 2)

    def test_a_test_may_have_the_name_of_its_block(self):
        one, other = (rtl.Test(name, "b", self.folder, self.program) for name in ("b", "b_paper"))
        for words, found in (([], [one, other]), (["b"], [one, other]), (["b.b"], [one]),
                             (["b_paper"], [other])):
            self.assertEqual(mutate.chosen([one, other], words), found)

    def test_a_row_of_the_table_is_of_all_tests_of_the_block(self):
        one, other = (rtl.Test(name, "b", self.folder, self.program) for name in ("b", "b_paper"))
        mutate.check_whole([one, other], [one, other])
        with self.assertRaisesRegex(rtl.MutateError, "b_paper is left out"):
            mutate.check_whole([one, other], [one])

    def test_a_test_that_somebody_else_ended_kills_nothing(self):
        self.say('[ "$FELTGATE_MUTANT" = 0 ] || kill -TERM $$')
        self.assertEqual(self.call()[0], 128 + 15)

    def test_show(self):
        code, out, _ = self.call("--show", "1")
        self.assertEqual(code, 0)
        self.assertIn("killed in", out)
        self.assertIn("mismatch at clock 3", out)


if __name__ == "__main__":
    unittest.main()
