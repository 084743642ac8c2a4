#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Over all commands: old spellings are still understood, schemas are named alike, sizes are told."""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, environment, ran

PROGRAMS = Path(sys.argv.pop()) if len(sys.argv) > 1 else None


@unittest.skipUnless(PROGRAMS, "needs the built programs")
class ProgramTest(Scratch):
    def run_it(self, *words, program="feltgate"):
        if words[0] == "extremes":
            program, words = "feltgate_extremes", words[1:]
        ours = environment(FELTGATE_ROOT=str(ROOT), FELTGATE_PYTHON=sys.executable)
        return ran(PROGRAMS / program, *words, env=ours, stdin=subprocess.DEVNULL)

    def test_old_spellings_do_what_the_new_ones_do(self):
        trace = ROOT / "vectors/traces/membrane.vec"
        texts = []
        for option in ("--duration", "--seconds"):
            done = self.ended(self.run_it("replay", trace, option, "0.01", "--engine", "twin,quad"))
            texts.append(re.sub(r" +\S+x\n", "\n", done.stdout))
        self.assertEqual(*texts)
        self.assertIn("0.010002 s", texts[0])
        # A value that cannot be: the complaint is about the value, not about the option.
        for words, program in (
            (("trim", "membrane", "--threads", "0"), "feltgate"),
            (("--engines", "nonsense"), "feltgate_bench"),
            (("--scenes", "nonsense"), "feltgate_bench"),
        ):
            done = self.ended(self.run_it(*words, program=program), 2)
            self.assertNotIn("option --", done.stderr)
            self.assertRegex(done.stderr, r"^feltgate[ a-z]*: (--threads|.*nonsense)")
        for script in ("demo", "figures"):
            self.ended(self.run_it(script, "--out"), 2, "--out: expected one argument")

    def test_json_of_the_programs(self):
        trace = ROOT / "vectors/traces/membrane.vec"
        for words in (
            ("run", "torque_step", "--engine", "twin"),
            ("replay", trace, "--duration", "0.01", "--engine", "twin"),
            ("extremes", "wrap_32"),
            ("stability", "lever", "--no-bits", "--no-experiments", "--rate", "1000"),
        ):
            with self.subTest(command=words[0]):
                path = self.folder / f"{words[0]}.json"
                self.ended(self.run_it(*words, "--json", path))
                kind = "run" if words[0] == "replay" else words[0]
                found = json.loads(path.read_text(encoding="utf-8"))["schema"]
                self.assertEqual(found, f"feltgate-{kind}/1")

    def test_csv_size_is_told_and_bounded(self):
        path = self.folder / "rows.csv"
        done = self.ended(self.run_it("run", "torque_step", "--engine", "twin,double,float", "--csv", path))
        lines = path.read_text(encoding="utf-8").splitlines()
        header = lines[0].split(",")
        for engine in ("twin", "double", "float"):
            self.assertIn(f"{engine}_velocity_rad_s", header)
        self.assertNotIn("quad_velocity_rad_s", header)
        told = re.match(r"CSV: (\d+) rows of (\d+) columns, up to about", done.stderr)
        self.assertEqual(int(told.group(1)), len(lines) - 1)
        self.assertEqual(int(told.group(2)), len(header))
        self.assertLessEqual(len(lines) - 1, 100_000)

    def test_a_plant_that_does_not_fit_is_told_with_the_command_that_helps(self):
        done = self.run_it("run", "torque_step", "--plant", "p48", "--engine", "twin")
        self.assertLess(done.stdout.index("torque constant"), done.stdout.index("What was felt"))
        command = re.search(
            r"feltgate (design --for-plant p48 --nominal-current AMPERES) -o", done.stdout
        ).group(1)
        made = self.ended(self.run_it(*command.replace("AMPERES", "3.1").split()))
        self.assertIn("torque_constant_nm_a = 0.0603", made.stdout)


if __name__ == "__main__":
    unittest.main()
