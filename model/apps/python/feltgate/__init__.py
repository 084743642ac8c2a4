# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate: a fixed-point core for haptic devices, its exact twin, motor, lever and hand.

    import feltgate
    r = feltgate.run("membrane", design="lever")
    print(r.felt.motor_nm.value, r["twin"].errors["velocity_rad_s"].max)
    plt.plot(r.time_s, r["twin"].tau_ref_nm)

All numbers come from the C++ model and are those of the program feltgate, bit by bit. Everything
is SI; units are in the names: _rad_s is rad/s, _nm is Nm. Nothing here ran on a board.

run       a scene in closed loop with motor, lever and hand: your own hand motion as an array
replay    an encoder recording, or counts of your own, through the core
Chain     one design in fixed point, float, double or 113 bits: counts in, arrays out
Twin      the core itself, tick by tick: parameters by name, scenes, arming, faults
Plant     motor and lever alone, driven by a duty
Recording encoder edges as arrays
Device    a board on a serial port, or one that feltgate board simulates
bounds    the proven worst case of each error

Unusable input raises ValueError, whose message names the mend. Ctrl-C ends a long run.
"""

from typing import TYPE_CHECKING, Any

from feltgate._core import version as __version__
from feltgate._files import designs, plants, root, scenes
from feltgate._hand import Hand
from feltgate._models import Chain, Plant, Twin, bounds, count_rad, formats, laws, parameters
from feltgate._recording import Recording
from feltgate._results import Acted, ErrorFigure, Expected, Felt, Peak, Result, Signals
from feltgate._runs import Scene, replay, run

if TYPE_CHECKING:
    from feltgate._device import Device, LinkLost, Refused

__all__ = [
    "Acted", "Chain", "Device", "ErrorFigure", "Expected", "Felt", "Hand", "LinkLost", "Peak",
    "Plant", "Recording", "Refused", "Result", "Scene", "Signals", "Twin", "bounds", "count_rad", "designs", "formats", "laws",
    "parameters", "plants", "replay", "root", "run", "scenes",
]


def __getattr__(name: str) -> Any:
    """Device, LinkLost and Refused come with a second module, which is loaded when it is used."""
    if name in ("Device", "LinkLost", "Refused"):
        from feltgate import _device  # pylint: disable=import-outside-toplevel
        return getattr(_device, name)
    raise AttributeError(f"module 'feltgate' has no attribute '{name}'")
