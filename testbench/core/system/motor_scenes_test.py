# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""`feltgate run` with an absolute encoder, a current loop, three phases with two shunts, and Hall lines: RTL and twin
in lock-step with what is at the pins, figures of torque steps, what breaks. A CTest runs one class."""

import json
import unittest

from testing import BUILD, Scratch, ran, text_of


class MotorScene(Scratch):
    def run_of(self, design, scene, *words, program=None, status=0):
        out = self.folder / "run.json"
        self.ended(ran(BUILD / (program or f"feltgate_{design}"), "run", scene, "--design", design, "--quiet", "--json",
                       out, *words), status)
        return json.loads(out.read_text(encoding="utf-8"))

    def resistances(self, plant, ohm):
        """Plants whose resistance is a fifth from that of the design."""
        text, given = text_of(f"vectors/plants/{plant}.toml"), f"resistance_ohm = {ohm} "
        self.assertEqual(text.count(given), 1)
        for share in (0.8, 1.2):
            yield self.put("other.toml", text.replace(given, f"resistance_ohm = {ohm * share} "))

    def in_lock_step(self, design, scene, *words):
        found = self.run_of(design, scene, *words)["figures"]
        self.assertEqual((found["mismatches"], found["faults"]), (0, 0))
        return found


class LeverAbsolute(MotorScene):
    LONG, SLOW = "duration_s = 1.2", '{ kind = "minimum_jerk", duration_s = 0.5, to_rad = 0.6 }'
    BROKEN_S = 0.25

    def broken(self, defect, *words):
        """The wall's scene with a quicker hand, whose sensor breaks while the hand is in the wall."""
        wall = text_of("vectors/scenes/wall.toml").split("[[expect]]")[0]
        self.assertEqual((wall.count(self.LONG), wall.count(self.SLOW)), (1, 1))
        wall = wall.replace(self.SLOW, self.SLOW.replace("0.5", "0.1"))
        wall = wall.replace(self.LONG, f"duration_s = {self.BROKEN_S + 0.003}")
        event = f'[[event]]\nat_s = {self.BROKEN_S}\nencoder = "{defect}"\n'
        return self.run_of("lever_absolute", self.put("broken.toml", wall + event), *words)

    def named_within_2_ms(self, run):
        self.assertEqual(list(run["felt"]["faults"]), ["encoder"])
        self.assertGreater(run["felt"]["faults"]["encoder"]["first_s"], self.BROKEN_S)
        self.assertLess(run["felt"]["faults"]["encoder"]["first_s"], self.BROKEN_S + 2e-3)

    def test_rtl_and_twin_until_the_cable_is_cut(self):
        run = self.broken("cut")
        self.assertEqual(run["figures"]["mismatches"], 0)
        self.assertAlmostEqual(run["figures"]["tau_ref_min_nm"], -0.4, delta=0.004)
        self.named_within_2_ms(run)

    def test_other_defects_at_rest(self):
        for defect in ("grounded", "magnet_lost", "wrong_bit", "half_a_turn_off"):
            self.named_within_2_ms(self.broken(defect, "--engine", "twin"))

    def test_other_designs_refuse_it(self):
        self.broken("none", "--engine", "twin")
        self.ended(ran(BUILD / "feltgate_lever_absolute", "run", self.folder / "broken.toml", "--design", "lever"), 2,
                   "design lever has no absolute encoder")


class LeverCurrent(MotorScene):
    def steps_hold(self, found, settled_ms):
        for n in range(3):
            self.assertLessEqual(found[f"torque_settling_ms.{n}"], settled_ms)
            self.assertLessEqual(abs(found[f"final_error_pct.{n}"]), 1)
            self.assertLessEqual(abs(found[f"tau_hat_final_error_nm.{n}"]), 1e-3)

    def test_settles_in_0_35_ms(self):
        self.steps_hold(self.in_lock_step("lever_current", "torque_step", "--engine", "rtl,twin,double"), 0.35)

    def test_right_though_the_resistance_is_not(self):
        for plant in self.resistances("p24", 0.42):
            run = self.run_of("lever_current", "torque_step", "--engine", "twin", "--plant", plant)
            self.steps_hold(run["figures"], 0.5)

    def test_a_warm_winding_is_beyond_the_voltage_law(self):
        """warm_winding, whose expectations lever_current keeps, on lever: V = R I + V_d, so I is 1/1.2."""
        found = self.run_of("lever", "warm_winding", "--engine", "twin", program="feltgate_twin", status=1)["figures"]
        for n in range(3):
            self.assertLess(abs(found[f"final_error_pct.{n}"] - 100 * (1 / 1.2 - 1)), 1)

    def test_no_error_exceeds_its_bound(self):
        done = ran(BUILD / "feltgate_lever_current", "run", "torque_step", "--design", "lever_current", "--engine",
                   "twin,quad")
        self.assertRegex(self.ended(done).stdout, r"bound, by source .*\nvelocity_n ")


