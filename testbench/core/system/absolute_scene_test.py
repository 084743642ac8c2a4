# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate run wall --design lever_absolute: RTL and twin in lock-step with a sensor at the pins, which then
breaks; other defects, in the twin; a design without such an encoder; and a turn with a magnet off its axis, from
which the host makes a table."""

import json
import unittest

from testing import BUILD, Scratch, ran, text_of

PROGRAM = BUILD / "feltgate_lever_absolute"
HOST = BUILD / "feltgate_host"
LONG = "duration_s = 1.2"
ERROR_MRAD = (7.5, 4.5, -1.2, 0.9)
TURN = """title = "Turn"
about = "A hand turns the shaft by twenty turns."
duration_s = 3.1
[core]
scene = "free"
arm_s = 3.0
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [
  { kind = "hold", duration_s = 0.05 },
  { kind = "minimum_jerk", duration_s = 3.0, to_rad = 126 },
  { kind = "hold", duration_s = 0.1 },
]
"""
BROKEN_S = 0.7


class AbsoluteScene(Scratch):
    def run_of(self, defect, *words):
        """The wall's scene, whose sensor breaks while the hand is in the wall."""
        wall = text_of("vectors/scenes/wall.toml").split("[[expect]]")[0]
        self.assertEqual(wall.count(LONG), 1)
        scene = self.put("broken.toml", wall.replace(LONG, f"duration_s = {BROKEN_S + 0.003}")
                         + f'[[event]]\nat_s = {BROKEN_S}\nencoder = "{defect}"\n')
        out = self.folder / "run.json"
        self.ended(ran(PROGRAM, "run", scene, "--design", "lever_absolute", "--quiet", "--json", out, *words))
        return json.loads(out.read_text(encoding="utf-8"))

    def named_within_2_ms(self, run):
        self.assertEqual(list(run["felt"]["faults"]), ["encoder"])
        self.assertGreater(run["felt"]["faults"]["encoder"]["first_s"], BROKEN_S)
        self.assertLess(run["felt"]["faults"]["encoder"]["first_s"], BROKEN_S + 2e-3)

    def test_rtl_and_twin_until_the_cable_is_cut(self):
        run = self.run_of("cut")
        self.assertEqual(run["figures"]["mismatches"], 0)
        self.assertAlmostEqual(run["figures"]["tau_ref_min_nm"], -0.4, delta=0.004)
        self.named_within_2_ms(run)

    def test_other_defects_at_rest(self):
        for defect in ("grounded", "magnet_lost", "wrong_bit", "half_a_turn_off"):
            self.named_within_2_ms(self.run_of(defect, "--engine", "twin"))

    def test_a_turn_with_a_magnet_off_its_axis_gives_its_table(self):
        plant = text_of("vectors/plants/p24.toml")
        for old, new in (("[encoder]\n", f"[encoder]\nabsolute_error_mrad = {list(ERROR_MRAD)}\n"),
                         ("encoder_imperfect = false", "encoder_imperfect = true")):
            self.assertEqual(plant.count(old), 1)
            plant = plant.replace(old, new)
        words = ("run", self.put("turn.toml", TURN), "--design", "lever_absolute", "--plant",
                 self.put("off_axis.toml", plant), "--engine", "twin", "--quiet")
        # 16 readings a row, one of which asks for the diagnosis: so all are of the same age.
        self.ended(ran(PROGRAM, *words, "--csv", self.folder / "turn.csv", "--every", 1536))
        self.ended(ran(HOST, "-", "--design", "lever_absolute", "calibrate", "encoder", "--from",
                       self.folder / "turn.csv", "--json", self.folder / "e.json"))
        found = json.loads((self.folder / "e.json").read_text(encoding="utf-8"))
        self.assertEqual(found["warnings"], [])
        for value, truth in zip(found["changes"][0]["value"], ERROR_MRAD + (0,) * 4):
            self.assertAlmostEqual(value, truth, delta=0.1)

    def test_other_designs_refuse_it(self):
        self.run_of("none", "--engine", "twin")
        self.ended(ran(PROGRAM, "run", self.folder / "broken.toml", "--design", "lever"), 2,
                   "design lever has no absolute encoder")


if __name__ == "__main__":
    unittest.main()
