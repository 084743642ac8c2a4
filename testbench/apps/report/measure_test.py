#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Numbers of the figures against values worked out by hand. Documentation: docs/figures.md"""

import unittest

import bench  # noqa: F401, isort: skip (puts scripts/ on the path)
import numpy as np
from reports import measure, page, plots


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
    def test_slope(self):
        self.assertAlmostEqual(measure.slope([1, 2, 4], [5, 7, 11])[0], 2)

    def test_zero_crossing(self):
        self.assertAlmostEqual(measure.zero_crossing([0.1, 0.2, 0.3], [-1, 1, 2]), 0.15)
        self.assertIsNone(measure.zero_crossing([0.1, 0.2], [1, 2]))

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

    def test_thinned_line_keeps_its_peaks(self):
        y = np.zeros(100_000)
        y[54_321], y[70_000] = 7, -9
        x, thin = plots.thinned(np.arange(100_000), y)
        self.assertLess(len(x), 2 * plots.POINTS + 3)
        self.assertEqual((thin.max(), thin.min()), (7, -9))
        self.assertTrue(np.all(np.diff(x) > 0))


class Text(unittest.TestCase):
    def test_number(self):
        for value, text in (
            (0, "0"),
            (0.05, "0.0500"),
            (-1.5, "−1.50"),
            (12345.6, "12,346"),
            (2.5e-5, "0.000025"),
            (-3.2e-9, "≈ 0"),
            (None, "–"),
        ):
            self.assertEqual(page.number(value), text)


if __name__ == "__main__":
    unittest.main()
