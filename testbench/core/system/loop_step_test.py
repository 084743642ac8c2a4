# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate run torque_step --design lever_current: RTL and twin in lock-step, the time to 2 % of each
step; a warm winding on `lever`; and the error bounds, with chains in real arithmetic that take the
measured current too."""

import json
import unittest

from testing import BUILD, Scratch, ran

PROGRAM = BUILD / "feltgate_lever_current"


class LoopStep(Scratch):
    def test_settles_in_0_35_ms(self):
        out = self.folder / "run.json"
        self.ended(ran(PROGRAM, "run", "torque_step", "--design", "lever_current", "--quiet", "--json",
                       out, "--engine", "rtl,twin,double"))
        found = json.loads(out.read_text(encoding="utf-8"))["figures"]
        self.assertEqual(found["mismatches"], 0)
        self.assertEqual(found["faults"], 0)
        for n in range(3):
            self.assertLessEqual(found[f"torque_settling_ms.{n}"], 0.35)
            self.assertLessEqual(abs(found[f"final_error_pct.{n}"]), 1)
            self.assertLessEqual(abs(found[f"tau_hat_final_error_nm.{n}"]), 1e-3)

    def test_a_warm_winding_is_beyond_the_voltage_law(self):
        """warm_winding, whose expectations lever_current keeps, on lever: V = R I + V_d, so I is 1/1.2."""
        out = self.folder / "lever.json"
        self.ended(ran(BUILD / "feltgate_twin", "run", "warm_winding", "--design", "lever", "--engine",
                       "twin", "--quiet", "--json", out), 1)
        found = json.loads(out.read_text(encoding="utf-8"))["figures"]
        for n in range(3):
            self.assertLess(abs(found[f"final_error_pct.{n}"] - 100 * (1 / 1.2 - 1)), 1)

    def test_no_error_exceeds_its_bound(self):
        done = ran(PROGRAM, "run", "torque_step", "--design", "lever_current", "--engine", "twin,quad")
        self.assertRegex(self.ended(done).stdout, r"bound, by source .*\nvelocity_n ")


if __name__ == "__main__":
    unittest.main()
