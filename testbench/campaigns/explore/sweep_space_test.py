#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Space files: what is read, what is refused, and how points fall into chunks.

Documentation: docs/speed-for-accuracy.md
"""

import unittest

from bench import ROOT, SPACE, Bench
from exploration import plan as plans
from exploration import space


class Reading(Bench):
    def read(self, text=SPACE):
        self.space.write_text(text, encoding="utf-8")
        return space.read_space(ROOT, self.space)

    def refused(self, old, new, line, *words):
        with self.assertRaises(space.SpaceError) as caught:
            self.read(SPACE.replace(old, new, 1))
        message = str(caught.exception)
        self.assertIn(f"{self.space}:{line}:", message)
        for word in words:
            self.assertIn(word, message)

    def test_sweeps_are_a_union(self):
        # 3 x 3 x 2 of the first; of the second 6 more, since fraction 30 is the base's.
        self.assertEqual(len(self.read().points), 18 + 6)

    def test_base_values_leave_no_trace(self):
        points = self.read().points
        self.assertIn({"base": "lever", "set": {}}, points)
        self.assertTrue(
            all(
                "formats.observer_fraction" not in p["set"]
                or p["set"]["formats.observer_fraction"] == 32
                for p in points
            )
        )

    def test_order_of_the_file_does_not_matter(self):
        head, first, second = SPACE.split("[[sweep]]")
        swapped = "[[sweep]]".join([head, second + "\n", first])
        self.assertEqual(self.read().points, self.read(swapped).points)

    def test_wrong_files_name_line_and_mend(self):
        self.refused("velocity.m1 = [", "velocity.m2 = [", 7, "velocity.m2", "velocity.m1")
        self.refused("velocity.m1 = 384", "velocity.m1 = 3.5", 14, "wanted int")
        self.refused("[384, 500, 767]", "384", 7, "no list")
        self.refused("[384, 500, 767]", "[384, 500, 767", 8)
        self.refused('"lever"', '"lewer"', 2, "no design", "lever")
        self.refused("[sweep.set]", "[sweep.fixed]", 13, "fixed")
        self.refused("formats.observer_fraction =", "velocity.m1 =", 14, "both")
        self.refused('base = "lever"', 'base = "lever"\nbases = 1', 3, "bases")

    def test_no_file(self):
        self.ended(self.explore("plan", self.folder / "none.toml"), 2, "is neither a verb")

    def test_shipped_spaces_are_good(self):
        for path in (ROOT / "vectors/spaces").glob("*.toml"):
            with self.subTest(path.name):
                self.assertGreater(len(space.read_space(ROOT, path).points), 1)


class Chunks(Bench):
    def setUp(self):
        super().setUp()
        self.planned = plans.make(space.read_space(ROOT, self.space), self.folder / "plan")

    def test_every_point_in_one_chunk(self):
        for count in (1, 2, 3, 4, 5, 7, 24, 40):
            parts = [self.planned.chunk(i, count) for i in range(1, count + 1)]
            together = [point for part in parts for point in part]
            self.assertEqual(together, list(self.planned.points), count)

    def test_a_structure_is_not_torn(self):
        self.assertEqual(len(self.planned.groups()), 4)
        for count in (1, 2, 3, 4):
            homes = {}
            for index in range(1, count + 1):
                for point in self.planned.chunk(index, count):
                    homes.setdefault(space.structure(point), set()).add(index)
            self.assertTrue(all(len(home) == 1 for home in homes.values()), count)

    def test_wrong_chunks_are_refused(self):
        for text in ("0/4", "5/4", "4", "a/b", "1/0"):
            with self.assertRaises(plans.PlanError):
                plans.parse_chunk(text)

    def test_planned_again_is_the_same_and_another_is_refused(self):
        before = (self.folder / "plan/plan.json").read_bytes()
        self.plan()
        self.assertEqual((self.folder / "plan/plan.json").read_bytes(), before)
        self.space.write_text(SPACE.replace("767", "768"), encoding="utf-8")
        self.ended(self.explore("plan", self.space, "-o", self.folder / "plan"), 2, "another space")


if __name__ == "__main__":
    unittest.main()
