#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What judges the tests, without a campaign: when coverage, mutants, proofs and faults are not good
enough; and that cover points, proofs and their records are of the RTL as it is. docs/testing.md"""

import json
import os
import re
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from testing import ROOT, Scratch, called, ran
import faults
import mutate
import rtl_sources
from fault_campaign import results as fault_results
from mutation import netlist, runs
from proofs import catalog, record, tasks, tools
from rtl_coverage import data, report, waivers


class Coverage(Scratch):
    def test_the_signals_of_all_points_are_there(self):
        points = sorted(ROOT.glob(f"{data.POINTS}*.sv"))
        text = "".join(path.read_text(encoding="utf-8") for path in points)
        blocks = re.findall(r"^module (\w+)_cover\b", text, re.M)
        self.assertGreater(len(blocks), 3)
        quiet = ("-Wno-SYNCASYNCNET", "-Wno-UNUSEDSIGNAL", "-Wno-MULTITOP", "-Wno-DECLFILENAME")
        rtl = [ROOT / "rtl" / name for name in rtl_sources.core_files(ROOT)]
        for design in ("lever", "paper"):
            self.ended(ran("verilator", "--lint-only", "--coverage", "-Wall", *quiet, "--top-module",
                           rtl_sources.CORE, *(f"-DCOVER_{block}" for block in blocks),
                           ROOT / "testbench/campaigns/coverage/coverage.vlt",
                           ROOT / f"rtl/generated/{design}/cfg.sv", *rtl, *points))

    def test_each_bit_counts_for_itself(self):
        # verilator_coverage takes the column for covered as one bit of it is.
        def entry(name, count):
            pairs = {"f": "/r/rtl/b.sv", "l": 3, "n": 5, "page": "v_toggle/b", "o": name, "h": "TOP.b"}
            return "C '" + "".join(f"\x01{k}\x02{v}" for k, v in pairs.items()) + f"' {count}\n"

        file = self.put("a.dat", "# SystemC::Coverage-3\n" + entry("x[0]", 9) + entry("x[1]", 0))
        points = data.merged([data.read(Path("/r"), file)])
        self.assertEqual({p.name: n for p, n in points.items()}, {"x[0]": 9, "x[1]": 0})

    def test_targets(self):
        for counts, short in (([("line", 1), ("toggle", 2), ("cover", 1)], []),
                              ([("line", 0)], ["line"]), ([("branch", 0)], ["branch"]),
                              ([("cover", 0)], ["cover"]), ([("toggle", 1)], ["toggle"]),
                              ([("toggle", 2)] * 98 + [("toggle", 1)] * 2, []),
                              ([("toggle", 2)] * 97 + [("toggle", 1)] * 3, ["toggle"])):
            points = {data.Point("b", kind, "rtl/b.sv", n, 1, "p"): count
                      for n, (kind, count) in enumerate(counts)}
            self.assertEqual(report.make(points, {}, {}, [], ["b"]).rows[0].short(), short)

    def test_a_waiver_takes_so_many_points_and_no_more(self):
        waiver = waivers.Waiver("b", "line", re.compile("p"), 1, "its reason")
        missed = [data.Point("b", "line", "rtl/b.sv", n, 1, "p") for n in range(2)]
        self.assertEqual(waivers.take([waiver], missed), missed[1:])
        self.assertLessEqual(len(waivers.read(ROOT)), waivers.MOST)


COUNTER = """module counter (
  input logic clk_i,
  input logic rst_ni,
  input logic up_i,
  output logic [3:0] count_o,
  output logic kept_o
);
  logic kept_q = 1'b1;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) count_o <= 4'd0;
    else if (up_i) count_o <= count_o + 4'd1;
  end
  always_ff @(posedge clk_i) if (up_i) kept_q <= !kept_q;
  assign kept_o = kept_q;
