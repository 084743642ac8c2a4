#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Which recordings are found, and how each is to be read. Documentation: docs/figures.md"""

import unittest
import zipfile

from bench import Bench  # isort: skip (puts scripts/ on the path)
from reports import recordings
from reports.runs import Run

METADATA = "[global]\nsigrok version=0.5\n[device 1]\nsamplerate={}\ntotal probes=4\nunitsize=1\n"


class Found(Bench):
    def capture(self, name, probes, rate="1 MHz", samples=500_000):
        with zipfile.ZipFile(self.folder / name, "w", zipfile.ZIP_DEFLATED) as archive:
            lines = "".join(f"probe{i}={p}\n" for i, p in enumerate(probes, 1))
            archive.writestr("metadata", METADATA.format(rate) + lines)
            archive.writestr("logic-1-1", bytes(samples))

    def found(self):
        all_found, complaints = recordings.find(self.folder)
        self.assertEqual(complaints, [])
        return all_found

    def test_mouse_gives_both_axes(self):
        self.capture("avago_adns_2051_move_mouse_fast.sr", ["SCLK", "XA", "XB", "YB", "YA", "PD"])
        x, y = self.found()
        self.assertEqual(x.arguments, ("--probes", "XA,XB"))
        self.assertEqual(y.arguments, ("--probes", "YA,YB"))
        self.assertEqual((x.seconds, x.sure, y.expected), (0.5, True, (4154, 0, 72)))
        self.assertEqual(recordings.one_of_each([x, y]), [y])

    def test_step_and_dir_of_the_motion_controller(self):
        self.capture("smoothieware.sr", list("01234567"), "12 MHz", 1_200_000)
        x, y = self.found()
        self.assertEqual(x.arguments, ("--step", "5", "--dir", "6"))
        self.assertEqual(y.arguments, ("--step", "3", "--dir", "4"))
        self.assertAlmostEqual(x.seconds, 0.1)
        self.assertEqual(recordings.one_of_each([x, y]), [x])

    def test_unknown_capture_is_guessed_and_not_sure(self):
        self.capture("mine.sr", ["enc_a", "enc_b", "x"])
        (one,) = recordings.one_of_each(self.found())
        self.assertEqual((one.channel, one.arguments), ("ENC", ("--probes", "enc_a,enc_b")))
        self.assertFalse(one.sure)

    def test_tables(self):
        (self.folder / "qube_1.csv").write_text("t, theta, alpha\n0,0,0\n4.0,1,2\n")
        (self.folder / "levels.csv").write_text("time,A,B\n0,0,0\n1,0,1\n")
        levels, qube = self.found()
        self.assertEqual(qube.arguments[3:], ("theta", "--scale", "2048/2pi"))
        self.assertEqual((qube.seconds, qube.sure), (4.0, True))
        self.assertEqual((levels.arguments, levels.sure), ((), False))

    def test_vector(self):
        head = "feltgate-vector 1 design=lever clock_hz=50000000 signals=A,B,Z\n0 0 0 1\n"
        (self.folder / "own.txt").write_text(head + "end 25000000\n")
        self.assertEqual(self.found()[0].seconds, 0.5)

    def test_what_is_no_recording_is_left_out(self):
        for name in ("README.txt", "LICENSE", "controller.toml", "notes.md"):
            (self.folder / name).write_text("words")
        self.assertEqual(self.found(), [])

    def test_damaged_files_are_complaints(self):
        (self.folder / "cut.sr").write_bytes(b"PK\x03\x04 and no more")
        with zipfile.ZipFile(self.folder / "empty.sr", "w") as archive:
            archive.writestr("version", "2")
        found, complaints = recordings.find(self.folder)
        self.assertEqual(found, [])
        self.assertRegex(" ".join(complaints), "cut.sr: .*empty.sr: no metadata")


class Judged(Bench):
    def run_of(self, recording, position):
        job = recordings.job(recording, 1, "lever", "damper")
        summary = {"position": dict(zip(("steps", "illegal", "reversals"), position, strict=True))}
        return Run(job, 0, summary=summary if position[0] else {}, complaint="cut off")

    def test_known_numbers(self):
        path = self.folder / "avago_adns_2051_move_mouse_fast.sr"
        known = recordings.Recording(path, "Y", (), 5.0)
        self.assertEqual(recordings.faults(self.run_of(known, (4154, 0, 72))), [])
        self.assertIn("4153", recordings.faults(self.run_of(known, (4153, 0, 72)))[0])

    def test_only_a_guess_may_fail(self):
        for sure, faults in ((True, 1), (False, 0)):
            guess = recordings.Recording(self.folder / "mine.csv", "", (), 1.0, sure)
            self.assertEqual(len(recordings.faults(self.run_of(guess, (0, 0, 0)))), faults)

    def test_rows_of_a_picture_are_bounded(self):
        long = recordings.Recording(self.folder / "a b.csv", "", (), 100.0)
        job = recordings.job(long, 3, "lever", "damper")
        self.assertEqual((job.every, job.name), (5000, "replay-03-a-b"))


if __name__ == "__main__":
    unittest.main()
