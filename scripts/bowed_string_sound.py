#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Writes the sound at the bridge of a bowed string, or of four, as a WAV file of 40 kHz, from
`feltgate run bowed_string --states FILE`. If a law runs slower, each of its values is held, as in a converter.

Documentation: docs/devices/strings-and-drums.md
"""

import argparse
import sys
from pathlib import Path

import numpy as np
from outputs import write_wav

RATE_HZ = 40_000
LOUDEST_M_S = 2.5  # what is full scale; more is cut


class StatesError(Exception):
    """A file without the string's states; the message is for the user."""


def read_states(path):
    """Times in s and what is heard of all strings in m/s, of every run of the law."""
    mend = "write it with feltgate run bowed_string --states FILE"
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    names = lines[0].split(",") if lines else []
    heard = [n for n, name in enumerate(names) if name.split("_")[0] == "heard"]
    if names[:1] != ["time_s"] or not heard or len(lines) < 3:
        raise StatesError(f'{path}: no two rows of "time_s" and "heard"; {mend}')
    try:
        rows = np.loadtxt(lines[1:], delimiter=",", ndmin=2)
    except ValueError as error:
        raise StatesError(f"{path}: {error}; {mend}") from None
    if rows.shape[1] != len(names) or not np.isfinite(rows).all() or (np.diff(rows[:, 0]) < 0).any():
        raise StatesError(f"{path}: a row that is too short or holds no number, or time goes back; {mend}")
    return rows[:, 0], rows[:, heard].sum(axis=1)


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