endmodule
"""


class Mutants(Scratch):
    """Of RTL; the test program is a script that looks at FELTGATE_MUTANT."""

    @unittest.skipUnless(shutil.which("yosys"), "no yosys")
    def test_the_netlist_has_the_ports_of_the_block_and_its_mutants(self):
        root = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="with a blank ")))
        (root / "rtl").mkdir()
        (root / "rtl/counter.sv").write_text(COUNTER, encoding="utf-8")
        netlist.write("counter", [Path("rtl/counter.sv")], [], 1000, 1, root / "out/counter.sv", root)
        text = (root / "out/counter.sv").read_text(encoding="utf-8")
        mutants = json.loads((root / "out/mutants.json").read_text(encoding="utf-8"))
        self.assertEqual(re.findall(r"^module (\w+)", text, re.M), ["counter", "counter_mutants"])
        self.assertIn("feltgate_chosen_mutant()", text)
        self.assertRegex(text, "reg kept_[oq] = 1'h1;")  # a value at power-up stays
        self.assertGreater(len(mutants), 30)
        self.assertTrue(all(re.fullmatch(r"rtl/counter.sv:\d+", w) for m in mutants for w in m["where"]))

    def judged(self, script, *words):
        folder = "testbench/wave/b/b_mutants.netlist"
        self.put(f"{folder}/test.json", '{"test": "b_test", "block": "b"}')
        mutants = [{"number": n, "what": "w", "where": ["rtl/b.sv:2"]} for n in range(1, 5)]
        self.put(f"{folder}/mutants.json", json.dumps(mutants))
        self.put("rtl/b.sv", "module b;\n  assign w = a;\n")
        self.put_program("testbench/wave/b/b_mutants", script)
        places = {"FELTGATE_BUILD": str(self.folder), "FELTGATE_ROOT": str(self.folder)}
        with mock.patch.dict(os.environ, places), mock.patch.object(runs, "MORE_S", 0.5):
            return called(mutate.main, "--no-build", *words)

    def test_a_survivor_is_printed_and_the_share_counts(self):
        script = "case $FELTGATE_MUTANT in 0|4) exit 0;; 3) kill -SEGV $$;; 2) while :; do :; done;; *) exit 1;; esac"
        for share, status in (("0.75", 0), ("0.76", 1)):
            code, out, _ = self.judged(script, "--require", share)
            self.assertEqual(code, status)
            self.assertIn("b_test 4 survives: w\n    rtl/b.sv:2: assign w = a;\n    FELTGATE_MUTANT=4 ", out)

    def test_a_test_that_fails_without_a_mutant_kills_nothing(self):
        code, _, err = self.judged("exit 1")
        self.assertEqual((code, "killed without a mutant" in err), (2, True))

    def test_a_sample_may_be_worse_by_chance(self):
        row = runs.Row("b", 400, [runs.Verdict(None, None, runs.KILLED, 0.0)] * 40, 0.9)
        self.assertAlmostEqual(row.limit(), 0.765, 3)
        row.offered = 40
        self.assertEqual(row.limit(), 0.9)


class Proofs(Scratch):
    def setUp(self):
        super().setUp()
        self.proofs = catalog.read(ROOT)

    def test_the_records_are_of_the_proofs_as_they_are(self):
        self.assertGreaterEqual(sum(len(proof.properties) for proof in self.proofs), 200)
        names = {record.name(proof, design) for proof in self.proofs for design in proof.designs}
        there = record.read(ROOT).keys()
        self.assertEqual(there - names, set())
        self.assertEqual({p.key for p in self.proofs if p.fast} - {n.split()[0] for n in there}, set())

    def test_a_proof_is_good_where_each_defect_breaks_its_assertion(self):
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

    def test_what_is_on_record_as_proven_is_what_the_proof_reads(self):
        for name in ("rtl", "testbench/safety/hold_timer", "testbench/campaigns/prove"):
            shutil.copytree(ROOT / name, self.folder / name)
        (self.folder / "docs/verification").mkdir(parents=True)
        proofs = [p for p in catalog.read(self.folder) if p.block == "hold_timer"]
        record.write(self.folder, tasks.rows(proofs, True), {"yosys": "1", "z3": "2"})
        for name, old, new, known in (
            ("rtl/safety/hold_timer.sv", "module hold_timer", "// a comment\nmodule   hold_timer", True),
            ("rtl/generated/lever/cfg.sv", "endpackage", "localparam int NEW = 1;\nendpackage", True),
            ("rtl/generated/lever/cfg.sv", "TORQUE_W = 21", "TORQUE_W = 22", False),
            ("rtl/safety/hold_timer.sv", "endmodule", "logic more;\nendmodule", False),
            (proofs[0].wrapper.relative_to(self.folder), "endmodule", "logic more;\nendmodule", False),
            ("testbench/safety/hold_timer/proofs/proofs.toml", "depth = ", "depth = 1", False),
        ):
            with self.subTest(new):
                before = (self.folder / name).read_text(encoding="utf-8")
                self.assertIn(old, before)
                self.put(name, before.replace(old, new, 1))
                now = [p for p in catalog.read(self.folder) if p.block == "hold_timer"]
                self.assertEqual(record.known(self.folder, now, True) == now, known)
                self.put(name, before)


def state(register, kind="masked", safety=True):
    return {"point": "state", "register": register, "bit": 0, "group": "pwm", "safety": safety,
            "act": "wall", "tick": 1, "clock": 2, "class": kind, "peak_nm": 0.0,
            "integral_nm_s": 0.0, "motor_peak_nm": 0}


def pin(kind, group="channel dead", changed=True):
    return {"point": "pins", "group": group, "seed": 1, "what": "", "must_flag": True,
            "class": kind, "peak_nm": 0, "integral_nm_s": 0, "motor_peak_nm": 0,
            "count_changed": changed}


class Faults(Scratch):
    def kept(self, *some):
        return [good for *_, good in fault_results.promises(list(some))]

    def test_a_zero_has_its_bound(self):
        for count, of, said in ((0, 300, "0 (< 0.99 %)"), (0, 2, "0 (< 78 %)"), (3, 300, "1 %"), (0, 0, "-")):
            self.assertEqual(fault_results.bound(count, of), said)

    def test_promises(self):
        some = [state("a")] * 999
        self.assertTrue(all(self.kept(*some)))
        self.assertEqual(self.kept(*some, state("b", "unsafe")), [False, True])
        # Of single flips in the safety state one in a hundred may be silent.
        self.assertEqual(self.kept(*some[:99], state("b", "silent")), [True, True])
        self.assertEqual(self.kept(*some[:99], *[state("b", "silent")] * 2), [True, False])
        self.assertEqual(self.kept(*some[:99], *[state("i", "silent", safety=False)] * 50), [True, True])
        # What nothing sees is counted apart.
        cut = pin("unsafe", "cable cut") | {"must_flag": False, "unseen": True}
        found = fault_results.promises([state("a"), cut, pin("detected")])
        self.assertEqual([(n, of, good) for _, n, of, good in found[:2]], [(0, 2, True), (1, 1, True)])
        # What must be flagged is; a short whose count stands has nothing to be found by.
        many, shorted = [pin("detected")] * 198, [pin("silent", "channels shorted", False)] * 9
        self.assertEqual(self.kept(*many, pin("silent"), *shorted), [True] * 3)
        self.assertEqual(self.kept(*many, *[pin("silent")] * 3), [True, False])
        # Not one late sensor arms.
        late = pin("off", "late sensor") | {"must_flag": False, "must_refuse": True}
        self.assertEqual(self.kept(late, late), [True, True])
        self.assertEqual(self.kept(*[late] * 999, late | {"class": "unsafe"}), [False, False])

    def test_a_promise_that_is_not_kept_fails(self):
        for kind, status, said in (("masked", 0, "0 of 2, 0 (< 78 %)"), ("unsafe", 1, "NOT KEPT")):
            lines = self.put("l", "".join(json.dumps(f) + "\n" for f in (state("a", kind), pin("detected"))))
            code, out, _ = called(faults.main, "--lines", lines)
            self.assertEqual(code, status)
            self.assertIn(said, out)

    def test_replay_and_alarms(self):
        def says(line, status, *words):
            self.put_program("feltgate_faults", f"echo '{json.dumps(line)}'; exit {status}")
            with mock.patch.dict(os.environ, FELTGATE_BUILD=str(self.folder)):
                return called(faults.main, *words, "--jobs", "1")

        cases = self.put("c", json.dumps(state("a", "latent")) + "\n")
        code, out, _ = says(state("a", "silent"), 0, "--replay", cases)
        self.assertEqual((code, "listed as latent, now silent" in out), (1, True))
        self.assertEqual(says(state("a", "latent"), 0, "--replay", cases)[0], 0)
        clean = {"clean_s": 300, "scenes_s": 100, "recordings_s": 100, "dither_s": 100, "alarms": 0, "first": ""}
        code, out, _ = says(clean, 0, "--clean")
        self.assertEqual((code, "0 false alarms (< 36 an hour)" in out), (0, True))
        self.assertEqual(says(clean | {"alarms": 1, "first": "speed"}, 1, "--clean")[0], 1)
        self.assertEqual(says(clean, 3, "--clean")[0], 2)


if __name__ == "__main__":
    unittest.main()
