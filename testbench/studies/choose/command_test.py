# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate choose as a user calls it, on short scenes: the sum against awk's own, RTL beside the twin,
a device of two axes, a law of one's own, a wish that cannot be, and what is refused."""

import csv
import json
import math
import subprocess
import unittest
from unittest import mock

from testing import BUILD, ROOT, Scratch, called, ran

import choose
from exploration import choice, choosing, made_scene

PROGRAM = BUILD / "feltgate_lever_law"
SCENE = """title = "Short"
about = "A wall for some milliseconds."
duration_s = 0.06
[core]
scene = "wall"
arm_s = 0.001
[parameters]
wall_contact = 5
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [{ kind = "minimum_jerk", duration_s = 0.06, to_rad = 0.08 }]
"""
LEVERS = """title = "Short levers"
about = "Two levers parted for some milliseconds."
duration_s = 0.03
device = "two_levers"
[core]
scene = "law"
law = "coupled_levers"
arm_s = 0.001
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [{ kind = "minimum_jerk", duration_s = 0.03, to_rad = 0.05 }]
[[expect]]
figure = "faults"
high = 0
"""
LAW = "# a soft spring\nparam k = 1 Nm/rad in 0.5 .. 2 Nm/rad\nout torque = -k * position\n"
SPRING = """title = "Spring"
about = "A spring by a law file."
duration_s = 0.06
[core]
scene = "law"
law = "spring.law"
arm_s = 0.001
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [{ kind = "minimum_jerk", duration_s = 0.06, to_rad = 0.3 }]
"""
# The sum once more, in another language and by another formula: what counts and rate leave together
# is the larger of the two.
AWK = "BEGIN { sum = counts > row ? counts : row; printf \"%.12g\", sum + rounding + plant }"


