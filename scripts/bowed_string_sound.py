#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Writes the sound at the bridge of a bowed string, or of four, as a WAV file of 40 kHz, from
`feltgate run bowed_string --states FILE`. If a law runs slower, each of its values is held, as in a converter.

Documentation: docs/devices/strings-and-drums.md
"""

import argparse
import csv
import sys

import numpy as np
from outputs import write_wav

RATE_HZ = 40_000
LOUDEST_M_S = 2.5  # what is full scale; more is cut


class StatesError(Exception):
    """A file without the string's states; the message is for the user."""


def read_states(path):
    """Times in s and what is heard of all strings in m/s, of every run of the law."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    mend = "; write it with feltgate run bowed_string --states FILE"
    columns = [n for n, name in enumerate(rows[0] if rows else []) if name.split("_")[0] == "heard"]
    if not columns or rows[0][0] != "time_s":
        raise StatesError(f'{path}:1: no columns "time_s" and "heard"{mend}')
    times, heard = [], []
    for number, row in enumerate(rows[1:], 2):
        try:
            times.append(float(row[0]))
            heard.append(sum(float(row[n]) for n in columns))
        except (ValueError, IndexError):
            raise StatesError(f"{path}:{number}: no row of states{mend}") from None
        if not np.isfinite([times[-1], heard[-1]]).all() or times[-2:] != sorted(times[-2:]):
            raise StatesError(f"{path}:{number}: time goes back, or a value is none{mend}")
    if len(times) < 2:
        raise StatesError(f"{path}: fewer than two runs of the law{mend}")
    return np.array(times), np.array(heard)


def sound(times, heard):
    """Samples at RATE_HZ, full scale 1; each value holds until the next run."""
    at = times[0] + np.arange(int((times[-1] - times[0]) * RATE_HZ) + 1) / RATE_HZ
    # Half a sample on, so that rounding does not take the value of a run before.
    last = np.searchsorted(times, at + 0.5 / RATE_HZ, side="right") - 1
    return np.clip(heard[last] / LOUDEST_M_S, -1.0, 1.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("states", metavar="FILE", help="CSV of feltgate run bowed_string --states")
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="WAV, 40 kHz")
    arguments = parser.parse_args()
    try:
        samples = sound(*read_states(arguments.states))
        write_wav(arguments.output, samples, RATE_HZ)
    except (StatesError, OSError, UnicodeDecodeError) as error:
        print(f"bowed_string_sound: {error}", file=sys.stderr)
        return 2
    print(f"{arguments.output}: {len(samples) / RATE_HZ:.2f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
