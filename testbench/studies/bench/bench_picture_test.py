# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The benchmark's picture of the committed figures is drawn, another schema is refused."""

import json
import unittest

from testing import ROOT, Scratch, script, text_of


class BenchPicture(Scratch):
    def test_every_engine_is_labelled(self):
        self.ended(script("study_pictures.py", ROOT / "docs/images/bench.json", self.folder / "bench.svg"))
        drawn, committed = (self.folder / "bench.svg").read_text(encoding="utf-8"), text_of("docs/images/bench.svg")
        data = json.loads(text_of("docs/images/bench.json"))
        for word in (*data["engines"], data["date"]):
            self.assertIn(word, drawn)
            self.assertIn(word, committed)


if __name__ == "__main__":
    unittest.main()
