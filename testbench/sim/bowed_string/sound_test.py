#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The bowed string as a WAV: the string's pitch from the law at 40 kHz, another pitch from the same
at 1 kHz.

Documentation: docs/devices/bowed_string.md
"""

import unittest

import numpy as np

from playing import Player
from testing import BUILD, ROOT, ran, text_of


def pitch_hz(samples, rate):
    """Of the last 0.2 s, by the first large peak of the autocorrelation."""
    tone = samples[-int(0.2 * rate) :] - samples[-int(0.2 * rate) :].mean()
    alike = np.correlate(tone, tone, "full")[len(tone) - 1 :]
    alike /= alike[0] * (1 - np.arange(len(tone)) / len(tone))
    lags = np.arange(int(rate / 500), int(rate / 30))
    peaks = [k for k in lags if alike[k] == alike[k - 5 : k + 6].max() and alike[k] > 0.8]
    return rate / peaks[0] if peaks else 0.0


class BowedStringSound(Player):
    SCRIPT = "bowed_string_sound.py"

    def setUp(self):
        super().setUp()
        self.states = self.folder / "states.csv"

    def run_scene(self, scene, *more, status=0, program="feltgate_lever_law", design="lever_law",
                  engine="twin"):
        words = (scene, "--design", design, "--engine", engine, "--states", self.states, *more)
        done = ran(BUILD / program, "run", *words, "--quiet", cwd=ROOT)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr

    def play(self, status=0):
        return self.samples(self.states, status)

    def test_the_string_at_40_khz(self):
        self.run_scene("bowed_string")
        samples = self.play()
        self.assertAlmostEqual(pitch_hz(samples, self.rate), 196, delta=6)
        # One ramp and one step a period, as high as the corner: speed of the bow over its place,
        # and what the bow's stick and slip ripple on top of it.
        self.assertAlmostEqual(np.ptp(samples[-4000:]) * 2.5, 0.2 / 0.1, delta=0.6)
        header, *rows = self.states.read_text(encoding="utf-8").splitlines()
        self.assertEqual(header, "time_s,near,close,heard,stuck,since")
        times = [float(row.split(",")[0]) for row in rows]
        self.assertAlmostEqual(times[-1] - times[-2], 25e-6, delta=1e-9)

    def test_the_same_law_at_1_khz(self):
        law = text_of("rtl/laws/bowed_string.law")
        slow = law.replace("rate = 40 kHz", "rate = 1 kHz")
        self.assertNotEqual(law, slow)
        self.put("slow.law", slow)
        scene = text_of("vectors/scenes/bowed_string.toml")
        scene = scene[: scene.index("[[expect]]")].replace('"bowed_string"', '"slow.law"')
        self.run_scene(self.put("slow.toml", scene))
        samples = self.play()
        self.assertEqual(self.rate, 40000)
        changes = np.flatnonzero(np.diff(samples[400:8000]))
        self.assertTrue((np.diff(changes) % 40 == 0).all())  # held for 1 ms
        self.assertLess(pitch_hz(samples, self.rate), 150)

    def test_states_need_a_law_and_the_twin(self):
        self.assertIn("--states writes those of a law, and the scene runs none",
                      self.run_scene("membrane", status=2, program="feltgate", design="lever"))
        self.assertFalse(self.states.exists())
        self.assertIn("the RTL alone does not show when a law runs",
                      self.run_scene("bowed_string", status=2, engine="rtl"))
        self.assertFalse(self.states.exists())

    def test_what_are_no_states(self):
        for text, said in (
            ("", ':1: no columns "time_s" and "heard"'),
            ("time_s,stuck\n0,1\n", ':1: no columns "time_s" and "heard"'),
            ("time_s,heard\n0,0\n1,x\n", ":3: no row of states"),
            ("time_s,heard\n1,0\n0,0\n", ":3: time goes back"),
            ("time_s,heard\n0,nan\n", ":2: time goes back, or a value is none"),
            ("time_s,heard\n0,0\n", ": fewer than two runs of the law"),
        ):
            self.states.write_text(text, encoding="utf-8")
            self.assertIn(said, self.play(status=2))


if __name__ == "__main__":
    unittest.main()
