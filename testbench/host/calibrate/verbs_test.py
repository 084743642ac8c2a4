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
            (("calibrate", "--from", "-"), "v torque\n1 2\n1 2\n1 3\n", "only 1 different voltage"),
            (("calibrate", "--from", "-"), "v torque\n1 x\n", "standard input:2: torque"),
            (("identify", "--from", "-"), "t,position,v\n0,0,0\n", "1 rows; record at least 64"),
            (("--design", "levr", "calibrate", "--from", "-"), "", "did you mean"),
        ):
            with self.subTest(words):
                self.assertIn(needle, self.host("-", *words, typed=typed, status=2))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_what_a_verb_reads_is_not_replaced(self):
        csv = self.folder / "coast.csv"
        csv.write_text("t,position,v\n0,0,0\n")
        for option in ("--write", "--json"):
            words = ("identify", "--from", "-", "--coast", csv, option, csv)
            self.assertIn("would replace", self.host("-", *words, status=2))
        self.assertEqual(csv.read_text(), "t,position,v\n0,0,0\n")


if __name__ == "__main__":
    unittest.main()
