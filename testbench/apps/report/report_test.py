#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""report.py, figures.py and demo.py whole, with a stand-in for the program.

Documentation: docs/figures.md
"""

import json
import os
import signal
import subprocess
import sys
import time
import unittest
from unittest import mock

import numpy as np

from bench import ROOT, SCRIPTS, Bench  # isort: skip (puts scripts/ on the path)
import demo
from markup import Markup
from testing import weekly
from reports import all_figures, plots, run_pictures


class Report(Bench):
    def report(self, scene="damper", change=None):
        run, csv = self.folder / "run.json", self.folder / "run.csv"
        self.fake("run", scene, "--json", run, "--csv", csv, "--every", 200)
        if change:
            summary = json.loads(run.read_text())
            change(summary)
            run.write_text(json.dumps(summary))
        return self.script("report.py", self.folder / "out", run, csv)

    def page(self):
        return (self.folder / "out" / "report.html").read_text()

    def test_page_of_a_good_run(self):
        done = self.report()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.strip(), str(self.folder / "out" / "report.html"))
        self.assert_self_contained(self.page())
        self.assertIn('class="verdict good"', self.page())
        found = Markup(self.page())
        self.assertEqual(sum(tag == "img" for tag, _ in found.elements), 4)
        self.assertEqual(len(found.classes("headline")), 3)
        # Pictures first, tables folded.
        self.assertLess(self.page().index("<img"), self.page().index("<table"))

    def test_what_the_hand_meets_is_what_it_feels(self):
        csv = {
            "time_s": np.arange(1000) * 1e-4,
            "theta_rad": np.linspace(0, 1, 1000),
            "tau_ref_nm": np.linspace(0, -2, 1000),
            "hand_torque_nm": np.linspace(0, 2, 1000),
        }
        csv["hand_torque_nm"][500] = -500  # one row at a jump of the hand
        window = csv["hand_torque_nm"].reshape(-1, 10).mean(axis=1)
        csv["hand_felt_nm"] = np.repeat(np.concatenate([[0], window[:-1]]), 10)
        csv["hand_felt_nm"][510:520] = 0.5  # the blow itself lasts for less than a row
        with mock.patch.object(plots, "draw") as draw:
            run_pictures.loop_picture("jump", csv)
        (_, position, hand, *_), _ = draw.call_args_list[0]
        self.assertLess(np.abs(hand - 2 * position)[np.arange(99) != 50].max(), 1e-9)
        self.assertEqual(hand[50], 0.5)
        _, there, asked, *_ = draw.call_args_list[1][0]
        self.assertLess(np.abs(asked - 2 * there).max(), 1e-9)
        sparse = {name: values[::20] for name, values in csv.items()}
        self.assertEqual(len(run_pictures.felt_rows(sparse)[0]), 50)

    def test_a_jump_of_the_hand_is_told(self):
        self.report(change=lambda s: s.update(speed_jumps=["x.toml:7: the hand's speed jumps"]))
        self.assertIn("x.toml:7: the hand&#x27;s speed jumps", self.page())

    def test_steps_have_a_table(self):
        self.report("torque_step")
        self.assertIn("motor settles, ms", Markup(self.page()).text)

    def test_mismatches_are_red(self):
        self.report(change=lambda s: s.update(mismatches=3, first_mismatch="clock 5: duty"))
        self.assertIn('class="verdict bad"', self.page())
        self.assertIn("clock 5: duty", self.page())

    def test_a_run_without_comparison_claims_none(self):
        self.report(change=lambda s: s.pop("mismatches"))
        self.assertIn("were not compared", self.page())

    def test_wrong_files_give_one_line(self):
        for change in (lambda s: s.update(schema="other"), lambda s: s.clear()):
            done = self.ended(self.report(change=change), 2)
            self.assertRegex(done.stderr, r"^report: .*run.json: schema .*\n$")
        done = self.script("report.py", self.folder, "none.json")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))


class Figures(Bench):
    @weekly(3)
    def test_all_figures(self):
        out = self.folder / "out"
        done = self.ended(self.script("figures.py", "--output", out))
        self.assertEqual(done.stdout.strip(), str(out / "figures.html"))
        self.assert_self_contained((out / "figures.html").read_text())
        summary = json.loads((out / "figures.json").read_text())
        self.assertEqual(summary["schema"], "feltgate-figures/1")
        # Clocks count where RTL and twin were compared: not in the paper's four long motions.
        compared = whole = 0
        for path in (out / "data").glob("*.json"):
            run = json.loads(path.read_text())
            whole += run["clocks"]
            compared += run["clocks"] if "mismatches" in run else 0
        self.assertEqual(summary["clocks"], compared)
        self.assertLess(compared, whole)
        numbers = {f["figure"]: f["numbers"] for f in summary["figures"]}
        self.assertEqual(list(numbers), [7, 10, 11, 14, 16, 17, 19, 21, 22])
        for figure in summary["figures"]:
            for name in figure["pictures"]:
                self.assertTrue((out / f"{name}.svg").stat().st_size)
                self.assertTrue((out / f"{name}.png").stat().st_size)
        # The stand-in is a closed form, so these are known.
        self.assertAlmostEqual(numbers[7]["measured_slope_nm_v"]["paper"], 0.0719, places=4)
        self.assertAlmostEqual(numbers[7]["observed_slope_nm_v"]["paper"], 0.0605, places=4)
        self.assertAlmostEqual(numbers[10]["border_voltage_before_v"]["paper"], 3.10, places=2)
        self.assertAlmostEqual(numbers[10]["border_voltage_after_v"]["paper"], 2.36, places=2)
        self.assertLess(numbers[10]["error_at_0.1_nm_pct"]["unit"], 0)
        self.assertGreater(numbers[10]["error_at_0.2_nm_pct"]["unit"], 0)
        self.assertAlmostEqual(numbers[16]["stiffness_nm_rad"]["lever"], 1.0, places=2)
        # The paper's own motions, beside ours.
        self.assertEqual(numbers[16]["begins_s"]["published"], "1")
        for number, start, begins, end in (
            (16, 3, 1, 0),
            (17, 0, 0.3, 3),
            (19, 0, 0.6, 0.1),
            (21, 4.5, 0.8, 0),
            (22, 0, 1.2, 4.5),
        ):
            for design in ("lever_motion", "paper_motion"):
                self.assertAlmostEqual(numbers[number]["start_rad"][design], start, places=3)
                self.assertAlmostEqual(numbers[number]["begins_s"][design], begins, places=2)
                self.assertAlmostEqual(numbers[number]["end_rad"][design], end, places=2)
        self.assertAlmostEqual(numbers[19]["largest_torque_nm"]["lever_motion"], 0.13, places=2)
        self.assertEqual(numbers[14].get("start_rad"), None)
        self.assertAlmostEqual(numbers[17]["saturates_rad"]["lever"], 1.0, places=2)
        self.assertAlmostEqual(numbers[21]["exponent"]["paper"], -2.0, places=2)

    @weekly(3)
    def test_the_pictures_of_the_docs(self):
        out, names = self.folder / "out", [f"paper_{n:02d}.svg" for n in all_figures.NUMBERS]
        self.ended(self.script("figures.py", "--docs", "--output", out))
        self.assertEqual(sorted(path.name for path in out.iterdir()), names)
        for name in names:
            self.assertTrue((ROOT / "docs/images" / name).is_file(), name)

    def test_unknown_design(self):
        self.ended(self.script("figures.py", "--design", "other"), 2, "'other'")


class Demo(Bench):
    SCENES = {"damper", "torque_step", "wall"}

    def root(self, scenes=()):
        """A repository with few scenes, to be quick."""
        root, scenes = self.folder / "root", self.SCENES | set(scenes)
        (root / "vectors" / "scenes").mkdir(parents=True, exist_ok=True)
        for name in ("rtl", "vectors/plants", *(f"vectors/scenes/{s}.toml" for s in scenes)):
            if not (root / name).exists():
                (root / name).symlink_to(ROOT / name)
        return str(root)

    def demo(self, *arguments, traces=None, **environment):
        out = self.folder / "out"
        environment["FELTGATE_ROOT"] = self.root()
        folder = traces or self.folder / "no-traces"
        environment["FELTGATE_TRACES"] = str(folder)
        done = self.script("demo.py", "--output", out, *arguments, **environment)
        summary = json.loads((out / "demo.json").read_text())
        return done, summary, (out / "demo.html").read_text()

    @weekly(3)
    def test_scenes_recordings_and_what_cannot_be_read(self):
        traces = self.folder / "traces"
        traces.mkdir()
        long = "avago_adns_2051_remove_and_readd_usb_20230828T150615_434.csv"
        hostile = '"><img src=x onerror=alert(1)>.csv'
        for name in ("hand.csv", long, hostile):
            (traces / name).write_text("t,count\n0,0\n0.5,3\n")
        (traces / "empty.csv").write_text("t,A,B\n")
        done, summary, page = self.demo("--no-figures", traces=traces)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines()[-1], str(self.folder / "out" / "demo.html"))
        self.assert_self_contained(page)
        ran = {run["scene"] for run in summary["runs"].values() if "scene" in run}
        self.assertEqual(ran, self.SCENES)
        self.assertTrue(any(run.get("trace") == "hand.csv" for run in summary["runs"].values()))
        self.assertIn("empty.csv", done.stderr)
        self.assertEqual(len(summary["unreadable"]), 1)
        found = Markup(page)
        self.assertEqual(len(found.classes("headline")), 3)
        self.assertLess(page.index("<img"), page.index("<table"))
        self.assertLess(len(page), 6e6)
        self.assertFalse([a for _, a in found.elements if "onerror" in a])
        self.assertIn(hostile, found.text)
        self.assertGreaterEqual(len(found.tables), 3)

    @weekly(3)
    def test_each_device_and_all_on_demand(self):
        self.root(("detent", "end_stops", "end_stops_thrown", "pantograph_floor"))
        _, summary, page = self.demo("--no-figures")
        self.assert_self_contained(page)
        found = Markup(page)
        for name in ("wall-lever", "detent-lever_law", "end_stops-lever_law", "pantograph_floor-pantograph_law"):
            self.assertIn(name, found.ids)
        self.assertIn("Devices of several axes: 1 run in closed loop, 0 mismatches", found.text)
        self.assertNotIn("end_stops_thrown-lever_law", summary["runs"])
        done, summary, page = self.demo("--no-figures", "--all", FAKE_MISMATCHES="1")
        self.assertIn("end_stops_thrown-lever_law", summary["runs"])
        self.assertIn('id="end_stops_thrown-lever_law"', page)
        self.assertIn("pantograph_floor, pantograph_law: 1 mismatches", done.stderr)

    def test_what_is_left_out_is_there(self):
        for name in demo.ALL_ONLY:
            self.assertTrue((ROOT / "vectors" / "scenes" / f"{name}.toml").is_file(), name)

    @weekly(3)
    def test_mismatches_end_with_1_and_a_list(self):
        done, summary, page = self.demo("--no-figures", FAKE_MISMATCHES="2")
        self.assertEqual(done.returncode, 1)
        self.assertIn("2 mismatches", done.stderr)
        self.assertIn("sigrok-dumps", done.stderr)  # no recordings: where to get them
        self.assertGreaterEqual(len(summary["broken"]), len(summary["runs"]))
        self.assertIn('class="verdict bad"', page)

    def test_interrupt_leaves_nothing_running(self):
        pids = self.folder / "pids"
        self.put("feltgate", f'#!/bin/sh\necho $$ >> "{pids}"\nexec sleep 300\n')
        options = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        options["env"] = self.environment(FELTGATE_ROOT=self.root(), FELTGATE_TRACES=str(self.folder))
        words = ("--no-figures", "--output", self.folder / "out")
        demo = self.started(sys.executable, "-B", SCRIPTS / "demo.py", *words, **options)
        self.until(pids.exists)
        time.sleep(0.5)
        demo.terminate()
        self.assertEqual(demo.wait(timeout=60), 128 + signal.SIGTERM)
        for pid in pids.read_text().split():
            with self.assertRaises(ProcessLookupError):
                os.kill(int(pid), 0)

    def test_options_that_cannot_be(self):
        self.ended(self.script("demo.py", "--traces", self.folder / "nowhere"), 2, "no such folder")


if __name__ == "__main__":
    unittest.main()
