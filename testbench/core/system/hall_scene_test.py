# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""hall_motor without an alignment: torque before and after an edge of the Hall lines, RTL and twin in lock-step; plants
without lines."""

import json
import unittest

from testing import BUILD, Scratch, ran, text_of

SCENE = """
title = "Torque before and after an edge"
about = "A step at rest, a hand that turns the shaft by more than a sixth of an electrical turn, a step at rest."
duration_s = 0.05
[core]
scene = "setpoint"
arm_s = 0.002
[[event]]
at_s = 0.005
set = { setpoint_torque = 0.2 }
step_nm = 0.2
[[event]]
at_s = 0.02
set = { setpoint_torque = 0.0 }
[[event]]
at_s = 0.035
set = { setpoint_torque = -0.2 }
step_nm = -0.2
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [
  { kind = "hold", duration_s = 0.022 },
  { kind = "minimum_jerk", duration_s = 0.01, to_rad = 0.16 },
  { kind = "hold", duration_s = 0.1 },
]
"""
OFFSET = "offset_rad = 1.0 "


class HallScene(Scratch):
    @staticmethod
    def program(*words):
        return ran(BUILD / "feltgate_hall_motor", *words, "--design", "hall_motor")

    def test_rtl_and_twin(self):
        text = text_of("vectors/plants/hall_motor.toml")
        self.assertEqual(text.count(OFFSET), 1)
        plant = self.put("turned.toml", text.replace(OFFSET, "offset_rad = 2.7 "))
        out = self.folder / "run.json"
        self.ended(self.program("run", self.put("steps.toml", SCENE), "--plant", plant, "--quiet", "--json", out,
                                "--engine", "rtl,twin"))
        found = json.loads(out.read_text(encoding="utf-8"))["figures"]
        self.assertEqual((found["mismatches"], found["faults"]), (0, 0))
        before, after = found["torque_final_nm.0"] / 0.2, found["torque_final_nm.1"] / -0.2
        self.assertGreater(before, 0.83)
        self.assertLess(before, 1.04)
        self.assertLess(abs(after - 1), 0.04)

    def test_a_plant_without_lines_is_refused(self):
        done = self.program("run", "wall", "--plant", "gimbal_motor")
        self.ended(done, 2)
        self.assertIn("plant gimbal_motor has none; give it hall_rad and hall_error_rad", done.stderr)


if __name__ == "__main__":
    unittest.main()
