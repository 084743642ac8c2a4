#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""calibrate and identify of feltgate host without a board: readings and recordings of files, among
them those of docs/calibration.md, and a motor that is integrated here."""

import json
import math
import random
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


# Half a degree of a magnet off its axis, and a second harmonic: cosine 1, sine 1, cosine 2, sine 2.
ERROR_MRAD = (7.5, 4.5, -1.2, 0.9)
ANGLE_COUNT = 2 * math.pi / 16384


def shown(angle):
    """What an absolute encoder of 14 bits with this error and half a count of noise shows."""
    seen = angle
    for _ in range(8):  # the error is of what it shows
        terms = (
            e * (math.sin if k % 2 else math.cos)((k // 2 + 1) * seen)
            for k, e in enumerate(ERROR_MRAD)
        )
        seen = angle + 1e-3 * sum(terms)
    return math.floor(seen / ANGLE_COUNT + random.gauss(0, 0.5))


def turn(path, seed, fastest=60, slower=20):
    """A shaft that runs down: dry friction takes `slower` rad/s in a second. Gives its angles."""
    random.seed(seed)
    times = [k * 1e-3 for k in range(round(1e3 * fastest / slower))]
    angles = [seed + fastest * t - slower * t * t / 2 for t in times]
    rows = [f"{t:.3f},{shown(a)}" for t, a in zip(times, angles)]
    path.write_text("time_s,position\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return angles


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

    def test_forces_and_the_input(self):
        rows = "v;force_n\n1.5;3.4\n2.5;9.9\n3.5;16.5\n4.5;23.0\n"
        said = self.host("-", "calibrate", "--from", "-", "--arm", 0.011, typed=rows)
        self.assertIn("slope", said)
        said = self.host("-", "calibrate", "--from", "-", typed=rows, status=2)
        self.assertIn("forces need the arm of the pulley", said)

    def test_the_table_of_an_encoder_is_right_on_another_seed(self):
        turn(self.folder / "turn.csv", seed=1)
        words = ("--design", "lever_absolute", "calibrate", "encoder", "--from")
        said = self.host("-", *words, "turn.csv", "--json", "e.json", "--write", "mine.toml")
        self.assertIn("turns at", said)
        found = json.loads((self.folder / "e.json").read_text(encoding="utf-8"))
        self.assertEqual(found["procedure"], "encoder")
        self.assertEqual(found["warnings"], [])
        self.assertEqual([c["key"] for c in found["changes"]], ["absolute_encoder.error_mrad"])
        terms = found["changes"][0]["value"]
        for value, truth in zip(terms, ERROR_MRAD + (0,) * 4):
            self.assertAlmostEqual(value, truth, delta=0.1)
        # Its table, as the generator has it, on another turn.
        self.builds(self.folder / "mine.toml")
        header = (self.folder / "mine.hpp").read_text(encoding="utf-8")
        entries = re.search(r"corrections\[256\] = {(.*?)}", header, re.S)[1]
        table = [int(n) for n in entries.split(",")]
        self.assertEqual(len(table), 256)
        before, after = [], []
        for angle in turn(self.folder / "again.csv", seed=2, fastest=40):
            count = shown(angle)
            part, at = count % 64, count // 64 % 256
            correction = table[at] * (64 - part) + table[(at + 1) % 256] * part
            before.append(count * ANGLE_COUNT - angle)
            after.append((count + (correction + 2048 >> 12)) * ANGLE_COUNT - angle)

        def mean_square(values):
            mean = sum(values) / len(values)
            return math.sqrt(sum((v - mean) ** 2 for v in values) / len(values))

        # A tenth, and what noise and rounding to counts leave of a perfect encoder.
        self.assertLess(mean_square(after), mean_square(before) / 10 + 0.6 * ANGLE_COUNT)
        # The other turn gives nearly the same.
        said = self.host("-", *words, "again.csv", "--harmonics", "2")
        self.assertIn("error_mrad = [7.", said)

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

    def test_encoders_without_a_table(self):
        turn(self.folder / "turn.csv", seed=1)
        for words, needle in (
            (("calibrate", "encoder", "--from", "turn.csv"), "lever has no absolute encoder"),
            (("calibrate", "encoder"), "needs a recorded turn"),
            (("calibrate", "magnet", "--from", "turn.csv"), "encoder"),
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
            (("calibrate", "--from", "-", "--confidence", "1"), "", "--confidence"),
            (("identify",), "", "has no board"),
            (("identify", "--from", "-", "--loaded", "x"), "", "go together"),
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
