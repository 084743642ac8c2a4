#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A pattern of drums as a WAV: loudness by speed, sustain by place, each hit at its time.

Documentation: docs/devices/strings-and-drums.md
"""

import unittest

import numpy as np

from playing import Player


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

    def test_what_is_no_hit(self):
        said = self.play("0.000 hit 2 1 0;\n5 strike 2 1 0;\n", status=2)
        self.assertIn('e.txt:2: "5 strike 2 1 0;" is no hit; write "MS hit', said)


if __name__ == "__main__":
    unittest.main()
