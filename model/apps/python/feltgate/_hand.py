# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What holds the lever."""

from typing import Any, Callable, Tuple, Union

import numpy as np
import numpy.typing as npt

from feltgate import _core

#: A function is asked for the angle at these many times a second.
SAMPLES_PER_S = 2000


class Hand:
    """What holds the lever: nothing, a motion, a torque, or an arm with mass and stiffness.

    Hand.motion(t, angle)     the lever goes where the array says, whatever the motor does
    Hand.torque(t, torque)    the hand pushes with a torque, the lever goes where it will
    Hand.impedance(t, angle)  an arm with mass, damping and stiffness that means to go there
    Hand.free()               nobody touches the lever
    """

    def __init__(self, core: Any, end_s: float):
        self._core, self.end_s = core, end_s

    @staticmethod
    def free() -> "Hand":
        """Nobody touches the lever."""
        return Hand(_core.Hand(), 0.0)

    @staticmethod
    def motion(time_s: npt.ArrayLike, angle_rad: npt.ArrayLike) -> "Hand":
        """The lever's angle [rad] at rising times [s] from 0 on.

        Between the points a smooth curve (cubic, continuous velocity); at rest before and after.
        The lever starts at the first angle.
        """
        return Hand(_core.Hand.motion(time_s, angle_rad), _end(time_s))

    @staticmethod
    def torque(time_s: npt.ArrayLike, torque_nm: npt.ArrayLike, start_rad: float = 0.0) -> "Hand":
        """Torque of the hand on the lever [Nm] at rising times [s]; straight lines between."""
        return Hand(_core.Hand.torque(time_s, torque_nm, start_rad), _end(time_s))

    @staticmethod
    def impedance(time_s: npt.ArrayLike, angle_rad: npt.ArrayLike, **arm: float) -> "Hand":
        """An arm whose rest angle [rad] follows the points; the lever moves as far as it yields.

        arm: mass_kg, damping_ns_m, stiffness_n_m, grip_stiffness_n_m, grip_damping_ns_m, all
        positive, at the radius where the hand holds; left out, those of a measured human arm
        (docs/plant.md).
        """
        return Hand(_core.Hand.impedance(time_s, angle_rad, **arm), _end(time_s))


def _end(time_s: npt.ArrayLike) -> float:
    return float(np.asarray(time_s, dtype=float).reshape(-1)[-1]) if np.size(time_s) else 0.0


HandLike = Union[Hand, Tuple[npt.ArrayLike, npt.ArrayLike], Callable[[Any], npt.ArrayLike]]


def as_hand(hand: HandLike, duration_s: float) -> Hand:
    """A Hand of what run() takes: one, a pair (time_s, angle_rad), or a function of the time."""
    if isinstance(hand, Hand):
        return hand
    if callable(hand):
        time_s = np.arange(0.0, duration_s + 1.0 / SAMPLES_PER_S, 1.0 / SAMPLES_PER_S)
        angle_rad = np.broadcast_to(np.asarray(hand(time_s), dtype=float), time_s.shape)
        return Hand.motion(time_s, angle_rad)
    if isinstance(hand, tuple) and len(hand) == 2:
        return Hand.motion(*hand)
    raise ValueError("hand is neither a feltgate.Hand, a pair (time_s, angle_rad) nor a function of "
                     "the time; see help(feltgate.Hand)")
