#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Plays a run of `feltgate run drums` as a WAV file, by its hits (--events FILE) or its force (--csv FILE).

A drum is five modes of a round membrane. For hits they are under an envelope of attack, decay, sustain
and release: the speed of a hit is its loudness, its distance from the middle shortens the sustain. For a
force they are masses on springs, which that force moves. Documentation: docs/devices/strings-and-drums.md
"""

import argparse
import csv
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
# Under a force; assumed: the stick of the scene, and a small source of sound in half a metre.
STICK_M, MODAL_KG, DECAY_PERIODS = 0.3, 0.1, 30.0
PRESSURE_PA_S2_M = 1.2 * 0.01 / (4 * np.pi * 0.5)  # density * area / (4 pi distance)
LOUDEST_PA = 0.01  # what is full scale: the skins are soft, and a contact takes 10 ms
HIT = re.compile(rf"{NUMBER} hit ([1-3]) {NUMBER} {NUMBER};")


class EventError(Exception):
    """A line that is no hit or no row; the message is for the user."""


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


def read_force(path):
    """Times in s, evenly apart, and the tip's force on the skin in N, of the rows of a run."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = csv.reader(file)
        header = next(rows)
        try:
            columns = header.index("time_s"), header.index("tau_ref_nm")
            data = np.array([[float(row[c]) for c in columns] for row in rows])
            steps = np.diff(data[:, 0])
            good = np.isfinite(data).all() and steps.min() > 0 and np.ptp(steps) < 0.01 * steps.min()
        except (ValueError, IndexError, csv.Error):
            good = False
    if not good:
        raise EventError(
            f'{path}: no rows of "time_s" and "tau_ref_nm" at even times; write it with '
            "feltgate run drums --engine twin --csv FILE"
        )
    return data[:, 0], np.abs(data[:, 1]) / STICK_M


def pressure(times, force_n, pitch_hz):
    """Sound pressure in Pa at RATE_HZ, a second longer than the force, of which each value is held.

    A mode with the growth g = -decay + i w has the way Im(z) / (m w), where z' = g z + force: exact from
    sample to sample. A small source of sound is as loud as what it moves is accelerated.
    """
    held_s = times[1] - times[0]
    at = np.arange(int((times[-1] - times[0] + 1.0) * RATE_HZ)) / RATE_HZ
    index = np.floor((at + 0.5 / RATE_HZ) / held_s).astype(int)
    force = np.where(index < len(force_n), force_n[np.minimum(index, len(force_n) - 1)], 0.0)
    total = np.zeros(len(at))
    for n, ratio in enumerate(MODES):
        w = 2 * np.pi * pitch_hz * ratio
        g = w * (1j - 1 / (2 * np.pi * DECAY_PERIODS))
        turn = np.exp(g / RATE_HZ)
        push, z, ways = (turn - 1) / g, 0j, np.empty(len(at), complex)
        for k, f in enumerate(force):
            ways[k] = z
            z = turn * z + push * f
        total += (g * (g * ways + force)).imag / (MODAL_KG * w * (n + 1))
    return PRESSURE_PA_S2_M * total


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("run", metavar="FILE", help="of feltgate run drums --events or --csv")
    parser.add_argument(
        "--drum", type=int, choices=PITCH_HZ, default=2, help="the one that a force moves; default 2"
    )
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="WAV, 44.1 kHz")
    arguments = parser.parse_args()
    try:
        with open(arguments.run, encoding="utf-8") as file:
            is_force = file.readline().startswith("time_s,")
        if is_force:
            heard_pa = pressure(*read_force(arguments.run), PITCH_HZ[arguments.drum])
            samples = np.clip(heard_pa / LOUDEST_PA, -1.0, 1.0)
            told = f"up to {np.abs(heard_pa).max():.3g} Pa"
        else:
            hits = read_hits(arguments.run)
            samples, told = mixed(hits), f"{len(hits)} hits"
        write_wav(arguments.output, samples, RATE_HZ)
    except UnicodeDecodeError:
        print(f"drums_sound: {arguments.run}: is no text", file=sys.stderr)
        return 2
    except (EventError, OSError) as error:
        print(f"drums_sound: {error}", file=sys.stderr)
        return 2
    print(f"{arguments.output}: {told}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
