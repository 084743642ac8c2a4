#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The parts of `feltgate faults` that need no campaign: table, verdict, blocks, options."""

import json
import os
import unittest
from unittest import mock

from testing import Scratch, called
import faults
from fault_campaign import results


def state(register, kind="masked", safety=True, peak=0.0):
    return {"point": "state", "register": register, "bit": 0, "group": "pwm", "safety": safety,
            "act": "wall", "tick": 1, "clock": 2, "class": kind, "peak_nm": peak,
            "integral_nm_s": peak / 1000, "motor_peak_nm": 0}


def pin(kind, group="channel dead", changed=True):
    return {"point": "pins", "group": group, "seed": 1, "what": "", "must_flag": True,
            "class": kind, "peak_nm": 0, "integral_nm_s": 0, "motor_peak_nm": 0,
            "count_changed": changed}


class Results(unittest.TestCase):
    def test_a_zero_has_its_bound(self):
        self.assertEqual(results.bound(0, 300), "0 (< 0.99 %)")
        self.assertEqual(results.bound(0, 2), "0 (< 78 %)")
        self.assertEqual(results.bound(3, 300), "1 %")
        self.assertEqual(results.bound(0, 0), "-")

    def test_one_unsafe_fault_breaks_the_promise(self):
        some = [state("a") for _ in range(999)]
        self.assertTrue(all(good for *_, good in results.promises(some)))
        self.assertFalse(results.promises([*some, state("b", "unsafe")])[0][3])

    def test_what_nothing_sees_is_counted_apart(self):
        cut = pin("unsafe", "cable cut") | {"must_flag": False, "unseen": True}
        found = results.promises([state("a"), cut, pin("detected")])
        self.assertEqual([(n, of, good) for _, n, of, good in found[:2]],
                         [(0, 2, True), (1, 1, True)])
        self.assertIn("cable cut", found[1][0])

    def test_silent_flips_of_the_safety_state_may_be_one_in_a_hundred(self):
        some = [state("a") for _ in range(99)]
        self.assertTrue(results.promises([*some, state("b", "silent")])[1][3])
        two = [state("b", "silent"), state("c", "silent")]
        self.assertFalse(results.promises([*some, *two])[1][3])
        self.assertTrue(results.promises([*some, *[state("i", "silent", safety=False)] * 50])[1][3])

    def test_what_must_be_flagged_is(self):
        many = [pin("detected")] * 198
        # The count stands, and has nothing to be found by.
        shorted = [pin("silent", "channels shorted", False)] * 9
        promises = results.promises([*many, pin("silent"), *shorted])
        self.assertTrue(all(good for *_, good in promises))
        self.assertFalse(results.promises([*many, *[pin("silent", changed=False)] * 3])[1][3])
        self.assertFalse(results.promises([*many, *[pin("silent")] * 3])[1][3])

    def test_not_one_late_sensor_arms(self):
        late = pin("off", "late sensor") | {"must_flag": False, "must_refuse": True}
        found = results.promises([late, late])
        self.assertEqual(found[-1], ("not refused, of 'late sensor'", 0, 2, True))
        found = results.promises([late] * 999 + [late | {"class": "unsafe"}])
        self.assertEqual([good for *_, good in found], [False, False])


class Command(Scratch):
    def run_main(self, *words):
        return called(faults.main, *words)

    def test_lines_of_an_earlier_run(self):
        several = [state("a"), pin("detected"), {"mismatches": 0}]
        lines = self.put("l.jsonl", "".join(json.dumps(f) + "\n" for f in several))
        found = self.folder / "f.json"
        code, out, _ = self.run_main("--lines", lines, "--json", found)
        self.assertEqual(code, 0)
        self.assertIn("0 of 2, 0 (< 78 %)", out)
        written = json.loads(found.read_text())
        self.assertEqual((written["schema"], written["faults"]), (faults.SCHEMA, 2))
        self.put("l.jsonl", json.dumps(state("a", "unsafe")) + "\n")
        code, out, _ = self.run_main("--lines", lines)
        self.assertEqual(code, 1)
        self.assertIn("NOT KEPT", out)

    def test_refusals(self):
        for words, what in ((("--long",), "--clean"),
                            (("--clean", "--replay", "x"), "exclude"),
                            (("--update", "--only", "x"), "all registers"),
                            (("--design", "gimbal_motor", "--update"), "of lever"),
                            (("--lines", "/no/such"), "/no/such")):
            code, _, err = self.run_main(*words)
            self.assertEqual(code, 2, words)
            self.assertIn(what, err)

    def says(self, script):
        """A stand-in for feltgate_faults in a build folder."""
        self.put_program("feltgate_faults", script)
        self.enterContext(mock.patch.dict(os.environ, FELTGATE_BUILD=str(self.folder)))
        return self.folder

    def test_a_program_that_fails_is_told(self):
        for script, said in (("echo oh >&2; exit 3", "ended with status 3: oh"),
                             ("echo nothing", "no line of JSON"),
                             ("echo 3", "no object"), ("kill -SEGV $$", "killed by SIGSEGV"),
                             ("exit 0", "parts said nothing")):
            with self.subTest(script):
                self.says(script)
                code, _, err = self.run_main("--clean", "--jobs", "2")
                self.assertEqual(code, 2)
                self.assertIn(said, err)

    def test_false_alarms(self):
        line = {"clean_s": 300, "scenes_s": 100, "recordings_s": 100, "dither_s": 100, "alarms": 0,
                "first": ""}
        folder = self.says(f"""echo '{{"done": 0.5}}'; echo '{json.dumps(line)}'""")
        code, out, _ = self.run_main("--clean", "--jobs", "2", "--json", folder / "f.json")
        self.assertEqual(code, 0)
        self.assertIn("0 false alarms (< 18 an hour)", out)
        self.assertEqual(json.loads((folder / "f.json").read_text())["clean"]["clean_s"], 600)
        self.says(f"echo '{json.dumps(line | {'alarms': 1, 'first': 'speed'})}'; exit 1")
        code, out, _ = self.run_main("--clean", "--jobs", "1")
        self.assertEqual(code, 1)
        self.assertIn("1 false alarms\n  speed", out)

    def test_replay_tells_what_differs(self):
        listed, now = state("u_pwm.a", "latent"), state("u_pwm.a", "silent")
        folder = self.says(f"echo '{json.dumps(now)}'")
        cases, found = folder / "c.jsonl", folder / "f.json"
        cases.write_text(json.dumps(listed) + "\n", encoding="utf-8")
        code, out, _ = self.run_main("--replay", cases, "--json", found)
        self.assertEqual(code, 1)
        self.assertIn("listed as latent, now silent", out)
        self.assertEqual(json.loads(found.read_text())["replay"]["differing"],
                         [{"listed": listed, "now": "silent"}])
        cases.write_text(json.dumps(now) + "\n", encoding="utf-8")
        self.assertEqual(self.run_main("--replay", cases)[0], 0)
        cases.write_text("# no case\n", encoding="utf-8")
        code, _, err = self.run_main("--replay", cases)
        self.assertEqual(code, 2)
        self.assertIn("not one line of a fault", err)


if __name__ == "__main__":
    unittest.main()
