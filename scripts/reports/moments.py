# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The part of a run that a card shows: angle, torque asked for, torque felt, push of the hand.

Documentation: docs/figures.md
"""

from dataclasses import dataclass

import numpy as np

TOUCHED = 0.02  # of the largest torque asked for: from here on the object is touched
LEAST_NM = 1e-3  # below this nobody asked for anything


@dataclass(frozen=True)
class Moments:
    """Rows of a run around the time in which a torque was asked for, after each other in time."""

    time: np.ndarray  # s
    angle: np.ndarray  # degrees; the true one, in a replay the decoded one
    asked: np.ndarray  # Nm on the lever
    felt: np.ndarray | None  # the motor's, Nm; None in a replay, where nothing is moved
    hand: np.ndarray | None  # the hand's, Nm
    whole_s: float  # length of the run

    @property
    def touched(self):
        """Whether the object is felt, row by row."""
        most = np.abs(self.asked).max()
        return np.abs(self.asked) > max(TOUCHED * most, LEAST_NM)

    @property
    def peak(self):
        """The row of the largest torque; of the largest angle where there is none."""
        torque = np.abs(self.asked if self.felt is None else self.felt)
        if torque.max() > LEAST_NM:
            return int(torque.argmax())
        return int(np.abs(self.angle).argmax())

    @property
    def scale_nm(self):
        """The torque that an arrow of full length stands for."""
        both = [np.abs(x).max() for x in (self.asked, self.felt) if x is not None]
        return max(*both, LEAST_NM) if len(both) > 1 else max(both[0], LEAST_NM)


def of_run(summary, csv):
    """Moments of a run from its JSON and its CSV's columns."""
    moved = "scene" in summary
    angle = np.degrees(csv["theta_rad" if moved else "position_rad"])
    whole = Moments(
        csv["time_s"],
        angle,
        csv["tau_ref_nm"],
        csv["motor_torque_nm"] if moved else None,
        csv["hand_felt_nm"] if moved else None,
        float(csv["time_s"][-1]),
    )
    first, last = around(whole)
    return at(whole, slice(first, last + 1))


def around(m):
    """(first, last) row to show: what was touched, with half of its length and more before and
    after."""
    touched = np.flatnonzero(m.touched)
    if not len(touched):
        return 0, len(m.time) - 1
    begin, end = m.time[touched[0]], m.time[touched[-1]]
    margin = max(0.5 * (end - begin), 0.1 * m.whole_s)
    inside = np.flatnonzero((m.time >= begin - margin) & (m.time <= end + margin))
    return inside[0], inside[-1]


def thin(m, most):
    """At most so many rows, evenly spaced in time."""
    return at(m, np.unique(np.linspace(0, len(m.time) - 1, most).round().astype(int)))


def at(m, rows):
    """Some rows, by a slice or their numbers."""
    cut = [None if x is None else x[rows] for x in (m.time, m.angle, m.asked, m.felt, m.hand)]
    return Moments(*cut, m.whole_s)


def spans(flags):
    """[(first, last)] of the runs of rows that are set."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], flags.astype(int), [0]))))
    return [(int(a), int(b) - 1) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def zones(m, slices=90):
    """[(from, to, share)] in degrees: where on the lever's path torque was asked for, and how much
    of the largest, in eighths; neighbours of the same share are one zone."""
    low, high = float(m.angle.min()), float(m.angle.max())
    if high - low < 0.1 or high - low > 359 or not m.touched.any():
        return []
    edges = np.linspace(low, high, slices + 1)
    bins = np.clip(np.digitize(m.angle, edges) - 1, 0, slices - 1)
    most = np.zeros(slices)
    np.maximum.at(most, bins, np.where(m.touched, np.abs(m.asked), 0.0))
    shares = np.ceil(8 * most / most.max()) / 8
    found = []
    for i, share in enumerate(shares):
        if found and found[-1][2] == share and found[-1][1] == edges[i]:
            found[-1] = (found[-1][0], float(edges[i + 1]), float(share))
        elif share:
            found.append((float(edges[i]), float(edges[i + 1]), float(share)))
    return found
