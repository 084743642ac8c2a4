# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the tests of the scripts that write a WAV share: the samples, or one line of refusal."""

import wave

import numpy as np
from testing import Scratch, script


class Player(Scratch):
    """A script that plays a file; `rate` is that of the last sound."""

    SCRIPT = ""

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out.wav"

    def samples(self, given, status=0, *more):
        """Full scale 1; what was said where the script ends with another status."""
        done = script(self.SCRIPT, given, "-o", self.out, *more)
        self.assertEqual(done.returncode, status, done.stderr)
        if status != 0:
            self.assertFalse(self.out.exists())
            self.assertEqual(done.stderr.count("\n"), 1)
            return done.stderr
        with wave.open(str(self.out)) as sound:
            self.rate = sound.getframerate()
            return np.frombuffer(sound.readframes(sound.getnframes()), "<i2") / 32767
