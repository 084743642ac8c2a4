#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A pattern of drums as a WAV: loudness by speed, sustain by place, each hit at its time.

Documentation: docs/devices/drums.md
"""

import os
import subprocess
import sys
import tempfile
import unittest
import wave
from pathlib import Path

import numpy as np

ROOT = Path(os.environ["FELTGATE_ROOT"])
SCRIPT = ROOT / "scripts/drums_sound.py"


def loud_s(samples, rate):
    """How long windows of 10 ms stay above a fifth of the loudest."""
    window = rate // 100
    whole = samples[: len(samples) // window * window].reshape(-1, window)
    level = np.sqrt((whole**2).mean(axis=1))
    return 0.01 * np.count_nonzero(level > 0.2 * level.max())


class DrumsSound(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.events, self.out = Path(folder.name) / "e.txt", Path(folder.name) / "o.wav"

    def play(self, text, status=0):
        self.events.write_text(text, encoding="utf-8")
        ran = subprocess.run(
            [sys.executable, str(SCRIPT), str(self.events), "-o", str(self.out)],
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(ran.returncode, status, ran.stderr)
        if status != 0:
            self.assertFalse(self.out.exists())
            return ran.stderr
        with wave.open(str(self.out)) as sound:
            self.rate = sound.getframerate()
            data = sound.readframes(sound.getnframes())
        return np.frombuffer(data, "<i2") / 32767

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
        self.assertEqual(said.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
