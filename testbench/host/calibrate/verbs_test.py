#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""calibrate and identify of feltgate host without a board: readings and recordings of files, among
them those of docs/calibration.md, and a motor that is integrated here."""

import json
import math
import re
import shlex
import unittest

from host_program import BUILD, ROOT, ProgramTest
from testing import ran

PAGE = ROOT / "docs/calibration.md"
COUNT = 2 * math.pi / 4096


def block_after(words):
    """The first block of the page behind these words."""
    text = PAGE.read_text(encoding="utf-8")
    return re.search(r"```\n(.*?)```", text[text.index(words) :], re.S)[1]


def motor(path, plan, every_s=1e-3, r=0.5, kt=0.04, j=1.5e-4, b=2e-4, friction=4e-3, dead=0.5):
    """A recording of a motor: plan of (voltage or None for open gates, seconds)."""
    rows, angle, speed, t, step = ["time_s,position,voltage_v"], 0.0, 0.0, 0.0, 2e-5
    for volts, seconds in plan:
        for n in range(round(seconds / step)):
            if n % round(every_s / step) == 0:
                rows.append(f"{t:.6f},{math.floor(angle / COUNT)},{volts or 0}")
            current = 0.0
            if volts is not None:
                left = volts - kt * speed
                current = math.copysign(max(0.0, abs(left) - dead), left) / r
            torque = kt * current - b * speed
            dry = min(friction, abs(torque)) if speed == 0 else friction
            torque -= math.copysign(dry, speed if speed else torque)
            after = speed + step * torque / j
            speed = 0.0 if after * speed < 0 and volts is None else after
            angle += step * speed
            t += step
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")


class VerbTest(ProgramTest):
    def host(self, *words, status=0, typed=""):
        return self.run_program("feltgate_host", *words, status=status, typed=typed)

    def builds(self, design):
        """The generator accepts it."""
        self.ended(ran(BUILD / "feltgate_generate", ROOT, "--design", design, "-o", self.folder))


class Calibrate(VerbTest):
    def test_the_page(self):
        commands = block_after("no board is needed, and PORT is").strip().splitlines()
        self.assertEqual(len(commands), 2)
        for line in commands:
            words = shlex.split(line.replace("docs/", f"{ROOT}/docs/"))
            self.assertEqual(words[:2], ["feltgate", "host"])
            printed = self.host(*words[2:])
            if line == commands[0]:
                self.assertEqual(printed.strip(), block_after("The first command prints").strip())
        self.builds(self.folder / "mine.toml")
        text = (self.folder / "mine.toml").read_text(encoding="utf-8")
        self.assertIn("kv_low = 1.14", text)

    def test_json_and_design(self):
        readings = ROOT / "docs/examples/open_loop.csv"
        self.host("-", "calibrate", "--from", readings, "--json", "r.json", "--write", "m.toml")
        found = json.loads((self.folder / "r.json").read_text(encoding="utf-8"))
        self.assertEqual(found["schema"], "feltgate-calibrate/1")
        slope = found["slope_nm_v"]
        self.assertTrue(slope["low"] < 0.0302 / 0.42 < slope["high"])
        self.assertEqual([c["key"] for c in found["changes"]],
                         ["motor.resistance_ohm", "voltage.dead_voltage_v"])  # fmt: skip
        self.builds(self.folder / "m.toml")

    def test_an_alignment_gives_pole_pairs_and_offset(self):
        rows = ["commutation_offset, position"]
        for k in [*range(9), *range(8)[::-1]]:
            friction = -2 if k < 8 else 2
            rows.append(f"{k / 8 % 1}, {(k / 8 + 0.25 - 0.6) / 7 * 16384 + friction:.0f}")
        (self.folder / "angles.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
        words = ("--design", "gimbal_motor", "calibrate", "align", "--from", "angles.csv")
        said = self.host("-", *words, "--json", "a.json", "--write", "mine.toml")
        self.assertIn("degrees of an electrical turn", said)
        found = json.loads((self.folder / "a.json").read_text(encoding="utf-8"))
        self.assertEqual(found["procedure"], "align")
        self.assertEqual(found["whole_pole_pairs"], 7)
        self.assertAlmostEqual(found["offset_turns"]["value"], 0.6, delta=0.003)
        self.assertEqual([c["key"] for c in found["changes"]],
                         ["commutation.pole_pairs", "commutation.offset_rad"])
        self.builds(self.folder / "mine.toml")
        self.assertIn("pole_pairs = 7 ", (self.folder / "mine.toml").read_text(encoding="utf-8"))
        for words, needle in (
            (("calibrate", "align", "--from", "angles.csv"), "lever drives no motor with three phases"),
            (("calibrate", "align"), "has no board; give the port, or the readings with --from FILE"),
            (("calibrate", "align", "--from", "angles.csv", "--voltage", "1"), "leave out --from"),
            (("calibrate", "--from", "angles.csv", "--voltage", "1"), "belongs to calibrate align"),
        ):
            with self.subTest(words):
                self.assertIn(needle, self.host("-", *words, status=2))

    def test_bad_input(self):
        for words, typed, needle in (
            (("calibrate",), "", "has no board; give the port, or the readings with --from"),
            (("calibrate", "--from", "none.csv"), "", "cannot be read"),
            (("calibrate", "--from", "-"), "v torque\n1 2\n", "1 readings; take at least 3"),
            (("calibrate", "--from", "-"), "v torque\n1 2\n1 2\n1 3\n", "only 1 different voltage"),
            (("calibrate", "--from", "-"), "v torque\n1 x\n", "standard input:2: torque"),
            (("calibrate", "--from", "-", "--save", "x"), "", "leave out --from"),
            (("calibrate", "magnet", "--from", "-"), "", "align"),
            (("calibrate", "--from", "-", "--confidence", "1"), "", "--confidence"),
            (("identify",), "", "has no board"),
            (("identify", "--from", "-", "--save", "x"), "", "--coast belongs to --from FILE"),
            (("identify", "--from", "-"), "t,position,v\n0,0,0\n", "1 rows; record at least 64"),
            (("--design", "levr", "calibrate", "--from", "-"), "", "did you mean"),
        ):
            with self.subTest(words):
                self.assertIn(needle, self.host("-", *words, typed=typed, status=2))
        self.assertEqual(list(self.folder.iterdir()), [])


class Identify(VerbTest):
    def test_constants_of_a_motor_that_is_not_ours(self):
        plan = [(v, 0.2) for v in (5, -5, 3, -3, 7, -7, 4, -6)]
        motor(self.folder / "drive.csv", plan)
        motor(self.folder / "coast.csv", [(7, 0.5), (None, 2)])
        said = self.host(
            "-", "identify", "--from", "drive.csv", "--coast", "coast.csv", "--resistance", 0.5,
            "--json", "i.json", "--write", "mine.toml",
        )  # fmt: skip
        self.assertIn("J R/Kt", said)
        found = json.loads((self.folder / "i.json").read_text(encoding="utf-8"))
        self.assertEqual(found["schema"], "feltgate-identify/1")
        truths = {
            "ke_v_s_rad": 0.04,
            "inertia_kg_m2": 1.5e-4,
            "damping_nm_s_rad": 2e-4,
            "friction_nm": 4e-3,
            "dead_voltage_v": 0.5,
        }
        for name, truth in truths.items():
            with self.subTest(name):
                self.assertAlmostEqual(found["constants"][name]["value"] / truth, 1, delta=0.02)
        self.assertEqual(found["next"], [])
        self.builds(self.folder / "mine.toml")

    def test_alone_it_says_what_is_next(self):
        motor(self.folder / "drive.csv", [(v, 0.2) for v in (5, -5, 3, -3, 7, -7)])
        said = self.host("-", "identify", "--from", "drive.csv")
        self.assertIn("none yet: these recordings give products", said)
        self.assertIn("next: a coast-down", said)
        self.assertIn("next: nothing here tells J from R", said)
        said = self.host("-", "identify", "--from", "drive.csv", "--write", "x.toml", status=2)
        self.assertIn("nothing was found that design lever has a key for", said)
        self.assertFalse((self.folder / "x.toml").exists())


if __name__ == "__main__":
    unittest.main()
