#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The front, its routed figures, design files of points, and the page.

Documentation: docs/speed-for-accuracy.md
"""

import json
import re
import shutil
import tomllib
import unittest
from pathlib import Path

from bench import ROOT, Bench
from exploration import design_text, front, presets, space


def row(name, error, area, delay, **keys):
    result = {"torque_error_rms_nm": error, "lut4_equivalents": area, "mult18": 2, "delay_s": delay}
    return {"id": name, "base": "lever", "set": keys, "result": result}


class Front(unittest.TestCase):
    def names(self, *rows):
        return [r["id"] for r in front.find(rows)]

    def test_who_is_beaten(self):
        best, worse, other = row("a", 1, 9, 5), row("b", 2, 9, 5), row("c", 3, 8, 5)
        self.assertEqual(self.names(worse, best, other), ["a", "c"])

    def test_fewer_scenes_beat_nobody_with_more(self):
        small = row("a", 1, 1, 1, **{"scenes.include": ["free"]})
        self.assertEqual(self.names(small, row("b", 2, 2, 2)), ["a", "b"])

    def test_refused_points_are_out(self):
        refused = row("a", 1, 1, 1) | {"result": {"refused": "too narrow"}}
        self.assertEqual(self.names(refused, row("b", 2, 2, 2)), ["b"])

    def test_presets_are_three(self):
        rows = [row("a", 1e-6, 3000, 9e-4), row("b", 1e-3, 2000, 1e-4), row("c", 1e-5, 2100, 2e-4)]
        found = {name: r["id"] for name, r in presets.choose(rows).items()}
        self.assertEqual(found, {"exact": "a", "fast": "b", "balanced": "c"})


class DesignFiles(unittest.TestCase):
    def parsed(self, **keys):
        changed = {key.replace("__", "."): value for key, value in keys.items()}
        text = design_text.design_text(ROOT, {"base": "lever", "set": changed})
        self.assertIn('mode = "off"', text)  # of the self-test
        return space.flattened(tomllib.loads(text))

    def test_only_what_is_set_changes(self):
        base = self.parsed()
        changed = self.parsed(velocity__m1=384, formats__torque=[1, 3, 17])
        differing = {k for k in base if base[k] != changed[k]}
        self.assertEqual(differing, {"velocity.m1", "formats.torque"})

    def test_a_gain_takes_the_place_of_n(self):
        found = self.parsed(velocity__gain="exact")
        self.assertNotIn("velocity.n", found)
        self.assertEqual(found["velocity.gain"], "exact")


class Page(Bench):
    def test_whole(self):
        folder = self.folder / "out"
        printed = self.good(self.space, "-o", folder, "--jobs", 2).splitlines()
        self.assertEqual(printed[-1], str(folder / "explore.html"))
        rows = [json.loads(line) for line in (folder / "points.jsonl").read_text().splitlines()]
        on_front = {r["id"] for r in front.find(rows)}
        self.assertEqual({r["id"] for r in rows if "fmax_mhz" in r["result"]}, on_front)
        page = (folder / "explore.html").read_text()
        self.assertNotRegex(page, r'(?:src|href)="(?!#|data:)|@import|url\(|https?://')
        self.assertEqual(page.count("<tr>"), 1 + len(on_front) + 1 + 24)
        self.assertIn("<svg", (folder / "explore.svg").read_text()[:5])
        table = (folder / "points.csv").read_text().splitlines()
        self.assertEqual(len(table), 1 + 24)
        self.assertEqual(sum(line.split(",")[1] == "f" for line in table), len(on_front))

    def test_presets_are_designs(self):
        folder = self.folder / "out"
        self.good(self.space, "-o", folder, "--jobs", 2, "--no-route")
        paths = self.good("presets", folder, "-o", self.folder / "three").splitlines()
        names = [Path(path).stem for path in paths]
        self.assertEqual(names, ["fast", "balanced", "exact"])
        for path in paths:
            design = tomllib.loads(Path(path).read_text())
            self.assertIn("gives up", design["description"])
            self.assertEqual(design["clock"]["clock_hz"], 50_000_000)

    def test_a_committed_table_will_do(self):
        folder = self.folder / "out"
        self.good(self.space, "-o", folder, "--jobs", 2)
        shutil.copy(folder / "points.csv", self.folder / "space.csv")
        self.good("page", self.folder / "space.csv", "-o", self.folder / "again")
        pages = [(at / "explore.html").read_text() for at in (folder, self.folder / "again")]
        self.assertEqual(*(re.findall("<tr><td class=words>.*?</td>(.*)", page) for page in pages))

    def test_a_damaged_table(self):
        table = self.folder / "space.csv"
        for text, said in (
            ("id,front,delay_s\nab,,1e-6,2\n", "space.csv:2: not as many fields as in line 1"),
            ("id,front,delay_s\nab,,\nac,,x\n", "space.csv:3: delay_s = 'x' is not a number"),
        ):
            table.write_text(text)
            done = self.explore("page", table)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(said, done.stderr)
        self.space.unlink()
        self.assertIn("space.toml: No such file", self.explore("page", table).stderr)


if __name__ == "__main__":
    unittest.main()
