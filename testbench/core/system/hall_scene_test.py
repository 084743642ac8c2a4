# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""hall_motor without an alignment: torque from angles of the rotor all round at power-up, and after an edge of the
Hall lines, sensors that are off their places too; RTL and twin in lock-step; an encoder's offset that the lines
contradict; plants without lines."""

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
  { kind = "minimum_jerk", duration_s = 0.01, to_rad = TO_RAD },
  { kind = "hold", duration_s = 0.1 },
]
"""
TURNED = 0.16  # rad, 73 electrical degrees
OFFSET, ERROR = "offset_rad = 1.0 ", "hall_error_rad = [0.0, 0.0, 0.0]"
PAIRS = 8


class HallScene(Scratch):
    def plant(self, offset_rad, error=(0, 0, 0)):
        text = text_of("vectors/plants/hall_motor.toml")
        self.assertEqual((text.count(OFFSET), text.count(ERROR)), (1, 1))
        text = text.replace(OFFSET, f"offset_rad = {offset_rad:.4f} ")
        return self.put("turned.toml", text.replace(ERROR, f"hall_error_rad = {[float(e) for e in error]}"))

    @staticmethod
    def program(*words):
        return ran(BUILD / "feltgate_hall_motor", *words, "--design", "hall_motor")

    def figures(self, plant, *words, to_rad=TURNED):
        out = self.folder / "run.json"
        scene = self.put("steps.toml", SCENE.replace("TO_RAD", str(to_rad)))
        self.ended(self.program("run", scene, "--plant", plant, "--quiet", "--json", out, *words))
        return json.loads(out.read_text(encoding="utf-8"))["figures"]

    def torques_are_right(self, found, least, error):
        """Shares of what was asked for, before an edge and after one. `error`: of the dead times, mostly."""
        self.assertEqual(found["faults"], 0)
        before, after = found["torque_final_nm.0"] / 0.2, found["torque_final_nm.1"] / -0.2
        self.assertGreater(before, least)
        self.assertLess(before, 1 + error)
        self.assertLess(abs(after - 1), error)
        return before

    def test_from_any_angle(self):
        shares = []
        for n in range(12):  # a sixth of a turn in two steps, beside an edge and in the middle of a sector
            plant = self.plant(0.02 + n * 0.5235988)
            found = self.figures(plant, "--engine", "twin", to_rad=TURNED if n % 3 else -TURNED)
            shares.append(self.torques_are_right(found, 0.83, 0.04))
        self.assertLess(min(shares), 0.93)  # 30 degrees off before the first edge
        self.assertGreater(max(shares), 0.97)

    def test_sensors_off_their_places(self):
        for n in range(4):
            plant = self.plant(0.1 + 1.6 * n, (0.05, -0.05, 0.03))
            self.torques_are_right(self.figures(plant, "--engine", "twin"), 0.8, 0.045)

    def test_rtl_and_twin(self):
        found = self.figures(self.plant(2.7), "--engine", "rtl,twin")
        self.assertEqual(found["mismatches"], 0)
        self.torques_are_right(found, 0.83, 0.04)

    def test_a_plant_without_lines_is_refused(self):
        done = self.program("run", "wall", "--plant", "gimbal_motor")
        self.ended(done, 2)
        self.assertIn("plant gimbal_motor has none; give it hall_rad and hall_error_rad", done.stderr)


if __name__ == "__main__":
    unittest.main()
