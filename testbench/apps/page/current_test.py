#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""docs/page.html is of this tree, by its sources and by the bits of the native twin.

Documentation: docs/page.md
"""

import os
import unittest
from unittest import mock

from testing import BUILD, ROOT

import page

os.environ["FELTGATE_PAGE_DATA"] = str(BUILD / "feltgate_page_data")


class Current(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.numbers = page.numbers_of(ROOT, page.DESIGNS)  # most of a minute: once

    def test_committed(self):
        with mock.patch.object(page, "numbers_of", return_value=self.numbers):
            self.assertEqual(page.stale(ROOT), "", "run feltgate page --update")

    def test_everything_is_inside(self):
        text = (ROOT / page.COMMITTED).read_text(encoding="utf-8")
        for name in ("numbers", "engine", "wasm"):
            self.assertGreater(len(page.unpacked(text, name)), 10_000, name)
        self.assertNotRegex(text, r'(?:src|href)="https?:', "needs a network")
        self.assertNotIn("/*{", text, "a part was not filled in")

    def test_unknown_design(self):
        with self.assertRaisesRegex(page.PageError, "rtl/designs"):
            page.checked_designs(ROOT, ["nothing"])


if __name__ == "__main__":
    unittest.main()
