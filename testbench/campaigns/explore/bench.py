# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the tests of a sweep share: a space, a scratch folder, and the stand-in for the evaluation.

Documentation: docs/speed-for-accuracy.md
"""

import sys
from pathlib import Path

from testing import ROOT, SCRIPTS, Scratch, environment, ran  # noqa: F401

HERE = Path(__file__).resolve().parent

# 24 points of 4 structures.
SPACE = """description = "for a test"
base = "lever"

[[sweep]]
name = "windows"
[sweep.axes]
velocity.m1 = [384, 500, 767]
velocity.cutoff_rad_s = [500, 600, 700]
observer.cutoff_rad_s = [500, 600]

[[sweep]]
name = "fractions"
[sweep.set]
velocity.m1 = 384
[sweep.axes]
velocity.cutoff_rad_s = [500, 600, 700]
observer.cutoff_rad_s = [500, 600]
formats.observer_fraction = [30, 32]
"""


class Bench(Scratch):
    def setUp(self):
        super().setUp()
        self.log = self.folder / "log"
        self.space = self.folder / "space.toml"
        self.space.write_text(SPACE, encoding="utf-8")

    def environment(self, **more):
        ours = {"PYTHONPATH": str(HERE), "FAKE_POINT_LOG": str(self.log)}
        return environment("FAKE_", FELTGATE_EXPLORE_POINT="fake_point", **ours | more)

    def command(self, *words):
        return [sys.executable, "-B", str(SCRIPTS / "explore.py"), *map(str, words)]

    def explore(self, *words, **environment):
        return ran(*self.command(*words), env=self.environment(**environment), timeout=120)

    def good(self, *words, **environment):
        """Runs and expects success; what it printed."""
        done = self.ended(self.explore(*words, **environment))
        return done.stdout.strip()

    def whole(self, name="whole"):
        """Bytes of the results of an undisturbed sweep."""
        self.good(self.space, "-o", self.folder / name, "--jobs", 3, "--no-route")
        return (self.folder / name / "points.jsonl").read_bytes()

    def evaluations(self):
        return self.log.read_text().split() if self.log.exists() else []
