#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""docs/boards/first-hour.md against the register map and the design first_power, which differs
from lever in what it has to and in nothing else.
"""

import re
import tomllib
import unittest

from testing import text_of

from exploration import space

PAGE = text_of("docs/boards/first-hour.md")
MAP = tomllib.loads(text_of("rtl/registers.toml"))
LOOK = 15

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


def table(text):
    """{number: (scene, zero, what it does)} of the table of the scenes."""
    rows = re.findall(r"^\| ([01]{4}) \| (.+?) \| (.*?) \| (.*?) \| .*\|$", text, re.M)
    return {int(bits, 2): words for bits, *words in rows}


def scenes():
    """Those of the board's design, which has no engine for a law."""
    return {s["number"]: s["name"] for s in MAP["scene"] if s["name"] != "law"}


class Design(unittest.TestCase):
    def test_only_what_has_to_be_is_lower(self):
        self.assertEqual(findings(design("first_power"), design("lever")), [])

    def test_a_change_is_found(self):
        lever = design("lever")
        for key, value in (
            ("control.torque_limit_nm", 0.2),
            ("motor.resistance_ohm", 0.3),
            ("self_test.mode", "off"),
            ("scenes.wall_nm_rad", 4.0),
        ):
            found = findings(design("first_power") | {key: value}, lever)
            self.assertEqual(len(found), 1, found)
            self.assertIn(key, found[0])

    def test_no_scene_asks_for_more_than_the_limit_where_it_begins(self):
        first = design("first_power")
        most = first["control.torque_limit_nm"]
        self.assertLessEqual(first["scenes.membrane_nm"], most)
        peak = first["scenes.charge_nm_rad2"] / first["scenes.charge_core_rad"] ** 2
        self.assertLessEqual(peak, most * 1.001)
        self.assertLessEqual(first["self_test.torque_nm"], most)


class Page(unittest.TestCase):
    def test_every_scene_has_its_switches(self):
        rows = table(PAGE)
        self.assertIn("encoder on the lamps", rows.pop(LOOK)[0])
        self.assertEqual({n: words[0] for n, words in rows.items()}, scenes())

    def test_the_values_are_those_of_the_design(self):
        first, rows = design("first_power"), table(PAGE)
        by_name = {words[0]: words[2] for words in rows.values()}
        for scene, keys in (
            ("membrane", ("membrane_nm", "membrane_lower_rad", "membrane_upper_rad")),
            ("spring_compression", ("compression_nm_rad", "compression_contact_rad")),
            ("spring_tension", ("tension_nm_rad",)),
            ("damper", ("damper_nm_s_rad",)),
            ("charge_attract", ("charge_core_rad",)),
            ("wall", ("wall_nm_rad", "wall_contact_rad")),
        ):
            for key in keys:
                self.assertRegex(by_name[scene], rf"(?<![\d.]){first[f'scenes.{key}']:g}(?![\d.])",
                                 key)
        for key in ("tension_rest_rad", "charge_centre_rad"):
            self.assertEqual(first[f"scenes.{key}"], 0.0)


if __name__ == "__main__":
    unittest.main()
