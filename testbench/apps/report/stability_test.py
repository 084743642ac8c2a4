#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Pictures of a stability study. Documentation: docs/speed-for-accuracy.md"""

import unittest

from testing import Scratch

from reports import stability_plots


def border(rate, damping, stiffness, bits):
    return {
        "rate_hz": rate,
        "damping_nm_s_rad": damping,
        "eigenvalues_nm_rad": stiffness,
        "bits_nm_rad": bits,
        "closed_nm_rad": 1.1 * stiffness,
        "z_width": 2 * stiffness,
    }


STUDY = {
    "design": "lever",
    "encoder_rule_nm_rad": 4.56,
    "locus_damping_nm_s_rad": 0.005,
    "borders": [
        border(144, 0.0, 0, None),
        border(144, 0.001, 0.27, 0.271),
        border(1e6, 0.001, 6.07, None),
    ],
    "locus": [{"stiffness_nm_rad": 1.0, "poles_rad_s": [[-20.0, 90.0], [-500.0, 0.0]]}],
}


class Stability(Scratch):
    def test_pictures_of_a_study_with_gaps(self):
        drawn = stability_plots.pictures(STUDY, png=True)
        self.assertEqual([p.name for p in drawn], ["stability_k_b", "stability_locus"])
        for picture in drawn:
            self.assertTrue(picture.svg.startswith("<svg"))
            self.assertGreater(len(picture.png), 1000)
        self.assertIn("144 Hz", drawn[0].svg)
        self.assertIn("1 MHz", drawn[0].svg)


if __name__ == "__main__":
    unittest.main()
