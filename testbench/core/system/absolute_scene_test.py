# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate run wall --design lever_absolute: RTL and twin in lock-step with a sensor at the pins, which then
breaks; other defects, in the twin; and a design without such an encoder."""

import json
import unittest

from testing import BUILD, Scratch, ran, text_of

PROGRAM = BUILD / "feltgate_lever_absolute"
LONG = "duration_s = 1.2"
SLOW = '{ kind = "minimum_jerk", duration_s = 0.5, to_rad = 0.6 }'
BROKEN_S = 0.25


class AbsoluteScene(Scratch):
    def run_of(self, defect, *words):
        """The wall's scene with a quicker hand, whose sensor breaks while the hand is in the wall."""
        wall = text_of("vectors/scenes/wall.toml").split("[[expect]]")[0]
        self.assertEqual((wall.count(LONG), wall.count(SLOW)), (1, 1))
        wall = wall.replace(SLOW, SLOW.replace("0.5", "0.1"))
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

    def test_other_designs_refuse_it(self):
        self.run_of("none", "--engine", "twin")
        self.ended(ran(PROGRAM, "run", self.folder / "broken.toml", "--design", "lever"), 2,
                   "design lever has no absolute encoder")


if __name__ == "__main__":
    unittest.main()
