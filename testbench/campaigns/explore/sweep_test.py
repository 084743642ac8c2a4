#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A sweep: its space, what is left of it after an interruption, its front and its page.
evaluate() below stands in for the evaluation of a point. Documentation: docs/speed-for-accuracy.md
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib
import unittest
from pathlib import Path

from testing import ROOT, SCRIPTS, Scratch, environment, ran

from exploration import design_text, front, space

HERE = Path(__file__).resolve().parent

# 8 points of 4 structures: 3 x 2 of the first, and 2 more, since fraction 30 is the base's.
SPACE = """description = "for a test"
base = "lever"

[[sweep]]
name = "windows"
[sweep.axes]
velocity.m1 = [384, 500, 767]
velocity.cutoff_rad_s = [500, 600]

[[sweep]]
name = "fractions"
[sweep.set]
velocity.m1 = 384
[sweep.axes]
velocity.cutoff_rad_s = [500, 600]
formats.observer_fraction = [30, 32]
"""


def evaluate(point, workdir, route=False):
    """Figures from the point's own text, at once, or after FAKE_POINT_DELAY_S; FAKE_POINT_LOG takes
    a line for each evaluation; FAKE_POINT_FAIL, a point's id, makes that one fail."""
    name = space.point_id(point)
    with open(os.environ["FAKE_POINT_LOG"], "a", encoding="utf-8") as file:
        file.write(name + "\n")
    time.sleep(float(os.environ.get("FAKE_POINT_DELAY_S", "0")))
    if name == os.environ.get("FAKE_POINT_FAIL"):
        raise RuntimeError(f"point {name} cannot be built")
    seed = int(name, 16)
    return {
        "torque_error_rms_nm": (1 + seed % 97) * 1e-6,
        "lut4_equivalents": 2000 + seed % 101,
        "mult18": 2 + seed % 3,
        "delay_s": (1 + seed % 89) * 1e-5,
    } | ({"fmax_mhz": 50.0 + seed % 83} if route else {})


class Bench(Scratch):
    def setUp(self):
        super().setUp()
        self.log = self.folder / "log"
        self.space = self.put("space.toml", SPACE)

    def environment(self, **more):
        ours = {"PYTHONPATH": f"{HERE}:{ROOT / 'testbench/common'}", "FAKE_POINT_LOG": str(self.log)}
        return environment("FAKE_", FELTGATE_EXPLORE_POINT="sweep_test", **ours | more)

    def command(self, *words):
        return [sys.executable, "-B", str(SCRIPTS / "explore.py"), *map(str, words)]

    def explore(self, *words, **environment):
        return ran(*self.command(*words), env=self.environment(**environment), timeout=120)

    def good(self, *words):
        return self.ended(self.explore(*words)).stdout.strip()

    def whole(self, name="whole"):
        """Bytes of the results of an undisturbed sweep."""
        self.good(self.space, "-o", self.folder / name, "--jobs", 3, "--no-route")
        return (self.folder / name / "points.csv").read_bytes()

    def evaluations(self):
        return self.log.read_text().split() if self.log.exists() else []


class Space(Bench):
    def refused(self, old, new, line, *words):
        self.space.write_text(SPACE.replace(old, new, 1), encoding="utf-8")
        with self.assertRaises(space.SpaceError) as caught:
            space.read_space(ROOT, self.space)
        for word in (f"{self.space}:{line}:", *words):
            self.assertIn(word, str(caught.exception))

    def test_wrong_files_name_line_and_mend(self):
        self.refused("velocity.m1 = [", "velocity.m2 = [", 7, "velocity.m2", "velocity.m1")
        self.refused("velocity.m1 = 384", "velocity.m1 = 3.5", 13, "wanted int")
        self.refused("[384, 500, 767]", "384", 7, "no list")
        self.refused('"lever"', '"lewer"', 2, "no design", "lever")
        self.refused("formats.observer_fraction =", "velocity.m1 =", 13, "both")

    def test_shipped_spaces_are_good(self):
        for path in (ROOT / "vectors/spaces").glob("*.toml"):
            with self.subTest(path.name):
                self.assertGreater(len(space.read_space(ROOT, path).points), 1)


