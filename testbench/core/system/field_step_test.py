# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Torque steps on gimbal_current, its shaft locked: RTL and twin in lock-step with two modulators, the
time to 2 % of each step; and a phase that opens."""

import json
import unittest

from testing import BUILD, Scratch, ran

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


class FieldStep(Scratch):
    def figures(self, scene, engines):
        out = self.folder / "run.json"
        self.ended(ran(BUILD / "feltgate_gimbal_current", "run", self.put("steps.toml", scene), "--design",
                       "gimbal_current", "--quiet", "--json", out, "--engine", engines))
        return json.loads(out.read_text(encoding="utf-8"))["figures"]

    def test_rtl_and_twin_settle_in_0_4_ms(self):
        found = self.figures(SCENE, "rtl,twin,double")
        self.assertEqual((found["mismatches"], found["faults"]), (0, 0))
        for n in range(2):
            self.assertLessEqual(found[f"torque_settling_ms.{n}"], 0.4)
            self.assertLessEqual(abs(found[f"final_error_pct.{n}"]), 0.5)
        self.assertLessEqual(abs(found["torque_final_nm.0"] - 0.03), 1.5e-4)
        self.assertLessEqual(abs(found["torque_final_nm.1"] + 0.01), 5e-5)

    def test_a_phase_that_opens_is_a_fault(self):
        found = self.figures(SCENE + '[[event]]\nat_s = 0.04\nopen_phase = "a"\n', "twin")
        self.assertEqual(found["faults"], 1 << 15)  # current


if __name__ == "__main__":
    unittest.main()
