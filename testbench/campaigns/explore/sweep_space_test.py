#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Space files: what is read, what is refused, and how points fall into parts.

Documentation: docs/speed-for-accuracy.md
"""

import unittest

from bench import ROOT, SPACE, Bench
from exploration import space
from exploration import sweep as sweeps


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
        self.ended(self.explore(self.folder / "none.toml"), 2, "is neither a verb")

    def test_shipped_spaces_are_good(self):
        for path in (ROOT / "vectors/spaces").glob("*.toml"):
            with self.subTest(path.name):
                self.assertGreater(len(space.read_space(ROOT, path).points), 1)


class Parts(Bench):
    def test_every_point_in_one_part_and_no_structure_is_torn(self):
        sweep = sweeps.start(ROOT, space.read_space(ROOT, self.space), self.folder / "plan")
        for count in (1, 2, 3, 4, 5, 40):
            homes = {}
            for index in range(1, count + 1):
                for point in sweep.part(index, count):
                    homes.setdefault(space.structure(point), []).append(index)
            self.assertTrue(all(len(set(home)) == 1 for home in homes.values()), count)
            self.assertEqual(sum(map(len, homes.values())), 24)


if __name__ == "__main__":
    unittest.main()
