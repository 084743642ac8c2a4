#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The parts of `feltgate faults` that need no campaign: table, verdict, blocks, options."""

import contextlib
import io
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FELTGATE_ROOT") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True
import faults  # noqa: E402
from faulting import campaign, results  # noqa: E402


def state(register, kind="masked", safety=True, peak=0.0):
    return {"point": "state", "register": register, "bit": 0, "group": "pwm", "safety": safety, "act": "wall",
            "tick": 1, "clock": 2, "class": kind, "peak_nm": peak, "integral_nm_s": peak / 1000, "motor_peak_nm": 0}


def pin(kind, group="channel dead", changed=True):
    return {"point": "pins", "group": group, "seed": 1, "what": "", "must_flag": True, "class": kind,
            "peak_nm": 0, "integral_nm_s": 0, "motor_peak_nm": 0, "count_changed": changed}


class Results(unittest.TestCase):
    def test_a_zero_has_its_bound(self):
        self.assertEqual(results.bound(0, 300), "0 (< 1 %)")
        self.assertEqual(results.bound(3, 300), "1 %")
        self.assertEqual(results.bound(0, 0), "-")

    def test_one_unsafe_fault_breaks_the_promise(self):
        some = [state("a") for _ in range(999)]
        self.assertTrue(all(good for *_, good in results.promises(some)))
        self.assertFalse(results.promises([*some, state("b", "unsafe")])[0][3])

    def test_silent_flips_of_the_safety_state_may_be_one_in_a_hundred(self):
        some = [state("a") for _ in range(99)]
        self.assertTrue(results.promises([*some, state("b", "silent")])[1][3])
        self.assertFalse(results.promises([*some, state("b", "silent"), state("c", "silent")])[1][3])
        self.assertTrue(results.promises([*some, *[state("i", "silent", safety=False)] * 50])[1][3])

    def test_what_must_be_flagged_is(self):
        many = [pin("detected")] * 198
        self.assertTrue(results.promises([*many, pin("silent"), pin("silent", changed=False)])[1][3])
        self.assertFalse(results.promises([*many, *[pin("silent")] * 3])[1][3])

    def test_a_register_is_of_the_deepest_block(self):
        blocks = {"dob", "lowpass", "registers", "scene_charge", "velocity_n"}
        for register, block in (("u_dob.u_lowpass.y_o", "lowpass"), ("u_dob.drive_q", "dob"),
                                ("u_scenes.gen_charge.u_charge.rest_q", "scene_charge"),
                                ("scene_q", "feltgate_core"), ("parameter overspeed", "registers"),
                                ("velocity line", "velocity_n")):
            self.assertEqual(results.block_of(state(register), blocks), block)

    def test_per_block_counts_safety_state_only(self):
        found = results.per_block([state("u_dob.a", "silent"), state("u_dob.b", safety=False), pin("silent")], {"dob"})
        self.assertEqual(found, {"dob": {"unsafe": [0, 1], "silent": [1, 1]}})

    def test_table_has_a_row_per_group(self):
        text = results.text_table(results.rows_of([state("a", peak=0.25), pin("detected")]))
        self.assertIn("pwm", text)
        self.assertIn("0.250", text)
        self.assertEqual(len(text.splitlines()), 3)


class Command(unittest.TestCase):
    def run_main(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = faults.main([str(w) for w in words])
            except SystemExit as ended:
                code = ended.code
        return code, out.getvalue(), err.getvalue()

    def test_lines_of_an_earlier_run(self):
        with tempfile.TemporaryDirectory() as folder:
            lines, found = Path(folder, "l.jsonl"), Path(folder, "f.json")
            lines.write_text("".join(json.dumps(f) + "\n" for f in [state("a"), pin("detected"), {"mismatches": 0}]))
            code, out, _ = self.run_main("--lines", lines, "--json", found)
            self.assertEqual(code, 0)
            self.assertIn("0 of 2, 0 (< 1.5e+02 %)", out)
            written = json.loads(found.read_text())
            self.assertEqual((written["schema"], written["faults"]), (faults.SCHEMA, 2))
            lines.write_text(json.dumps(state("a", "unsafe")) + "\n")
            code, out, _ = self.run_main("--lines", lines)
            self.assertEqual(code, 1)
            self.assertIn("NOT KEPT", out)

    def test_refusals(self):
        for words, what in ((("--long",), "--clean"), (("--jobs", "0"), "at least 1"), (("--flips", "-1"), "0 or more"),
                            (("--picture", "x.bmp"), ".svg or .png"), (("--clean", "--replay", "x"), "exclude"),
                            (("--update", "--only", "x"), "all registers"), (("--lines", "/no/such"), "/no/such")):
            code, _, err = self.run_main(*words)
            self.assertEqual(code, 2, words)
            self.assertIn(what, err)

    def test_a_program_that_fails_is_told(self):
        with self.assertRaisesRegex(campaign.CampaignError, "ended with 3"):
            campaign.Parts("/bin/sh", ["-c", "echo oh >&2; exit 3"], 1, lambda *_: None).run()


if __name__ == "__main__":
    unittest.main()
