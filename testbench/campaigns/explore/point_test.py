# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""exploration.point: a coarse design from its text to its figures, a seeded defect, what is kept; and
the committed sweep: its errors within their bounds, its presets for use. docs/speed-for-accuracy.md"""

import csv
import json
import os
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path
from unittest import mock

from testing import BUILD, ROOT, Scratch, ran, weekly

from exploration import front, point, points_table, space
from exploration.design_text import design_text
from seeded_defects import patches

WHOLE = "FELTGATE_WHOLE" in os.environ
TABLE = ROOT / "vectors/spaces/trade.csv"
COARSE = {
    "clock.tick_hz": 10000,
    "velocity.m1": 8,
    "velocity.gain": "exact",
    "formats.velocity": [1, 10, 12],
    "formats.torque": [1, 4, 10],
    "formats.current": [1, 5, 12],
    "formats.voltage": [1, 5, 10],
    "formats.observer_fraction": 18,
    "formats.rounding": "floor",
}


class Evaluation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="feltgate-point-")
        cls.addClassCleanup(cls.folder.cleanup)

    def evaluate(self, changes, **options):
        text = design_text(ROOT, {"base": "lever", "set": changes})
        return point.evaluate_design(text, self.folder.name, area=False, **options)

    def structures(self):
        return len(list((Path(self.folder.name) / "structures").iterdir()))

    @weekly(3)
    def test_floor_narrow_and_slow_matches_and_is_measured(self):
        result = self.evaluate(COARSE)
        self.assertEqual(result["status"], "ok")
        self.assertTrue(result["coarse"])
        self.assertEqual(result["mismatches"], 0)
        self.assertGreater(result["clocks_compared"], 4_000_000)
        self.assertGreater(result["clocks_armed"], 0.8 * result["clocks_compared"])
        self.assertGreater(result["ticks"], 10_000)
        self.assertEqual(result["ticks_left_out"], 0)
        # An LSB of torque is 0.98 mNm: the error is of that size, neither hidden nor wild.
        self.assertGreater(result["torque_error_max_nm"], 0.3e-3)
        self.assertLess(result["torque_error_max_nm"], 5e-3)
        self.assertAlmostEqual(result["delay_s"], 0.5 * 8e-4 + 1 / 500, delta=1e-6)
        # The limits are reached and left again.
        limited = result["ticks_limited"]["torque"]
        self.assertTrue(0 < limited < result["ticks"] / 2, limited)
        self.assertTrue(result["bound_holds"])
        self.assertEqual(result["bound_without"], [])
        # Registers carry the cut-off: the same structure, other figures.
        count = self.structures()
        other = self.evaluate(COARSE | {"velocity.cutoff_rad_s": 550.0})
        self.assertEqual(self.structures(), count)
        self.assertEqual(other["structure"], result["structure"])
        self.assertEqual(other["mismatches"], 0)
        self.assertNotEqual(other["torque_error_max_nm"], result["torque_error_max_nm"])
        # And a point does not depend on who built its structure.
        self.assertEqual(self.evaluate(COARSE), result)

    @weekly(3)
    def test_a_defect_of_the_rtl_fails_the_point(self):
        # The second is seen by the heat alone.
        for name, changes in (("other_sign_of_inertia", {}), ("heat_forgets_back_emf", COARSE)):
            defect = ROOT / "testbench/campaigns/explore/defects.diff" / name
            folder = Path(self.folder.name, defect.name)
            copies = {p.name: p for p in patches.write_copies(defect, folder)}
            sources = [copies.get(path.name, path) for path in point.core_rtl()]
            with (
                self.subTest(name),
                mock.patch.object(point, "core_rtl", return_value=sources),
                mock.patch.object(point, "_sources", None),
            ):
                result = self.evaluate(changes)
                self.assertEqual(result["status"], "mismatch")
                self.assertGreater(result["mismatches"], 0)
                self.assertIn("clock", result["first_mismatch"])
                self.assertNotIn("torque_error_max_nm", result)

    def test_what_cannot_work_is_refused_with_the_reason(self):
        result = self.evaluate({"formats.observer_fraction": 10})
        self.assertEqual(result["status"], "refused")
        self.assertIn("fraction bits", result["reason"])
        self.assertNotIn(self.folder.name, result["reason"])


def rows():
    with TABLE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def value(text):
    try:
        return json.loads(text)
    except ValueError:
        return text


def changes(row):
    """What the point sets: the columns that are keys of a design."""
    return {key: value(text) for key, text in row.items() if "." in key and text}


class Bounds(Scratch):
    def check(self, row):
        """The bounds of a row's design; the row's errors must keep them."""
        text = design_text(ROOT, {"base": "lever", "set": changes(row)})
        design = self.put("point.toml", text)
        result = {key: value(text) for key, text in row.items()}
        found = point.bounds(design, result)
        self.assertEqual(found["bound_without"], [], row["id"])
        for name in point.BOUNDED:
            error, bound = point.measured(result, name), found[f"bound_{name}"]
            self.assertLessEqual(error, bound, f"{row['id']} {name} {changes(row)}")
        return found

    def test_no_measured_error_exceeds_its_bound(self):
        if not WHOLE:
            return
        good = [row for row in rows() if row["status"] == "ok"]
        self.assertGreaterEqual(len(good), 200)
        tightest = 0.0
        for row in good:
            found = self.check(row)
            error = float(row["torque_error_max_nm"])
            tightest = max(tightest, error / found["bound_torque_nm"])
        # A bound that nothing comes near would hold whatever the RTL did.
        self.assertGreater(tightest, 0.1)
        # And the comparison can fail.
        row = good[0] | {"torque_error_max_nm": "1.0"}
        with self.assertRaises(AssertionError):
            self.check(row)


def design_of(name):
    text = (ROOT / f"rtl/designs/{name}.toml").read_text(encoding="utf-8")
    return text, space.flattened(tomllib.loads(text))


class Presets(Scratch):
    def row_of(self, design):
        """The row of the table that sets what the preset sets."""
        base = design_of("lever")[1]
        found = []
        for row in rows():
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
        for name in front.PRESETS:
            self.ended(ran(BUILD / "feltgate", "design", name, "--plant", "p24"))

    def test_tabled(self):
        for name in front.PRESETS:
            with self.subTest(name):
                design = design_of(name)[1]
                self.assertIn("gives up", design["description"])
                self.assertEqual(self.row_of(design)["front"], "f")

    def test_equal_to_their_twins_and_as_tabled(self):
        for name in front.PRESETS if WHOLE else ():  # a usual run evaluates a design above
            with self.subTest(name):
                text, design = design_of(name)
                result = point.evaluate_design(text, BUILD / "explore/presets", area=False)
                self.assertEqual((result["status"], result["coarse"]), ("ok", False))
                self.assertGreater(result["clocks_compared"], 1_000_000)
                row = self.row_of(design)
                for key in ("torque_error_rms_nm", "velocity_error_rms_rad_s", "delay_s"):
                    self.assertAlmostEqual(result[key] / float(row[key]), 1, delta=0.02, msg=key)


if __name__ == "__main__":
    if not (point.BUILD / "feltgate_generate").exists():
        sys.exit(f"{point.BUILD} has no feltgate_generate; set FELTGATE_BUILD")
    unittest.main()
