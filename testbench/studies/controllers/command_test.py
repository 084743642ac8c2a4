# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate controllers as a user calls it: its tables are those on record, JSON and picture are
whole, and the PID of the page, as a law, settles like the command's PID."""

import json
import os
import re
import sys
import unittest

from testing import BUILD, Scratch, ran, text_of

PROGRAM, WITH_ENGINE = BUILD / "feltgate", BUILD / "feltgate_lever_law"
TABLES = "testbench/studies/controllers/tables.md"
PAGE = "docs/speed-for-accuracy.md"
SCENE = """title = "PID at stall"
about = "A law keeps a torque by a PID on tau_hat."
duration_s = 0.06
[core]
scene = "law"
law = "./pid.law"
arm_s = 0.002
[parameters]
wanted = 0.0
[[event]]
at_s = 0.02
set = { wanted = 0.2 }
step_nm = 0.2
[hand]
[[hand.phase]]
kind = "locked"
"""


class Controllers(Scratch):
    def call(self, *words, program=PROGRAM):
        environment = {**os.environ, "FELTGATE_PYTHON": sys.executable}
        return ran(program, *words, cwd=self.folder, env=environment)

    def test_page_json_and_picture(self):
        done = self.ended(self.call("controllers", "--json", "a.json", "-o", "a.svg"))
        for table in done.stdout.split("\n\n"):
            self.assertIn(table.strip(), text_of(TABLES), f"{TABLES} is stale: paste this table")
        data = json.loads((self.folder / "a.json").read_text(encoding="utf-8"))
        self.assertEqual(data["schema"], "feltgate-controllers/1")
        of = {one["name"]: one for one in data["controllers"]}
        self.assertEqual(
            list(of), ["observer", "feed-forward", "PI", "PID", "reaction observer"]
        )
        budget = json.loads(text_of("docs/verification/areas.json"))["figures"]["lever"]
        observer, estimator, window = (
            budget[b]["lut4_equivalents"] for b in ("observer", "velocity_estimator", "travel_window")
        )
        lowpass = estimator - window
        for name, filters in (("observer", 0), ("PI", 1), ("PID", 2), ("reaction observer", 1)):
            self.assertEqual(of[name]["lut4_measured"], observer)
            self.assertEqual(of[name]["lut4_equivalents"], observer + filters * lowpass)
        # PI is the observer at stall, to a clock of the duty; 1.73 mNm.
        pairs = zip(of["PI"]["stall_nm"], of["observer"]["stall_nm"], strict=True)
        self.assertLess(max(abs(a - b) for a, b in pairs), 2e-3)
        self.assertGreater(len(of["PI"]["stall_nm"]), 350)
        svg = (self.folder / "a.svg").read_text(encoding="utf-8")
        for word in (*of, "largest wall, Nm/rad", "motor torque, mNm", "noise, mNm rms"):
            self.assertIn(word, svg)

    def test_a_design_with_mt(self):
        text = re.sub(r"^(m1|n) = .*\n", "", text_of("rtl/designs/lever.toml"), flags=re.M)
        keys = 'estimator = "mt"\nwindow_s = 386e-6\ncycles = 16'
        path = self.put("spans.toml", text.replace("[velocity]", f"[velocity]\n{keys}"))
        done = self.ended(self.call("design", path))
        self.assertIn("M/T over whole encoder cycles, 386 us or more, up to 16", done.stdout)
        for words in (
            ("design", path, "--plant", "p24"),
            ("stability", path, "--no-bits"),
        ):
            with self.subTest(words=words):
                self.ended(self.call(*words), 2, "knows the N-method alone; take estimator")

    def test_the_law_of_the_page(self):
        (law,) = re.findall(r"```law\n(.*?)```", text_of(PAGE), re.S)
        self.put("pid.law", law)
        self.put("pid.toml", SCENE)
        done = self.call(
            *("run", "pid.toml", "--design", "lever_law", "--engine", "twin,double"),
            *("--json", "b.json"),
            program=WITH_ENGINE,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = json.loads((self.folder / "b.json").read_text(encoding="utf-8"))["figures"]
        # 6.98 ms by partial fractions, a run of the law and the last clock of the duty later.
        self.assertAlmostEqual(figures["torque_settling_ms.0"], 7.4, delta=0.2)
        self.assertLess(abs(figures["final_error_pct.0"]), 0.5)


if __name__ == "__main__":
    unittest.main()
