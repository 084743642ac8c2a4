# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Torque steps on gimbal_current, its shaft locked: RTL and twin in lock-step with two modulators, the
time to 2 % of each step, the torque with a resistance that is not that of the design, and a phase
that opens."""

import json
import unittest

from testing import BUILD, Scratch, ran, text_of

SCENE = """
title = "Torque steps of three phases"
about = "Two steps, the shaft locked."
duration_s = 0.045
[core]
scene = "setpoint"
[[event]]
at_s = 0.02
set = { setpoint_torque = 0.03 }
step_nm = 0.03
[[event]]
at_s = 0.03
set = { setpoint_torque = -0.01 }
step_nm = -0.01
[hand]
[[hand.phase]]
kind = "locked"
"""
OPENS = '[[event]]\nat_s = 0.04\nopen_phase = "a"\n'
RESISTANCE = "resistance_ohm = 2.9 "


class FieldStep(Scratch):
    def figures(self, scene, *words):
        out = self.folder / "run.json"
        self.ended(ran(BUILD / "feltgate_gimbal_current", "run", self.put("steps.toml", scene), "--design",
                       "gimbal_current", "--quiet", "--json", out, *words))
        return json.loads(out.read_text(encoding="utf-8"))["figures"]

    def steps_hold(self, found, settled_ms):
        self.assertEqual(found["faults"], 0)
        for n in range(2):
            self.assertLessEqual(found[f"torque_settling_ms.{n}"], settled_ms)
            self.assertLessEqual(abs(found[f"final_error_pct.{n}"]), 0.5)
        self.assertLessEqual(abs(found["torque_final_nm.0"] - 0.03), 1.5e-4)
        self.assertLessEqual(abs(found["torque_final_nm.1"] + 0.01), 5e-5)

    def test_rtl_and_twin_settle_in_0_4_ms(self):
        found = self.figures(SCENE, "--engine", "rtl,twin,double")
        self.assertEqual(found["mismatches"], 0)
        self.steps_hold(found, 0.4)

    def test_right_though_the_resistance_is_not(self):
        plant = text_of("vectors/plants/gimbal_motor.toml")
        self.assertEqual(plant.count(RESISTANCE), 1)
        for share in (0.8, 1.2):
            other = self.put("other.toml", plant.replace(RESISTANCE, f"resistance_ohm = {2.9 * share} "))
            self.steps_hold(self.figures(SCENE, "--engine", "twin", "--plant", other), 0.6)

    def test_a_phase_that_opens_is_a_fault(self):
        found = self.figures(SCENE + OPENS, "--engine", "twin")
        self.assertEqual(found["faults"], 1 << 15)  # current


if __name__ == "__main__":
    unittest.main()
