#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""report.py and demo.py on runs of the program: what is wrong is red on the page and 1 as exit code; which recordings
are read, and how. Documentation: docs/figures.md
"""

import json
import re
import shutil
import unittest
from html import escape
from types import SimpleNamespace

from testing import BUILD, ROOT, Scratch, environment, ran, script, text_of
import demo
from reports import all_figures, headline, observer_section, recordings, run_section, runs

HOSTILE = '"><img src=x onerror=alert(1)></script><script>alert(2)</script><!--<script>'
# The program, whose results another hand changes: two mismatches in each.
BROKEN = """"{program}" "$@"
while [ "$1" != --json ]; do shift; done
sed -i 's/"mismatches": 0/"mismatches": 2/' "$2"
exit 1"""


class Report(Scratch):
    def run_of(self, scene):
        """JSON of a run, and the paths of what report.py reads."""
        paths = self.folder / "run.json", self.folder / "run.csv"
        words = ("--engine", "twin,quad", "--quiet", "--json", paths[0], "--csv", paths[1])
        self.ended(ran(BUILD / "feltgate", "run", scene, *words, cwd=ROOT))
        return json.loads(paths[0].read_text(encoding="utf-8")), paths

    def report(self, summary, paths, status=0):
        paths[0].write_text(json.dumps(summary), encoding="utf-8")
        done = self.ended(script("report.py", self.folder / "out", *paths), status)
        page = self.folder / "out/report.html"
        return page.read_text(encoding="utf-8") if page.exists() else done.stderr

    def test_verdicts_and_names_that_would_do_harm(self):
        summary, paths = self.run_of("torque_step")
        summary["mismatches"] = 0
        page = self.report(summary, paths)
        self.assertIn('class="verdict good"', page)
        self.assertEqual(page.count("<img"), 2)
        self.assertNotRegex(page, r"https?:|//[a-z]+\.[a-z]|@import")
        clocks, error, settling = headline.of_run(summary, run_section.steps_of(summary))
        twin = summary["engines"]["twin"]
        self.assertEqual((clocks.value, clocks.good), ("0", True))
        self.assertEqual((error.value, error.good), (f"{1e6 * twin['torque_nm']['max_error']:#.3g} µNm", True))
        slowest = max(step["torque_settling_ms"] for step in twin["step_responses"])
        self.assertEqual((settling.value, settling.good), (f"{slowest:#.3g} ms", True))
        page = self.report(summary | {"mismatches": 3, "first_mismatch": "clock 5: duty", "design": HOSTILE}, paths)
        self.assertIn('class="verdict bad"', page)
        self.assertIn("clock 5: duty", page)
        self.assertIn(escape(HOSTILE), page)
        self.assertNotIn("<img src=x", page)
        shutil.rmtree(self.folder / "out")
        self.assertRegex(self.report({"schema": "other"}, paths, 2), r"^report: .*run.json: schema .*\n$")

    def test_what_breaks_a_bound_or_an_expectation_is_told(self):
        good = {"design": "lever", "engines": {"rtl": {"torque_nm": {"max_error": 9e-3, "bound": 1e-2}}}}
        broken = {"design": "lever", "engines": {"rtl": {"torque_nm": {"max_error": 2e-6, "bound": 1e-6}}}}
        self.assertTrue(headline.error([good]).good)
        shown = headline.error([good, broken])
        self.assertEqual((shown.value, shown.good), ("2.00 µNm", False))
        self.assertIsNone(headline.compared(100, None).good)
        error = {"torque_nm": {"max_error": 2e-5, "bound": 1e-5, "holds": False}}
        (fault,) = run_section.faults_of({"trace": "x", "design": "lever", "felt": {"errors": error}})
        self.assertIn("torque_nm is off by 2e-05, above its proven bound 1e-05", fault)
        expected = {"scene": "x", "design": "lever", "expectations": {"broken": ["faults = 1"]}}
        self.assertEqual(run_section.faults_of(expected), ["x, lever: faults = 1"])

    def test_long_tables_are_thinned_evenly_and_others_refused(self):
        path = self.put("run.csv", "time_s,duty\n" + "".join(f"{i:06d},1\n" for i in range(10_000)))
        time = runs.read_csv(path, most_rows=100)["time_s"]
        self.assertLessEqual(len(time), 101)
        self.assertEqual(len(set(time[1:] - time[:-1])), 1)
        for text in ("", "a,b\n1,2\n", "time_s,duty\n", "time_s,duty\n1,x\n", "time_s\n1,2\n"):
            with self.subTest(text), self.assertRaisesRegex(ValueError, "run.csv"):
                runs.read_csv(self.put("run.csv", text))


class Demo(Scratch):
    SCENES = ("torque_step", "wall")

    def demo(self, program, status, duration_s=None):
        """A repository of two scenes and a recording, to be quick."""
        for name in ("rtl", "vectors/plants", *(f"vectors/scenes/{s}.toml" for s in self.SCENES)):
            at = self.folder / "root" / name
            at.parent.mkdir(parents=True, exist_ok=True)
            if duration_s and at.suffix == ".toml":
                text, found = re.subn("(?m)^duration_s = .*", f"duration_s = {duration_s}", text_of(name))
                self.assertEqual(found, 1, name)
                at.write_text(text, encoding="utf-8")
            else:
                at.symlink_to(ROOT / name)
        self.put("traces/hand.csv", "t,count\n0,0\n0.5,3\n")
        self.put("traces/empty.csv", "t,A,B\n")
        ours = {"FELTGATE_ROOT": str(self.folder / "root"), "FELTGATE_PROGRAM": str(program)}
        words = ("--no-figures", "--traces", self.folder / "traces", "--output", self.folder / "out")
        done = self.ended(script("demo.py", *words, env=environment(**ours)), status, "empty.csv")
        page, told = self.folder / "out/demo.html", self.folder / "out/demo.json"
        self.assertEqual(done.stdout.splitlines()[-1], str(page))
        return done, page.read_text(encoding="utf-8"), json.loads(told.read_text(encoding="utf-8"))

    def test_every_scene_and_recording(self):
        _, page, told = self.demo(BUILD / "feltgate", 0)
        self.assertEqual({run["scene"] for run in told["runs"].values() if "scene" in run}, set(self.SCENES))
        self.assertTrue(any(run.get("trace") == "hand.csv" for run in told["runs"].values()))
        self.assertEqual((told["mismatches"], told["broken"], len(told["unreadable"])), (0, [], 1))
        self.assertEqual(told["clocks"], sum(run["clocks"] for run in told["runs"].values()))
        self.assertIn('class="verdict good"', page)
        self.assertIn('id="wall-lever"', page)

    def test_mismatches_end_with_1_and_a_list(self):
        program = self.put_program("bin/feltgate", BROKEN.format(program=BUILD / "feltgate"))
        done, page, told = self.demo(program, 1, duration_s=0.02)
        self.assertIn("2 mismatches", done.stderr)
        self.assertEqual(told["mismatches"], 2 * len(told["runs"]))
        self.assertGreaterEqual(len(told["broken"]), len(told["runs"]))
        self.assertIn('class="verdict bad"', page)

    def test_the_launcher_builds_what_it_needs(self):
        jobs = sum(demo.scene_jobs(everything=True), all_figures.jobs(demo.DESIGNS) + observer_section.jobs())
        needed = {f"feltgate_{job.design}" if job.design in runs.with_own_programs() else "feltgate" for job in jobs}
        built = re.search(r"^demo\|[^|]*\|([^|]*)", text_of("scripts/commands.txt"), re.M)[1].split()
        self.assertEqual(needed - set(built), set())


class Recordings(Scratch):
    def test_how_each_is_read(self):
        for name in ("avago_adns_2051_move_mouse_fast.sr", "mine.sr", "smoothieware.sr", "a/log.csv", "README.txt"):
            self.put(name, "x")
        told = [(r.path.name, r.arguments, r.sure) for r in recordings.find(self.folder, everything=False)]
        self.assertEqual(told, [("log.csv", (), False), ("avago_adns_2051_move_mouse_fast.sr", ("--probes", "YA,YB"), True),
                                ("mine.sr", (), False), ("smoothieware.sr", ("--step", "5", "--dir", "6"), True)])
        self.assertEqual(len(recordings.find(self.folder)), 6)

    def faults(self, recording, position):
        summary = {"position": dict(zip(("steps", "illegal", "reversals"), position))} if position else {}
        return recordings.faults(runs.Run(SimpleNamespace(recording=recording), 0, "cut off", summary))

    def test_known_numbers_and_only_a_guess_may_fail(self):
        self.put("avago_adns_2051_move_mouse_fast.sr", "x")
        mouse, _ = recordings.find(self.folder)
        self.assertEqual(self.faults(mouse, (4154, 0, 72)), [])
        self.assertIn("4153", self.faults(mouse, (4153, 0, 72))[0])
        self.assertEqual(len(self.faults(mouse, ())), 1)
        self.assertEqual(self.faults(recordings.Recording(self.folder / "mine.csv"), ()), [])


if __name__ == "__main__":
    unittest.main()
