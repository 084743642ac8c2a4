#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Numbers of the figures against values worked out by hand. Documentation: docs/figures.md"""

import unittest
from types import SimpleNamespace

import numpy as np

import testing  # noqa: F401, isort: skip (puts scripts/ on the path)
from reports import measure, objects, observer_section


class Laws(unittest.TestCase):
    def test_membrane_pushes_against_the_side_of_entry(self):
        theta = np.array([0.9, 0.6, 0.55, 0.4, 0.6, 0.8])
        torque = measure.ideal_torque("membrane", "lever", theta, 0 * theta)
        np.testing.assert_allclose(torque, [0, 0.5, 0.5, 0, -0.5, 0])

    def test_springs(self):
        theta = np.array([-0.2, 0.0, 0.25, 0.5, 1.0, 3.0])
        push = measure.ideal_torque("spring_compression", "lever", theta, 0 * theta)
        np.testing.assert_allclose(push, [0.5, 0.5, 0.25, 0, 0, 0])
        pull = measure.ideal_torque("spring_tension", "paper", theta, 0 * theta)
        np.testing.assert_allclose(pull, [0, 0, -0.125, -0.25, -0.5, -0.5])

    def test_wall_pushes_and_never_pulls(self):
        theta = np.array([0.4, 0.6, 0.6, 0.51])
        torque = measure.ideal_torque("wall", "lever", theta, np.array([5.0, 0.0, 5.0, -20.0]))
        np.testing.assert_allclose(torque, [0, -0.4, -0.425, 0])

    def test_damper_opposes_motion(self):
        torque = measure.ideal_torque("damper", "lever", np.zeros(3), np.array([1.0, -2.0, 100.0]))
        np.testing.assert_allclose(torque, [-0.03, 0.06, -0.5])

    def test_charge_core_only_in_lever(self):
        theta = np.array([1.0, 0.2, 0.1, 0.0, -1.0])
        repel = measure.ideal_torque("charge_repel", "lever", theta, 0 * theta)
        np.testing.assert_allclose(repel, [0.02, 0.5, 0.25, 0, -0.02])
        attract = measure.ideal_torque("charge_attract", "paper", theta, 0 * theta)
        np.testing.assert_allclose(attract, [-0.02, -0.5, -0.5, -0.5, 0.02])

    def test_pole_of_the_observer(self):
        self.assertAlmostEqual(measure.observer_pole("paper"), 391.68, places=6)
        self.assertAlmostEqual(measure.observer_pole("lever"), 500.0)

    def test_dead_time_takes_half_a_microsecond_of_each_period(self):
        self.assertAlmostEqual(measure.dead_time_v("paper"), 0.24)


class Numbers(unittest.TestCase):
    def test_lag_between_rows(self):
        time = np.arange(0, 1, 1e-4)
        found = measure.lag_s(time, np.sin(20 * (time - 2.345e-3)), np.sin(20 * time))
        self.assertAlmostEqual(found, 2.345e-3, delta=2e-6)

    def test_ripple_leaves_the_vibration_and_drops_the_ramp(self):
        time = np.arange(0, 0.2, 5e-5)
        vibration = np.sin(2 * np.pi * 1000 * time)
        found = measure.ripple(time, 3 * time + vibration)
        self.assertAlmostEqual(measure.rms(found), 2**-0.5, delta=0.01)
        self.assertLess(measure.rms(measure.ripple(time, 3 * time)), 1e-4)


class Objects(unittest.TestCase):
    """The rows of the figures, of runs whose torque is the ideal one."""

    def rows(self, scene, from_rad, to_rad):
        time = np.linspace(0, 2, 20_000)
        theta = from_rad + (to_rad - from_rad) * (time / 2) ** 2
        omega = np.gradient(theta, time)
        ideal = measure.ideal_torque(scene, "lever", theta, omega)
        view = objects.View(scene, "lever", "lever", time, theta, omega, ideal, ideal, ideal, ideal)
        rows = {}
        getattr(objects, scene)(SimpleNamespace(add=lambda key, values: rows.update({key: values.get("lever")})), [view])
        return rows

    def test_each_object(self):
        for scene, span, wanted in (
            ("membrane", (0.9, 0.3), {"torque_inside_nm": 0.5, "upper_edge_rad": 0.7, "lower_edge_rad": 0.5}),
            ("spring_compression", (1, 0), {"stiffness_nm_rad": 1, "contact_rad": 0.498, "largest_torque_nm": 0.5}),
            ("spring_tension", (0, 2), {"stiffness_nm_rad": 0.5, "saturates_rad": 1, "largest_torque_nm": -0.5}),
            ("damper", (0, 3), {"largest_torque_nm": 0.09, "largest_speed_rad_s": 3, "damping_nm_s_rad": 0.03}),
            ("charge_attract", (1.5, 0.05), {"exponent": -2, "limit_rad": 0.202, "largest_torque_nm": -0.5}),
            ("charge_repel", (0.05, 1.5), {"exponent": -2, "limit_rad": 0.202, "largest_torque_nm": 0.5}),
        ):
            found = self.rows(scene, *span)
            for key, value in wanted.items():
                self.assertAlmostEqual(found[key], value, delta=2e-3, msg=f"{scene}, {key}")

    def test_numbers_of_a_load_step(self):
        time = np.arange(0, 0.35, 1e-4)
        after = np.maximum(time - observer_section.LOAD_S, 0)
        theta = 0.04 + 0.02 * (1 - np.exp(-after / 0.02) * np.cos(200 * after))
        torque = 0.1 + 0.001 * (-1) ** np.arange(len(time))
        csv = {"time_s": time, "theta_rad": theta, "motor_torque_nm": torque}
        ripple, over, rest = observer_section.of_load(SimpleNamespace(csv=csv))
        self.assertAlmostEqual(ripple, 1, places=3)
        self.assertAlmostEqual(over, 47.0, delta=0.5)  # at 14.5 ms
        self.assertLess(abs(rest - 47), 10)  # 0.02 exp(-t / 0.02) is a count after 51 ms


if __name__ == "__main__":
    unittest.main()
