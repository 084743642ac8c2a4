#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The bowed string as a WAV: the string's pitch from the law at 40 kHz. Four strings: each sounds at
its own pitch when it is crossed to, and dies away.

Documentation: docs/devices/strings-and-drums.md
"""

import unittest

import numpy as np

from playing import Player
from testing import BUILD, ROOT, ran


def pitch_hz(samples, rate):
    """Of the last 0.2 s, by the first large peak of the autocorrelation."""
    tone = samples[-int(0.2 * rate) :] - samples[-int(0.2 * rate) :].mean()
    alike = np.correlate(tone, tone, "full")[len(tone) - 1 :]
    alike /= alike[0] * (1 - np.arange(len(tone)) / len(tone))
    lags = np.arange(int(rate / 500), int(rate / 30))
    peaks = [k for k in lags if alike[k] == alike[k - 5 : k + 6].max() and alike[k] > 0.8]
    return rate / peaks[0] if peaks else 0.0


STRINGS = "gdae"
VIOLIN_HZ = [440 * 2 ** (7 * n / 12) for n in (-2, -1, 0, 1)]  # fifths of seven equal semitones
REFLECTED = (20 - 0.35) / (20 + 0.35)  # by the bridge, in each period


def amplitude(tone, hz, rate):
    """Of one frequency, under a Hann window."""
    turns = np.arange(len(tone)) * hz / rate
    return abs(tone @ (np.hanning(len(tone)) * np.exp(-2j * np.pi * turns))) * 2 / len(tone)


def loudest_hz(tone, rate):
    """From 100 Hz on, to 0.1 Hz."""
    step = rate / len(tone)
    lines = np.abs(np.fft.rfft(tone * np.hanning(len(tone))))[int(100 / step) :]
    near = (np.argmax(lines) + int(100 / step)) * step
    return max(near + np.arange(-step, step, 0.1), key=lambda hz: amplitude(tone, hz, rate))


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

    def test_states_need_a_law_and_the_twin(self):
        self.assertIn("--states writes those of a law, and the scene runs none",
                      self.run_scene("membrane", status=2, program="feltgate", design="lever"))
        self.assertFalse(self.states.exists())
        self.assertIn("the RTL alone does not show when a law runs",
                      self.run_scene("bowed_string", status=2, engine="rtl"))
        self.assertFalse(self.states.exists())

    def strings(self, scene):
        """Times, and what each string of the scene sends to the bridge; the slips of each."""
        told = self.folder / "events.txt"
        self.run_scene(scene, "--events", told)
        names = self.states.read_text(encoding="utf-8").split("\n", 1)[0].split(",")
        table = dict(zip(names, np.loadtxt(self.states, delimiter=",", skiprows=1).T))
        slips = {n: [] for n in STRINGS}
        at_s = 0.0
        for line in told.read_text(encoding="utf-8").splitlines():
            wait_ms, event, _ = line.split()
            at_s += float(wait_ms) / 1e3
            slips[event.removeprefix("slip_")].append(at_s)
        times = table["time_s"]
        self.assertAlmostEqual(times[-1] - times[-2], 32e-6, delta=1e-9)
        return times, [table[f"heard_{n}"] for n in STRINGS], slips

    def dies_away(self, tone, hz):
        """Its amplitude in 0.06 s, beside that in the 0.06 s before: the bridge takes 1 - REFLECTED in
        each period, and the low-pass at it something too, but less than as much again."""
        rate, n = 31250, 1875
        left = amplitude(tone[n : 2 * n], hz, rate) / amplitude(tone[:n], hz, rate)
        most = REFLECTED ** (0.06 * hz)
        self.assertLess(left, 1.01 * most)
        self.assertGreater(left, most**2)

    def test_crossing_makes_the_next_string_sound_and_the_last_die_away(self):
        times, heard, slips = self.strings("four_strings")
        # 2 rad/s from 0.02 s on, 0.3 rad for each; the arm gives way by less than 10 ms of it.
        for n, hz in enumerate(VIOLIN_HZ):
            begins, ends = 0.02 + 0.15 * n, 0.02 + 0.15 * (n + 1)
            self.assertTrue(all(begins < t < ends + 0.01 for t in slips[STRINGS[n]]))
            self.assertEqual(np.abs(heard[n][times < begins]).max(initial=0), 0)
            sounds = heard[n][(times > ends - 0.06) & (times < ends)]
            self.assertGreater(amplitude(sounds, hz, 31250), 0.1)
            self.assertLess(abs(loudest_hz(sounds, 31250) / hz - 1), 0.05)
            if n < 2:
                self.dies_away(heard[n][times > ends + 0.01], hz)
        self.assertAlmostEqual(np.ptp(self.play()[-2000:]) * 2.5, 0.2 / 0.1, delta=0.8)


if __name__ == "__main__":
    unittest.main()
