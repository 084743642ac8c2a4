# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The benchmark's picture: every engine of the JSON is in it, another schema is refused."""

import json
import unittest

from testing import Scratch, script, text_of


def engine(arithmetic, speed, error):
    spread = {"median": speed, "min": 0.9 * speed, "max": 1.1 * speed}
    made = {"arithmetic": arithmetic, "simulated_s_per_s": spread}
    if error is not None:
        made["torque_error_nm"] = {"max": error, "rms": error / 5}
    return made


def result(schema="feltgate-bench/1"):
    return {
        "schema": schema,
        "machine": "a machine",
        "compiler": "a compiler",
        "date": "2026-01-01",
        "engines": {
            "rtl": engine("integer", 0.2, 2e-5),
            "twin_event": engine("integer", 20.0, 2e-5),
            "double": engine("real", 100.0, 1e-16),
            "quad": engine("real", 3.0, None),
            "another": engine("real", 7.0, 0.0),
        },
    }


class BenchPicture(Scratch):
    def draw(self, data):
        target = self.folder / "bench.svg"
        done = script("bench_picture.py", self.put("bench.json", json.dumps(data)), target)
        return done, target.read_text(encoding="utf-8") if target.exists() else ""

    def test_every_engine_is_labelled(self):
        done, svg = self.draw(result())
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in result()["engines"]:
            self.assertIn(f">{name}<", svg)
        self.assertIn("a machine", svg)
        self.assertIn("For the RTL's bits", svg)

    def test_another_schema_is_refused(self):
        done, svg = self.draw(result("feltgate-run/1"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("feltgate-bench/1", done.stderr)
        self.assertEqual(svg, "")

    def test_the_committed_picture_belongs_to_the_committed_figures(self):
        data, svg = json.loads(text_of("docs/images/bench.json")), text_of("docs/images/bench.svg")
        for name in data["engines"]:
            self.assertIn(f">{name}<", svg)
        self.assertIn(data["date"], svg)


if __name__ == "__main__":
    unittest.main()
