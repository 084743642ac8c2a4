# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate claims: figures against numbers that are written here or come from another formula, all rows against the
record, verdicts, and the command. A changed record: feltgate claims --markdown > testbench/studies/claims/claims.md"""

import json
import math
import os
import re
import unittest

from testing import BUILD, Scratch, called, text_of

os.environ["FELTGATE_PROGRAM"] = str(BUILD / "feltgate")
import claims

# Claim, figure, column, value, share: by hand, or by another formula.
RIGHT = (
    ("dob_settling", "observed torque settles", "closed_form", 3.912023 / 0.39168, 1e-3),
    ("dob_settling", "observed torque settles", "simulated", 9.988, 2e-3),
    ("inertia", "J", "closed_form", 4.88033e-4, 1e-3),
    ("window", "a count's peak behind the low-pass", "simulated", 0.702, 2e-3),
    ("velocity_gain", "gain error, m1 = 386, n = 2", "simulated", 0.6532, 0.01),
    ("n_method", "ripple of the N-method, rms", "simulated", 0.02197, 0.02),
    ("cutoff_equal", "false load at wc = g, share of the step", "simulated", 0.386, 0.05),
    ("half_nm_of_7_a", "motor current", "simulated", 0.5 / 0.0302, 2e-3),
    ("half_nm_of_7_a", "current from the source", "closed_form", 16.5563 * 7.29364 / 24, 1e-3),
    ("half_nm_of_7_a", "torque from a source of 4 A", "simulated", 0.3975, 5e-3),
    ("kv_error", "error at 0.1 Nm, Kv = 1.25", "simulated", 24.3, 0.01),
    ("kv_border", "change of the torque as the reference rises", "closed_form", -0.743802 * 71.90476, 1e-3),
    ("slopes", "measured, 48 V winding", "simulated", 0.0483, 5e-3),
    ("transparency", "felt", "closed_form", math.sqrt(6.8112**2 + 3.5**2), 1e-3),
    ("noise_not_rate", "rms with noise", "simulated", 2 * 360 / 7.2 * 0.1, 0.05),  # 11.459 Nm/rad, 0.8727 mrad
    ("ceiling", "jitter at 700 N/m", "simulated", 4.2 * 0.872665 * 0.57735, 0.05),
    ("encoder_wall", "friction that it needs", "closed_form", 360 / 16.384, 1e-3),
    ("pole_pairs", "ripple of six steps", "simulated", 100 * (1 - math.sqrt(3) / 2), 1e-3),
    ("recognition", '52 above always "fish", standard deviations', "closed_form", 18 / math.sqrt(17.4857), 1e-3),
    ("walls_50", "stiffest wall then", "simulated", 50, 0.01),
    ("damping_003", "largest damping", "simulated", 35.26, 0.15),
    ("two_controllers", "stiffest wall", "simulated", 141.667 / 4.180556, 0.01),
    ("maxon", "torque at 2.1 V", "closed_form", 3.36, 1e-9),
    ("border", "bv 0.1 Ns/m at 1 kHz", "simulated", 205.55, 1e-4),
    ("border", "206 N/m with 10 g", "simulated", 203.96, 1e-4),
    ("margin", "growth at 103 N/m", "simulated", -(0.103 - 0.0515) / 0.09, 0.01),
    ("phantom_z_width", "at 100 Hz", "closed_form", 206 / (0.003 * 628.3185), 1e-3),
    ("plugin_value", "full scale, least", "closed_form", 274.667, 1e-3),
    ("zeta", "zeta", "simulated", 0.103 / (0.09 * 67.6593), 5e-3),
    ("saturation", "depth at 3.3 N", "simulated", 16.0194, 0.02),
    ("force_shading", "reduction, 8 facets", "simulated", 41.4, 0.01),
    ("triangles", "jump, 8000 over 122 700 triangles", "simulated", 31 / 8, 0.03),
    ("mesh", "handles of one closed object", "closed_form", 1 - (61324 - 184050 + 122700) / 2, 1e-9),
    ("quaternion", "left by qd^-1 qo", "simulated", 180, 0.01),
    ("texture_stiffness", "texels of 0.01 mm, factor", "simulated", 300 * math.sqrt(2), 1e-4),
    ("texture_force", "upward", "simulated", 1.14, 1e-6),
    ("forty_khz", "`lever` at 1 kHz", "simulated", 5.72, 0.01),
    ("bow", "degrees, a line of hair", "simulated", 5, 0))
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?")


class Claims(Scratch):
    def test_figures_record_and_json(self):
        status, page, said = called(self.main, "--markdown", "--json", self.folder / "claims.json")
        self.assertEqual(status, 0, said)
        rows = {row["name"]: row for row in json.loads((self.folder / "claims.json").read_text(encoding="utf-8"))["claims"]}
        for name, what, column, value, share in RIGHT:
            found, = (f[column] for f in rows[name]["figures"] if f["what"] == what)
            self.assertLessEqual(abs(found - value), share * abs(value), f"{name}, {what}: {found}, {value}")
        record = text_of("testbench/studies/claims/claims.md")
        self.assertEqual(NUMBER.sub("#", page), NUMBER.sub("#", record))
        for now, then in zip(NUMBER.findall(page), NUMBER.findall(record), strict=True):  # another compiler rounds otherwise
            self.assertAlmostEqual(float(now), float(then), delta=max(0.01 * abs(float(then)), 1e-3), msg=f"{now}, {then}")
        self.assertIn("39 claims: 6 hold, 19 hold under a condition, 14 cannot be had.", page)

    @staticmethod
    def main(*words):
        claims.sys.argv = ["claims", *map(str, words[0])]
        return claims.main()

    def test_verdicts_and_unknown_names(self):
        for agree, given, said in (((True, True), (False, True), "holds"), ((False, True), (False, True), "holds if"),
                                   ((True, False), (True, True), "cannot be had"), ((), (), "cannot be had")):
            figures = [{"agrees": a, "conditional": g} for a, g in zip(agree, given)]
            self.assertEqual(claims.verdict([*figures, {"asked": "nothing"}]), said)
        self.assertEqual(called(self.main, "windw")[0], 2)


if __name__ == "__main__":
    unittest.main()
