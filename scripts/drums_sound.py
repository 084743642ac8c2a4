#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Plays the hits of `feltgate run drums --events FILE` as a WAV file.

A drum is five modes of a round membrane under an envelope of attack, decay, sustain and release: the
speed of a hit is its loudness, its distance from the middle shortens the sustain.
Documentation: docs/devices/strings-and-drums.md
"""

import argparse
import re
import sys
from pathlib import Path

import numpy as np
from outputs import write_wav

RATE_HZ = 44_100
# Zeros of Bessel functions over the first, 2.405: modes of an ideal round membrane.
MODES = (1.0, 1.594, 2.136, 2.296, 2.653)
PITCH_HZ = {1: 180.0, 2: 120.0, 3: 75.0}
LOUDEST_M_S = 3.0  # what is full scale
ATTACK_S, DECAY_S, SUSTAIN_S, RELEASE_S = 0.002, 0.05, 0.4, 0.08
SUSTAIN_LEVEL = 0.4
NUMBER = r"(-?\d+(?:\.\d+)?(?:e-?\d+)?)"
HIT = re.compile(rf"{NUMBER} hit ([1-3]) {NUMBER} {NUMBER};")


class EventError(Exception):
    """A line that is no hit; the message is for the user."""


def read_hits(path):
    """Time in s, drum, speed in m/s and place (0 middle, 1 rim) of every hit of a file."""
    hits, now_s = [], 0.0
    for number, line in enumerate(Path(path).read_text(encoding="utf-8").splitlines(), 1):
        match = HIT.fullmatch(line)
        if not match:
            raise EventError(
                f'{path}:{number}: "{line[:40]}" is no hit; write "MS hit DRUM SPEED PLACE;" with '
                "drums 1 to 3, as `feltgate run drums --events` does"
            )
        now_s += float(match[1]) / 1e3
        hits.append((now_s, int(match[2]), float(match[3]), float(match[4])))
    return hits


def sound(drum, speed_m_s, place):
    """One hit, full scale 1."""
    sustain_s = SUSTAIN_S * (1.0 - min(max(place, 0.0), 1.0))
    ends = np.cumsum([0.0, ATTACK_S, DECAY_S, sustain_s, RELEASE_S])
    t = np.arange(int(ends[-1] * RATE_HZ)) / RATE_HZ
    envelope = np.interp(t, ends, [0.0, 1.0, SUSTAIN_LEVEL, SUSTAIN_LEVEL, 0.0])
    tones = sum(np.sin(2 * np.pi * PITCH_HZ[drum] * m * t) / (n + 1) for n, m in enumerate(MODES))
    loudness = min(max(speed_m_s, 0.0) / LOUDEST_M_S, 1.0)
    return loudness * envelope * tones / sum(1 / (n + 1) for n in range(len(MODES)))


def mixed(hits):
    """All hits, each where it happened; what goes beyond full scale is cut."""
    parts = [(int(at * RATE_HZ), sound(*hit)) for at, *hit in hits]
    samples = np.zeros(max((at + len(s) for at, s in parts), default=1))
    for at, s in parts:
        samples[at : at + len(s)] += s
    return np.clip(samples, -1.0, 1.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("events", metavar="FILE", help="of feltgate run drums --events")
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="WAV, 44.1 kHz")
    arguments = parser.parse_args()
    try:
        hits = read_hits(arguments.events)
        write_wav(arguments.output, mixed(hits), RATE_HZ)
    except (EventError, OSError, UnicodeDecodeError) as error:
        print(f"drums_sound: {error}", file=sys.stderr)
        return 2
    print(f"{arguments.output}: {len(hits)} hits")
    return 0


if __name__ == "__main__":
    sys.exit(main())
