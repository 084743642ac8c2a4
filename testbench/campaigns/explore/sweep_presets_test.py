#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The shipped presets: designs for use, bit for bit, stable, and what the committed table says.

Documentation: docs/speed-for-accuracy.md
"""

import csv
import os
import tomllib
import unittest

from testing import BUILD, ROOT, Scratch, ran

from exploration import point, points_table, presets, space

WHOLE = "FELTGATE_WHOLE" in os.environ
TABLE = ROOT / "vectors/spaces/trade.csv"


def design_of(name):
    text = (ROOT / f"rtl/designs/{name}.toml").read_text(encoding="utf-8")
    return text, space.flattened(tomllib.loads(text))


class Presets(Scratch):
    def rows(self):
        with TABLE.open(encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def row_of(self, design):
        """The row of the table that sets what the preset sets."""
        base = design_of("lever")[1]
        found = []
        for row in self.rows():
            keys = [key for key in row if "." in key]
            changed = {key: row[key] for key in keys if row[key]}
            shown = {key: points_table.shown(value) for key, value in design.items()}
            if all(str(shown.get(key)) == value for key, value in changed.items()) and all(
                key in changed or design.get(key) == base.get(key, space.OPTIONAL.get(key))
                for key in keys
                if key in design
            ):
                found.append(row)
        self.assertEqual(len(found), 1)
        return found[0]

    def test_stable_and_for_use(self):
        for name in presets.NAMES:
            self.ended(ran(BUILD / "feltgate", "design", name, "--plant", "p24"))

    def test_tabled(self):
        for name in presets.NAMES:
            with self.subTest(name):
                design = design_of(name)[1]
                self.assertIn("gives up", design["description"])
                self.assertEqual(self.row_of(design)["front"], "f")

    def test_equal_to_their_twins_and_as_tabled(self):
        for name in presets.NAMES if WHOLE else ():  # in a usual run point_test.py evaluates a design
            with self.subTest(name):
                text, design = design_of(name)
                result = point.evaluate_design(text, BUILD / "explore/presets", area=False)
                self.assertEqual((result["status"], result["coarse"]), ("ok", False))
                self.assertGreater(result["clocks_compared"], 1_000_000)
                row = self.row_of(design)
                for key in ("torque_error_rms_nm", "velocity_error_rms_rad_s", "delay_s"):
                    self.assertAlmostEqual(result[key] / float(row[key]), 1, delta=0.02, msg=key)


if __name__ == "__main__":
    unittest.main()