class GimbalCurrent(MotorScene):
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

    def steps_hold(self, found, settled_ms):
        self.assertEqual(found["faults"], 0)
        for n in range(2):
            self.assertLessEqual(found[f"torque_settling_ms.{n}"], settled_ms)
            self.assertLessEqual(abs(found[f"final_error_pct.{n}"]), 0.5)
        self.assertLessEqual(abs(found["torque_final_nm.0"] - 0.03), 1.5e-4)
        self.assertLessEqual(abs(found["torque_final_nm.1"] + 0.01), 5e-5)

    def test_rtl_and_twin_settle_in_0_4_ms(self):
        steps = self.put("steps.toml", self.SCENE)
        self.steps_hold(self.in_lock_step("gimbal_current", steps, "--engine", "rtl,twin,double"), 0.4)

    def test_right_though_the_resistance_is_not(self):
        steps = self.put("steps.toml", self.SCENE)
        for plant in self.resistances("gimbal_motor", 2.9):
            run = self.run_of("gimbal_current", steps, "--engine", "twin", "--plant", plant)
            self.steps_hold(run["figures"], 0.6)

    def test_a_phase_that_opens_is_a_fault(self):
        opens = self.put("opens.toml", self.SCENE + '[[event]]\nat_s = 0.04\nopen_phase = "a"\n')
        found = self.run_of("gimbal_current", opens, "--engine", "twin")["figures"]
        self.assertEqual(found["faults"], 1 << 15)  # current


class HallMotor(MotorScene):
    """Without an alignment: torque before and after an edge of the Hall lines."""

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
    OFFSET, ERROR = "offset_rad = 1.0 ", "hall_error_rad = [0.0, 0.0, 0.0]"

    def plant(self, offset_rad, error_rad=(0.0, 0.0, 0.0)):
        text = text_of("vectors/plants/hall_motor.toml")
        self.assertEqual((text.count(self.OFFSET), text.count(self.ERROR)), (1, 1))
        text = text.replace(self.OFFSET, f"offset_rad = {offset_rad} ")
        return self.put("turned.toml", text.replace(self.ERROR, f"hall_error_rad = {list(error_rad)}"))

    def torques_are_right(self, found, least, error):
        """Shares of what was asked for, before an edge and after one. `error`: of the dead times, mostly."""
        self.assertEqual(found["faults"], 0)
        before, after = found["torque_final_nm.0"] / 0.2, found["torque_final_nm.1"] / -0.2
        self.assertGreater(before, least)
        self.assertLess(before, 1 + error)
        self.assertLess(abs(after - 1), error)

    def test_rtl_and_twin(self):
        steps = self.put("steps.toml", self.SCENE)
        found = self.in_lock_step("hall_motor", steps, "--plant", self.plant(2.7), "--engine", "rtl,twin")
        self.torques_are_right(found, 0.83, 0.04)

    def test_sensors_off_their_places(self):
        steps = self.put("steps.toml", self.SCENE)
        for offset_rad in (0.1, 1.7, 3.3, 4.9):
            plant = self.plant(offset_rad, (0.05, -0.05, 0.03))
            run = self.run_of("hall_motor", steps, "--plant", plant, "--engine", "twin")
            self.torques_are_right(run["figures"], 0.8, 0.045)

    def test_a_plant_without_lines_is_refused(self):
        done = ran(BUILD / "feltgate_hall_motor", "run", "wall", "--design", "hall_motor", "--plant", "gimbal_motor")
        self.ended(done, 2, "plant gimbal_motor has none; give it hall_rad and hall_error_rad")


if __name__ == "__main__":
    unittest.main()