class Chosen(Scratch):
    def setUp(self):
        """Each sixteenth design of the table, `lever` itself, and those that it runs by a register."""
        super().setUp()
        with open(ROOT / choosing.TABLE, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        kept = [r for k, r in enumerate(rows) if k % 16 == 0 or set(choice.settings(r)) <= {choice.CUTOFF, choice.OBSERVER}]
        with (self.folder / "table.csv").open("w", newline="", encoding="utf-8") as file:
            table = csv.DictWriter(file, rows[0])
            table.writeheader()
            table.writerows(kept)
        self.enterContext(mock.patch.object(choosing, "TABLE", str(self.folder / "table.csv")))

    def call(self, status, *words):
        found, out, err = called(choose.main, *words, "-o", self.folder / "out")
        self.assertEqual(found, status, err)
        return json.loads((self.folder / "out/choose.json").read_text(encoding="utf-8")), out

    def ask(self, command, *words):
        """The program's own answer."""
        self.ended(ran(PROGRAM, command, *words, "--quiet", "--json", self.folder / "a.json"))
        return json.loads((self.folder / "a.json").read_text(encoding="utf-8"))

    def kept(self, told, *names):
        checks = {c["what"]: c for c in told["verified"]["checks"]}
        for name in ("mismatches between RTL and twin", "torque error, rms, Nm", *names):
            self.assertTrue(checks[name]["holds"], name)
        self.assertEqual(checks["mismatches between RTL and twin"]["measured"], 0)
        self.assertGreater(told["verified"]["clocks"], 100_000)
        return checks

    def awk(self, **values):
        words = [word for name, value in values.items() for word in ("-v", f"{name}={value!r}")]
        return float(subprocess.run(["awk", *words, AWK], capture_output=True, text=True, check=True).stdout)

    def test_a_scene_and_its_sum(self):
        scene = self.put("short.toml", SCENE)
        told, out = self.call(0, scene, "--margin", "2", "--torque-error", "20%")
        self.assertEqual((told["schema"], told["choice"]["by"]), ("feltgate-choose/1", "block"))
        checks = self.kept(told, "margin on the chain's bits", "rounding in the RTL, worst, Nm")
        self.assertEqual(told["choice"]["design"], "lever_700")  # of the table, in a register of lever
        with open(ROOT / "vectors/spaces/trade.csv", newline="", encoding="utf-8") as file:
            (listed,) = [r for r in csv.DictReader(file) if r["id"] == told["choice"]["table_id"]]
        # The same by the commands themselves.
        trim = self.ask("trim", scene, "--tolerance", "20%")
        trimmed = self.folder / "out/short.toml"
        (rates,) = self.ask("rates", trimmed, "--rate", "1000000")["scenes"]
        row = rates["rates"][-1]
        run = self.ask("run", trimmed, "--engine", "twin,quad")["engines"]["twin"]["torque_nm"]
        losses = [trim["own_motion"], *(m["difference"] for m in trim["unseen"])]
        worst = max(run["max_error"], run.get("max_error_outside", 0))
        rounding_rms = min(run["rms_error"] + run["max_error"], worst)
        rounding_rms = max(rounding_rms, float(listed["torque_error_max_nm"]))
        proven = max(run["bound"], worst, float(listed["bound_torque_nm"]))
        error = told["choice"]["error"]
        for of, peak, key, rounding in (
            ("rms", "rms", "rms_nm", rounding_rms),
            ("max", "peak", "worst_nm", proven),
        ):
            wanted = self.awk(
                counts=rates[f"counts_alone_{of}_nm"],
                row=row[f"error_{of}_nm"],
                rounding=rounding,
                plant=max(m["torque"][peak] for m in losses) * rates["largest_nm"],
            )
            self.assertAlmostEqual(error[key], wanted, delta=1e-6 * wanted, msg=key)
        self.assertAlmostEqual(error["share"], error["rms_nm"] / rates["largest_nm"])
        # The margin is that of the whole plant, whatever was left out of it: its parts as a product.
        (whole,) = self.ask("rates", scene, "--rate", "1000000")["scenes"]
        parts = [p["margin"] for p in told["choice"]["margin"]["parts"]]
        factors = [sum(parts[: i + 1]) / sum(parts[:i]) for i in (1, 2)]
        product = parts[0] * math.prod(factors)
        self.assertAlmostEqual(told["choice"]["margin"]["margin"], product, places=9)
        self.assertAlmostEqual(parts[0] / whole["rates"][-1]["margin"], 1, delta=0.01)
        bits = checks["margin on the chain's bits"]["measured"]
        self.assertAlmostEqual(bits / product, 1, delta=0.05)
        # All of the table are accounted for, and the front is from it.
        self.assertGreater(told["measured"], 12)
        left = sum(told["designs"]["left_out"].values())
        self.assertEqual(left + told["measured"], told["designs"]["in_table"])
        self.assertEqual(len(told["front"]), 5)
        self.assertGreater(len({o["gates"]["lut4_equivalents"] for o in told["front"]}), 2)
        # Its files go on: the scene runs, trimmed, and the page of commands names them.
        self.assertIn(str(self.folder / "out/short.toml"), out)
        again = self.ask("run", trimmed, "--engine", "twin")
        self.assertEqual(sorted(again["effects_off"]), sorted(told["simulation"]["effects_off"]))

    def test_two_axes_say_what_is_left_out(self):
        scene = self.put("levers.toml", LEVERS)
        told, out = self.call(0, scene, "--torque-error", "50%", "--rtl-seconds", "0.003")
        self.kept(told)
        self.assertEqual(told["asked"]["axes"], 2)
        self.assertGreater(told["choice"]["margin"]["margin"], 1)
        self.assertIn("supply_limit", told["simulation"]["effects_off"])
        self.assertNotIn("dead_time", told["simulation"]["effects_off"])
        for part in ("rounding behind the law", "delay of PWM and winding"):
            self.assertIn(part, [left["part"] for left in told["left_out"]])
            self.assertIn(f"left out: {part}", out)
        self.assertEqual(told["choice"]["gates"]["mult18"], 22)

    def test_a_law_of_ones_own_at_the_rate_that_was_chosen(self):
        self.put("spring.law", LAW)
        scene = self.put("spring.toml", SPRING)
        told, _ = self.call(0, scene, "--torque-error", "20%", "--margin", "5", "--rtl-seconds", "0.003")
        checks = self.kept(told, "margin on the chain's bits")
        one = told["choice"]
        # The slowest that meets the wish, and the next slower does not.
        (rates,) = self.ask("rates", scene, "--rate", "490,1000,10000,40000,100000")["scenes"]
        able = [r["rate_hz"] for r in rates["rates"] if r["margin"] >= 5]
        self.assertEqual(one["rate_hz"], min(able))
        self.assertLess(min(r["margin"] for r in rates["rates"]), 5)
        self.assertGreaterEqual(checks["margin on the chain's bits"]["measured"], 5 * 0.95)
        law = (self.folder / "out/spring.law").read_text(encoding="utf-8")
        self.assertIn(f"rate = {one['rate_hz']:.9g} Hz", law)

    def test_a_wish_that_cannot_be(self):
        # With a cut-off of its own it runs on lever alone.
        scene = self.put("short.toml", SCENE.replace("wall_contact = 5", "wall_contact = 5\nvelocity_a1 = 0.00095"))
        words = ("--margin", "900", "--latency", "5", "--rtl-seconds", "0.01")
        told, out = self.call(1, scene, "--torque-error", "20%", *words)
        (why,) = told["why_not"]
        self.assertEqual((why["wish"], why["stated"], why["alone"]), ("margin", True, False))
        self.assertIn("NOT MET  margin 900 (wish)", out)
        # The nearest: the stiffest of all.
        self.assertEqual(why["is"], max(o["margin"]["margin"] for o in told["front"]))
        self.assertEqual(why["is"], told["choice"]["margin"]["margin"])
        self.assertEqual(told["choice"]["design"], "lever")
        self.kept(told)

    def test_a_hand_that_gives_way_moves_another_design_otherwise(self):
        """The law has no speed, and yet the cut-off is in the motion, by the back-EMF."""
        self.put("spring.law", LAW)
        scene = self.put("soft.toml", SPRING.replace("prescribed", "impedance").replace("0.06, to_rad", "0.02, to_rad"))
        asked = {"torque_error": 0.2, "margin": 2.0, "stated": [], "objective": None, "chip": None, "latency": None}
        programs = choosing.Programs(self.folder, quiet=True)
        found = choosing.Choosing(choosing.Question(str(scene), programs), programs, asked)
        found.measure()
        (one,) = [o for o in found.alternatives() if o["design"] == "lever_law_950" and o["rate_hz"] == 1000]

        def said():
            return sum(part["worst_nm"] for part in one["error"]["parts"][:2])

        own = self.put("own.toml", made_scene.toml_text([], found.scene_of(one)))
        rows = self.ask("rates", own, "--rate", "1000")["scenes"][0]["rates"]
        self.assertLess(said(), rows[0]["error_max_nm"])
        found.run_itself(one)
        self.assertGreaterEqual(said(), rows[0]["error_max_nm"] * (1 - 1e-9))

    def test_rtl_that_was_hardly_armed_verifies_nothing(self):
        scene = {"core": {"arm_s": 0.05}}
        for seconds, armed, holds in ((0.001, 0, False), (0.0505, 0.0005, False), (0.06, 0.01, True)):
            check = choose.armed_check(scene, seconds)
            self.assertAlmostEqual(check["measured"], armed)
            self.assertEqual(check["holds"], holds)

    def test_a_law_of_several_axes_needs_a_scene(self):
        law = self.put("two.law", "out torque = 0 Nm\nout torque[1] = -(1 Nm/rad) * position[1]\n")
        bad = self.put("bad.law", "out torque = 1 m\n")
        for given, said in ((law, "no device"), (bad, "bad.law:1"), ("free_lever", "free_lever")):
            status, out, err = called(choose.main, given, "-o", self.folder / "out", "--quiet")
            self.assertEqual((status, out), (2, ""), err)
            self.assertIn(said, err)
            self.assertFalse((self.folder / "out").exists())


class Border(Scratch):
    def test_the_bits_of_a_file_have_its_cut_off(self):
        text = (ROOT / "rtl/designs/lever.toml").read_text(encoding="utf-8")
        file = self.put("quick.toml", text.replace("cutoff_rad_s = 500.0", "cutoff_rad_s = 950.0", 1))
        exact = self.put("finer.toml", text.replace("current = [1, 5, 16]", "current = [1, 5, 17]"))
        words = ("--rate", "1000000", "--damping", "0.01")
        words += ("--json", self.folder / "a.json")

        def border(design, status=0):
            done = ran(PROGRAM, "stability", design, *words)
            self.assertEqual(done.returncode, status, done.stderr)
            return json.loads((self.folder / "a.json").read_text(encoding="utf-8"))["borders"][0]

        own, quick, finer = border("lever"), border(file), border(exact)
        self.assertGreater(quick["eigenvalues_nm_rad"], 1.1 * own["eigenvalues_nm_rad"])
        self.assertEqual(finer["eigenvalues_nm_rad"], own["eigenvalues_nm_rad"])
        for found in (own, quick, finer):
            self.assertAlmostEqual(found["bits_nm_rad"] / found["eigenvalues_nm_rad"], 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
