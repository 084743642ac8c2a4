#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What a stranger sees first: numbers with bounds, pictures; and names that would do harm.

Documentation: docs/figures.md
"""

import json
import unittest
from concurrent.futures import ThreadPoolExecutor
from html import escape
from types import SimpleNamespace
from unittest import mock

from bench import Bench  # isort: skip (puts scripts/ on the path)
import numpy as np
from markup import Markup
from reports import demo_page, headline, observer_section, page, run_pictures, run_section
from reports.growing import Growing
from reports.runs import Job, Run, read_csv

HOSTILE = '"><img src=x onerror=alert(1)></script><script>alert(2)</script><!--<script>'


class Recorded(Bench):
    """Runs of the stand-in."""

    def run_of(self, name="membrane", **changes):
        json_path, csv_path = self.folder / "run.json", self.folder / "run.csv"
        self.fake("run", name, "--json", json_path, "--csv", csv_path, "--every", 200)
        return json.loads(json_path.read_text()) | changes, read_csv(csv_path)

    def replay_of(self, steps):
        path, json_path, csv_path = (self.folder / n for n in ("x.csv", "x.json", "x_out.csv"))
        path.write_text("t,count\n0,0\n0.5,3\n")
        self.fake("replay", path, "--json", json_path, "--csv", csv_path, "--every", 100)
        summary = json.loads(json_path.read_text())
        summary["position"]["steps"] = steps
        return summary, read_csv(csv_path)


class Headlines(Recorded):
    def test_numbers_are_those_of_the_json(self):
        summary, _ = self.run_of("torque_step")
        clocks, error, settling = headline.of_run(summary, run_section.steps_of(summary))
        self.assertEqual((clocks.value, clocks.good), ("0", True))
        self.assertIn(f"{summary['clocks']:,} clocks", clocks.what)
        torque = summary["engines"]["rtl"]["torque_nm"]
        self.assertEqual(error.value, f"{1e6 * torque['max_error']:#.3g} µNm")
        self.assertIn(f"{1e6 * torque['bound']:#.3g} µNm", error.bound)
        self.assertTrue(error.good)
        steps = summary["engines"]["rtl"]["step_responses"]
        self.assertEqual(settling.value, f"{max(s['torque_settling_ms'] for s in steps):#.3g} ms")
        self.assertIn("1.00 ms", settling.bound)  # torque_step.toml
        self.assertTrue(settling.good)

    def test_the_run_that_breaks_its_bound_is_shown(self):
        good, _ = self.run_of()
        large, broken = json.loads(json.dumps(good)), json.loads(json.dumps(good))
        large["engines"]["rtl"]["torque_nm"].update(max_error=9e-3, bound=1e-2)
        broken["engines"]["rtl"]["torque_nm"].update(max_error=2e-6, bound=1e-6)
        self.assertEqual(headline.error([good, large]).value, "9,000 µNm")
        shown = headline.error([good, large, broken])
        self.assertEqual((shown.value, shown.good), ("2.00 µNm", False))
        self.assertIn("broken", headline.tile(shown))

    def test_nothing_is_claimed_of_what_did_not_run(self):
        summary, _ = self.run_of()
        del summary["mismatches"]
        summary["engines"] = {"twin": {"speed": 1.0}}
        del summary["reference"]
        clocks, error, peak = headline.of_run(summary, [])
        self.assertIsNone(clocks.good)
        self.assertIn("not compared", clocks.bound)
        self.assertEqual((error.value, error.good), ("–", None))
        summary["engines"]["twin"]["torque_nm"] = {"max_error": 1e-5, "rms_error": 1e-6}
        beside_double = headline.error([summary | {"reference": "double"}])
        self.assertIn("binary64", beside_double.what)
        self.assertIn("--engine all", beside_double.bound)
        self.assertEqual(peak.value, "0.500 Nm")
        self.assertIn("0.5 Nm", peak.bound)


class Felt(Recorded):
    def test_what_acted_and_what_was_expected(self):
        summary, _ = self.run_of("wall")
        summary["felt"]["limits"] = {"torque": {"seconds": 0.25, "first_s": 0.5}}
        summary["felt"]["faults"] = {"i2t": {"seconds": 0.1, "first_s": 1.1}}
        summary["felt"]["expectations"][0]["kept"] = False
        found = Markup(run_section.inside(summary, []))
        self.assertIn("limit torque: acted for 0.250 s, first at 0.500 s", found.text)
        self.assertIn("fault i2t: acted for 0.100 s, first at 1.10 s", found.text)
        self.assertIn("gave 6.10 mJ and got 1.20 mJ back", found.text)
        rows = found.tables[0]
        self.assertEqual(rows[1], ["mismatches", "0", "at most 0", "no"])
        self.assertEqual(rows[2], ["tau_ref_min_nm", "-0.394", "-0.407 to -0.394", "yes"])
        self.assertEqual(rows[4], ["energy_absorbed_j", "0.0005", "at least 0.0005", "yes"])

    def test_a_bound_that_breaks_in_a_replay_is_a_fault(self):
        summary, _ = self.replay_of(50)
        self.assertEqual(run_section.faults_of(summary), [])
        error = {"max_error": 2e-5, "bound": 1e-5, "holds": False}
        summary["felt"]["errors"] = {"torque_nm": error}
        (fault,) = run_section.faults_of(summary)
        self.assertIn("torque_nm is off by 2e-05, above its proven bound 1e-05", fault)


    def test_float_lies_beside_fixed_where_it_ran(self):
        summary, csv = self.run_of("damper")
        self.assertNotIn("float", run_pictures.difference_picture("x", summary, csv).svg)
        summary["reference"] = "double"
        self.assertFalse(run_pictures.differs(summary, csv))
        for _, column, *_ in run_pictures.DIFFERENCES:
            csv[f"double_{column}"], csv[f"float_{column}"] = csv[column], csv[column] + 1e-6
        self.assertTrue(run_pictures.differs(summary, csv))
        picture = run_pictures.difference_picture("x", summary, csv)
        self.assertIn("minus double reference", picture.svg)
        self.assertIn(">float<", picture.svg)


    def test_a_device_of_several_axes(self):
        for scene, names in (("pantograph_floor", ["x-joints", "x-pen"]), ("coupled_levers", ["x-joints"])):
            summary, csv = self.run_of(scene)
            self.assertEqual([p.name for p in run_pictures.axes_pictures("x", csv)], names)
            self.assertIn("2 axes, 0 mismatches", run_section.axes_facts(summary)[0])


class Observer(unittest.TestCase):
    def test_numbers_of_a_load_step(self):
        time = np.arange(0, 0.35, 1e-4)
        after = np.maximum(time - observer_section.LOAD_S, 0)
        theta = 0.04 + 0.02 * (1 - np.exp(-after / 0.02) * np.cos(200 * after))
        torque = 0.1 + 0.001 * (-1) ** np.arange(len(time))
        csv = {"time_s": time, "theta_rad": theta, "motor_torque_nm": torque}
        ripple, over, rest = observer_section.of_load(SimpleNamespace(csv=csv))
        self.assertAlmostEqual(ripple, 1, places=3)
        self.assertAlmostEqual(over, 47.0, delta=0.5)  # at 14.5 ms
        self.assertLess(abs(rest - 47), 10)  # 0.02 exp(-t / 0.02) is a count after 51 ms


class Room(Recorded):
    def test_recordings_take_as_much_room_as_they_have_steps(self):
        drawn = {}
        for steps in (3, 99, 4154):
            summary, csv = self.replay_of(steps)
            drawn[steps] = len(run_pictures.pictures("x", summary, csv))
        self.assertEqual(drawn, {3: 0, 99: 1, 4154: 2})

    def test_the_page_grows(self):
        drawn = ["picture"]
        pool, pages = ThreadPoolExecutor(1), []
        with mock.patch.object(demo_page, "draw", lambda run: drawn):
            growing = Growing(pool, ["a", "b"], self.folder / "demo.html",
                              lambda _, drawn: pages.append(set(drawn)) or "page")
            growing.EVERY_S = 0
            for name in ("a", "unknown", "b"):
                growing.take(Run(Job(name, (), 1.0), 0, summary={"x": 1}))
            found = growing.result()
            pool.shutdown()
        self.assertEqual(set(found), {"a", "b"})
        self.assertEqual(pages[0], {"a"})
        self.assertEqual((self.folder / "demo.html").read_text(), "page")

    def test_a_page_that_cannot_be_written_is_told(self):
        drawn = ["picture"]
        with mock.patch.object(demo_page, "draw", lambda run: drawn), ThreadPoolExecutor(1) as pool:
            growing = Growing(pool, ["a"], self.folder / "none" / "demo.html", lambda *_: "page")
            growing.take(Run(Job("a", (), 1.0), 0, summary={"x": 1}))
            pool.shutdown()
            self.assertRaises(OSError, growing.result)

    def test_few_steps_are_a_line_of_the_demo(self):
        runs = {}
        for steps in (3, 4154):
            summary, csv = self.replay_of(steps)
            recording = SimpleNamespace(title=f"mouse {steps}", expected=None, sure=False)
            job = SimpleNamespace(name=f"replay-{steps}", recording=recording)
            told = {"summary": summary, "csv": csv, "ran": True, "mismatches": 0}
            told |= {"of_axes": False, "compared_clocks": summary["clocks"]}
            runs[job.name] = SimpleNamespace(job=job, design="lever", **told)
        demo = demo_page.Demo(runs, [], list(runs), {n: demo_page.draw(r) for n, r in runs.items()})
        found = Markup(demo_page.runs_section(demo))
        (line,) = found.classes("line")
        self.assertEqual(line["id"], "replay-3")
        told = "mouse 3: 3 steps, 0 illegal, 3 reversals in 0.500 s; 0 mismatches"
        self.assertIn(told, found.text)
        self.assertEqual(sum(tag == "img" for tag, _ in found.elements), 2)
        self.assertEqual(Markup(demo_page.document(demo)).complaints, [])


class Hostile(Recorded):
    def test_names_do_no_harm(self):
        summary, csv = self.run_of("wall", scene=HOSTILE, design=HOSTILE, version=HOSTILE)
        summary["plant"] = HOSTILE
        summary["expectations"]["broken"] = [HOSTILE]
        run, table = self.folder / "run.json", self.folder / "run.csv"
        run.write_text(json.dumps(summary))
        self.ended(self.script("report.py", self.folder / "out", run, table))
        text = (self.folder / "out" / "report.html").read_text()
        found = Markup(text)
        self.assertEqual(found.complaints, [])
        self.assertEqual([a.get("type") for a, _ in found.scripts], [None])
        self.assertFalse([t for t, a in found.elements if t == "img" and "onerror" in a])
        self.assertNotIn("<!--", text)
        self.assertIn(escape(HOSTILE), text)
        self.assert_self_contained(text)

    def test_data_cannot_end_its_element(self):
        text = page.embedded({"name": HOSTILE})
        self.assertNotIn("<", text)
        self.assertEqual(json.loads(text), {"name": HOSTILE})


if __name__ == "__main__":
    unittest.main()