class Sweep(Bench):
    def test_stale_results_are_measured_again(self):
        wanted = self.whole()
        self.assertEqual(wanted.count(b"\n"), 1 + 8)
        path = next((self.folder / "whole/measured").iterdir())
        path.write_text(path.read_text().replace('"sources":"', '"sources":"0'))
        self.assertEqual(self.whole(), wanted)
        self.assertEqual(len(self.evaluations()), 9)

    def test_a_killed_sweep_goes_on(self):
        wanted = self.whole()
        for how in (signal.SIGKILL, signal.SIGINT):
            with self.subTest(how.name):
                self.log.unlink()
                words = (self.space, "-o", self.folder / how.name, "--jobs", 1, "--no-route")
                env = self.environment(FAKE_POINT_DELAY_S="0.1")
                process = self.started(*self.command(*words), env=env, stderr=subprocess.DEVNULL)
                self.until(lambda: len(self.evaluations()) >= 4)
                os.kill(process.pid, how)
                self.assertNotEqual(process.wait(), 0)
                self.good(*words)
                self.assertEqual((self.folder / how.name / "points.csv").read_bytes(), wanted)
                self.assertLessEqual(len(self.evaluations()), 8 + 2)

    def test_a_failing_point_is_named(self):
        name = space.point_id(space.read_space(ROOT, self.space).points[3])
        words = (self.space, "-o", self.folder / "fails")
        done = self.ended(self.explore(*words, FAKE_POINT_FAIL=name), 2)
        self.assertRegex(done.stderr.splitlines()[-1],
                         rf'^explore: point \{{"[^}}]*\}} of lever: .*point {name} cannot be built')


def row(name, error, area, delay, **keys):
    result = {"torque_error_rms_nm": error, "lut4_equivalents": area, "mult18": 2, "delay_s": delay}
    return {"id": name, "base": "lever", "set": keys, "result": result}


class Front(unittest.TestCase):
    def test_who_is_beaten(self):
        worse, refused = row("b", 2, 9, 5), row("r", 1, 1, 1) | {"result": {"refused": "too narrow"}}
        small = row("s", 1, 1, 1, **{"scenes.include": ["free"]})  # beats nobody with more scenes
        for rows, wanted in (([worse, row("a", 1, 9, 5), row("c", 3, 8, 5)], "ac"),
                             ([small, worse], "sb"), ([refused, worse], "b")):
            self.assertEqual([r["id"] for r in front.find(rows)], list(wanted))

    def test_presets_are_three(self):
        rows = [row("a", 1e-6, 3000, 9e-4), row("b", 1e-3, 2000, 1e-4), row("c", 1e-5, 2100, 2e-4)]
        found = {name: r["id"] for name, r in front.presets(rows).items()}
        self.assertEqual(found, {"exact": "a", "fast": "b", "balanced": "c"})

    def test_only_what_is_set_changes_in_a_design(self):
        base, changed, gain = (
            space.flattened(tomllib.loads(design_text.design_text(ROOT, {"base": "lever", "set": s})))
            for s in ({}, {"velocity.m1": 384, "formats.torque": [1, 3, 17]},
                      {"velocity.gain": "exact"}))
        differing = {k for k in base if base[k] != changed[k]}
        self.assertEqual(differing, {"velocity.m1", "formats.torque"})
        self.assertNotIn("velocity.n", gain)  # its place is taken


class Page(Bench):
    def test_page_and_table(self):
        folder = self.folder / "out"
        self.good(self.space, "-o", folder, "--jobs", 2)
        table = [line.split(",") for line in (folder / "points.csv").read_text().splitlines()]
        on_front = [row for row in table if row[1] == "f"]
        fmax = table[0].index("fmax_mhz")
        self.assertEqual([row for row in table[1:] if row[fmax]], on_front)
        page = (folder / "explore.html").read_text()
        self.assertNotRegex(page, r'(?:src|href)="(?!#|data:)|@import|url\(|https?://')
        self.assertEqual(page.count("<tr>"), 1 + len(on_front) + 1 + 8)
        # A committed table makes the same page.
        shutil.copy(folder / "points.csv", self.folder / "space.csv")
        self.good("page", self.folder / "space.csv", "-o", self.folder / "again")
        pages = [page, (self.folder / "again/explore.html").read_text()]
        self.assertEqual(*(re.findall("<tr><td class=words>.*?</td>(.*)", text) for text in pages))

    def test_a_damaged_table(self):
        table = self.put("space.csv", "id,front,delay_s\nab,,\nac,,x\n")
        self.ended(self.explore("page", table), 2,
                   "space.csv:3: delay_s = 'x' is not a number")


if __name__ == "__main__":
    unittest.main()
