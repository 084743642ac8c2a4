# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Every point of the committed sweep against the proven bounds of its design, computed anew."""

import csv
import json
import unittest
from pathlib import Path

from testing import ROOT, Scratch

from exploration import point
from exploration.design_text import design_text

TABLE = ROOT / "vectors/spaces/trade.csv"
BASE = "lever"


def value(text):
    try:
        return json.loads(text)
    except ValueError:
        return text


def changes(row):
    """What the point sets: the columns that are keys of a design."""
    return {key: value(text) for key, text in row.items() if "." in key and text}


class Bounds(Scratch):
    def check(self, row, folder):
        """The bounds of a row's design; the row's errors must keep them."""
        design = Path(folder) / "point.toml"
        design.write_text(design_text(ROOT, {"base": BASE, "set": changes(row)}), encoding="utf-8")
        result = {key: value(text) for key, text in row.items()}
        found = point.bounds(design, result)
        self.assertEqual(found["bound_without"], [], row["id"])
        for name in point.BOUNDED:
            error, bound = point.measured(result, name), found[f"bound_{name}"]
            self.assertLessEqual(error, bound, f"{row['id']} {name} {changes(row)}")
        return found

    def test_no_measured_error_exceeds_its_bound(self):
        with TABLE.open(encoding="utf-8", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["status"] == "ok"]
        self.assertGreaterEqual(len(rows), 200)
        tightest = 0.0
        for row in rows:
            found = self.check(row, self.folder)
            error = float(row["torque_error_max_nm"])
            tightest = max(tightest, error / found["bound_torque_nm"])
        # A bound that nothing comes near would hold whatever the RTL did.
        self.assertGreater(tightest, 0.1)
        # And the comparison can fail.
        row = rows[0] | {"torque_error_max_nm": "1.0"}
        with self.assertRaises(AssertionError):
            self.check(row, self.folder)


if __name__ == "__main__":
    unittest.main()
