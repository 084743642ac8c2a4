#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The design first_power differs from lever in what it has to and in nothing else. docs/boards/first-hour.md"""

import tomllib
import unittest

from testing import text_of

from exploration import space

# Key of first_power: at most this. What is in neither list has to be lever's.
LOWERED = {
    "control.torque_limit_nm": 0.05,
    "control.current_limit_a": 2.0,
    "control.ramp_nm_s": 0.5,
    "motor.motor_current_limit_a": 2.2,
    "supervisor.overspeed_rad_s": 30.0,
    "supervisor.nominal_current_a": 2.0,
    "supervisor.i2t_budget_a2_s": 12.0,
    "scenes.membrane_nm": 0.05,
    "scenes.compression_nm_rad": 0.1,
    "scenes.tension_nm_rad": 0.1,
    "scenes.damper_nm_s_rad": 0.005,
    "scenes.charge_nm_rad2": 0.002,
    "scenes.wall_nm_rad": 0.5,
    "scenes.wall_nm_s_rad": 0.001,
}
OTHER = {"description", "self_test.mode", "pwm.shortest_pulse_s"}


def design(name):
    return space.flattened(tomllib.loads(text_of(f"rtl/designs/{name}.toml")))


def findings(first, lever):
    found = [f"{k}: only in one of them" for k in (first.keys() ^ lever.keys()) - OTHER]
    for key in first.keys() & lever.keys():
        if key in LOWERED:
            if first[key] > LOWERED[key] or first[key] >= lever[key]:
                found.append(f"{key} = {first[key]}: more than {LOWERED[key]}")
        elif key not in OTHER and first[key] != lever[key]:
            found.append(f"{key} = {first[key]}: lever has {lever[key]}")
    if first["self_test.mode"] != "on":
        found.append("self_test.mode is not on")
    return found


class Design(unittest.TestCase):
    def test_only_what_has_to_be_is_lower(self):
        self.assertEqual(findings(design("first_power"), design("lever")), [])

    def test_no_scene_asks_for_more_than_the_limit_where_it_begins(self):
        first = design("first_power")
        most = first["control.torque_limit_nm"]
        self.assertLessEqual(first["scenes.membrane_nm"], most)
        peak = first["scenes.charge_nm_rad2"] / first["scenes.charge_core_rad"] ** 2
        self.assertLessEqual(peak, most * 1.001)
        self.assertLessEqual(first["self_test.torque_nm"], most)


if __name__ == "__main__":
    unittest.main()
