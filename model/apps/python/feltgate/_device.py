# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A board on a serial port, or one that `feltgate board` simulates."""

from types import TracebackType
from typing import Any, Dict, List, Optional, Sequence, Tuple, Type, Union

from feltgate import _host
from feltgate._files import DESIGNS, LAWS, PathLike, find, root
from feltgate._results import Columns

LinkLost = _host.LinkLost
Refused = _host.Refused

_WORDS = ("angle", "velocity", "tau_ref", "tau_hat", "current_ref", "voltage")


class Device:
    """A core behind its link, values in units: docs/host.md.

        with feltgate.Device("/dev/ttyUSB0") as device:
            device.set(torque_limit=0.1)
            device.arm("wall")
            live = device.stream(["angle", "tau_ref"], seconds=2.0)

    At the end of the block a motor that arm() has armed is disarmed. It also stops by itself when the
    watchdog is not kicked for watchdog_ticks (0.1 s): stream(), capture() and hold() kick it, and so
    must a program of yours with kick() in between. Not for several threads at once.

    port        a serial port, or the name that `feltgate board` prints
    design      name or file of the board's design; "": the one that has the board's CRC
    baud        bits per second, as the board was built
    patience_s  so long requests are repeated before LinkLost

    ValueError: no such port, in use by another program, unknown name, out of range. LinkLost, a
    ConnectionError: the port went away, nothing answers. Refused, a RuntimeError: a fault stands,
    the motor is armed.
    """

    def __init__(self, port: PathLike, design: PathLike = "", *, baud: int = 1_000_000,
                 patience_s: float = 3.0):
        path = find(design, DESIGNS) if design else ""
        self._host = _host.Device(str(port), str(root()), path, baud, patience_s)

    def __enter__(self) -> "Device":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Disarms what arm() has armed, and lets go of the port."""
        self._host.close()

    def info(self) -> Dict[str, Any]:
        """Board, design, whether it is simulated, armed, scene, faults, limits, all in_words."""
        return dict(self._host.info())

    def link(self) -> Dict[str, int]:
        """Requests since the port was opened, those that were repeated, damaged and lost frames."""
        return dict(self._host.link())

    def names(self) -> Dict[str, Dict[str, Any]]:
        """Everything that get() knows: unit, meaning, whether it can be set."""
        return dict(self._host.names())

    def get(self, name: str) -> float:
        """A value in its unit."""
        return float(self._host.get(name))

    def tick(self) -> Dict[str, float]:
        """All words of one tick in their units."""
        return dict(self._host.tick())

    def set(self, **values: Union[float, str]) -> Dict[str, float]:
        """Parameters in their units, or with another: set(torque_limit=0.1, wall_contact="0.2rad").

        Those of a law too, which come into force one after the other.

        Returns what they are after rounding to their words.
        """
        return {name: float(self._host.set(name, value)) for name, value in values.items()}

    def law(self, law: PathLike) -> Dict[str, Any]:
        """Compiles a law (a name in rtl/laws or a file), loads it, verifies it by reading it back.

        The motor must be disarmed. From then on set(), get() and names() know its parameters.
        Returns its name, the words that were compared, and those that had to be written.
        ValueError: a law that cannot be read or proven, with line and reason. Refused: armed, no
        engine.
        """
        return dict(self._host.law(find(law, LAWS, ".law")))

    def events(self, seconds: float = 0.0) -> List[Tuple[int, str, float]]:
        """Events of the law that wait, and those that come for so long: tick, name, value in SI."""
        return list(self._host.events(seconds))

    def arm(self, scene: str = "") -> None:
        """Arms with the watchdog awake; scene "" is the one that is chosen."""
        self._host.arm(scene)

    def hold(self, seconds: float) -> None:
        """Keeps the motor armed for so long. Raises Refused when a fault ends it."""
        self._host.hold(seconds)

    def kick(self) -> None:
        """Feeds the watchdog."""
        self._host.kick()

    def disarm(self) -> None:
        """Takes the request for torque away; the gates are off within a tick."""
        self._host.disarm()

    def stop(self) -> None:
        """The fault stop: gates off at once, until clear_faults()."""
        self._host.stop()

    def clear_faults(self) -> None:
        """Disarms and forgets faults. Raises Refused where a cause still stands."""
        self._host.clear_faults()

    def set_zero(self) -> None:
        """The position is 0 here."""
        self._host.set_zero()

    def select(self, scene: str) -> None:
        """What is rendered; an armed motor ramps over to it."""
        self._host.select(scene)

    def stream(self, names: Sequence[str] = _WORDS, *, seconds: float,
               every_s: float = 0.0) -> Columns:
        """Words of a tick for so long, every every_s or as fast as the wire: time_s and a column
        each."""
        return Columns(self._host.stream(list(names), every_s, seconds))

    def capture(self, names: Sequence[str] = _WORDS, *, trigger: str = "now", before: float = 0.25,
                span_s: float = 0.0, wait_s: float = 10.0) -> Columns:
        """1024 rows around a trigger, a tick a row or stretched over span_s; time_s is 0 at the
        trigger.

        trigger  "velocity>5", "angle<-10deg", "fault", "fault:speed", "limit:current", "armed",
                 "event:hit" of the law, "now"
        before   share of the rows before it
        """
        return Columns(self._host.capture(list(names), trigger, before, span_s, wait_s))
