#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A pattern of drums as a WAV: loudness by speed, sustain by place, each hit at its time; and modes
under a force, against the closed form of a pulse and in a run of the scene.

Documentation: docs/devices/strings-and-drums.md
"""

import unittest

import numpy as np

from playing import Player
from testing import BUILD, ROOT, ran


def loud_s(samples, rate):
    """How long windows of 10 ms stay above a fifth of the loudest."""
    window = rate // 100
    whole = samples[: len(samples) // window * window].reshape(-1, window)
    level = np.sqrt((whole**2).mean(axis=1))
    return 0.01 * np.count_nonzero(level > 0.2 * level.max())


class DrumsSound(Player):
    SCRIPT = "drums_sound.py"

    def play(self, text, status=0):
        return self.samples(self.put("e.txt", text), status)

    def test_loudness_follows_the_speed(self):
        slow = np.abs(self.play("0.000 hit 2 0.6 0;\n")).max()
        fast = np.abs(self.play("0.000 hit 2 2.4 0;\n")).max()
        self.assertAlmostEqual(fast / slow, 4, delta=0.02)

    def test_sustain_falls_with_the_distance_from_the_middle(self):
        spans = []
        for place in ("1e-07", "0.5", "0.99"):
            samples = self.play(f"0.000 hit 1 2 {place};\n")
            spans.append(loud_s(samples, self.rate))
        self.assertAlmostEqual(spans[0] - spans[1], 0.2, delta=0.03)
        self.assertAlmostEqual(spans[1] - spans[2], 0.2, delta=0.03)

    def test_each_hit_at_its_time(self):
        samples = self.play("150.000 hit 2 2 0.9;\n600.000 hit 3 2 0.9;\n")
        heard = np.flatnonzero(np.abs(samples) > 0.02)
        self.assertAlmostEqual(heard[0] / self.rate, 0.150, delta=0.003)
        later = heard[heard > 0.5 * self.rate]
        self.assertAlmostEqual(later[0] / self.rate, 0.750, delta=0.003)

    def of_a_pulse(self, at, newton, long_s, drum_hz):
        """Sound of half a sine of force on five damped modes of 0.1 kg, full scale 1: Duhamel's
        integral of each in closed form, accelerated, at half a metre."""
        heard = np.zeros(len(at))
        a = np.pi / long_s
        until = np.minimum(at, long_s)
        force = newton * np.sin(a * until)
        for n, ratio in enumerate((1.0, 1.594, 2.136, 2.296, 2.653)):
            w = 2 * np.pi * drum_hz * ratio
            g = complex(-w / (2 * np.pi * 30), w)
            z = newton * a * (np.exp(g * until) - np.cos(a * until)) - g * force
            z *= np.exp(g * (at - until)) / (g * g + a * a)
            heard += (g * (g * z + force)).imag / (0.1 * w) / (n + 1)
        return 1.2 * 0.01 / (4 * np.pi * 0.5) * heard / 0.01

    def test_a_force_moves_the_modes(self):
        for drum, hz in ((1, 180), (3, 75)):
            long_s, newton, begin_s = 4e-3, 0.2, 0.02
            t = np.arange(0, 0.1, 20e-6)
            pulse = np.where(np.abs(t - begin_s - long_s / 2) < long_s / 2,
                             newton * np.sin(np.pi * (t - begin_s) / long_s), 0)
            rows = [f"{a:.9g},{-0.3 * f:.9g}" for a, f in zip(t, pulse)]
            path = self.put("run.csv", "\n".join(["time_s,tau_ref_nm", *rows]) + "\n")
            samples = self.samples(path, 0, "--drum", drum)
            at = np.arange(len(samples)) / self.rate - begin_s
            heard = (at > 0) & (at < 0.8)
            should = self.of_a_pulse(at[heard], newton, long_s, hz)
            self.assertGreater(np.abs(should).max(), 0.1)
            # A value is held for 20 us, half of it late: 2 pi 478 Hz * 10 us of the highest mode. A
            # sample of 23 us adds as much.
            off = np.abs(samples[heard] - should).max()
            self.assertLess(off, 0.05 * np.abs(should).max())

    def test_the_force_of_the_scene_is_heard(self):
        run = self.folder / "run.csv"
        words = ("drums", "--design", "lever_law", "--engine", "twin", "--quiet", "--csv", run)
        done = ran(BUILD / "feltgate_lever_law", "run", *words, "--every", 50, cwd=ROOT)
        self.assertEqual(done.returncode, 0, done.stderr)
        samples = self.samples(run)
        before = samples[: int(0.1 * self.rate)]  # the first hit is at 0.11 s
        self.assertLess(np.abs(before).max(), 0.02)
        # Afterwards the drum's lowest mode alone is left, an e-th less every 30 periods.
        rest = samples[int(0.7 * self.rate) :]
        spectrum = np.abs(np.fft.rfft(rest * np.hanning(len(rest))))
        self.assertAlmostEqual(np.argmax(spectrum) * self.rate / len(rest), 120, delta=1)
        tops = [np.abs(samples[int(a * self.rate) : int((a + 0.05) * self.rate)]).max() for a in (0.8, 1.05)]
        self.assertAlmostEqual(tops[0] / tops[1], np.e, delta=0.15)

    def test_what_is_no_hit(self):
        said = self.play("0.000 hit 2 1 0;\n5 strike 2 1 0;\n", status=2)
        self.assertIn('e.txt:2: "5 strike 2 1 0;" is no hit; write "MS hit', said)


if __name__ == "__main__":
    unittest.main()
