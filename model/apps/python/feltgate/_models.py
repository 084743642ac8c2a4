# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The parts of a run, each by itself."""

from typing import Any, Dict, List, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from feltgate import _core
from feltgate._files import PLANTS, PathLike, design_files, find
from feltgate._hand import Hand
from feltgate._results import Columns, Floats


def parameters(design: str = "lever") -> Dict[str, Dict[str, Any]]:
    """Every parameter of a design by name: its value, unit, and the step of its register."""
    design_files(design)
    return dict(_core.parameters(design))


def count_rad(design: str = "lever") -> float:
    """One encoder count as an angle, rad: a parameter in Nm/count is Nm/rad times this."""
    design_files(design)
    return float(_core.count_rad(design))


def formats(design: str = "lever") -> Dict[str, Tuple[int, int, int]]:
    """Word of each signal as (sign bits, bits before the binary point, bits behind it)."""
    design_files(design)
    return dict(_core.formats(design))


def laws(design: str = "lever") -> List[str]:
    """Torque laws that a design renders: what Chain, Twin and replay() call a scene."""
    return ["free", *_core.laws(design_files(design)[0])]


def bounds(design: str = "lever", scene: str = "", velocity_rad_s: float = 0.0) -> Dict[str, float]:
    """Proven worst case of |core - real arithmetic| by column name, in the column's unit.

    scene           what the core renders ("spring_tension", "wall", ...); left out: the worst of all
    velocity_rad_s  for every motion up to this speed; 0: for every motion at all
    Infinite where nothing can be promised. Theorem and proof: docs/error-bounds.md
    """
    return dict(_core.bounds(*design_files(design), scene, velocity_rad_s))


class Chain:
    """The laws of a design tick by tick in one arithmetic: a count in, torque and duty out.

    arithmetic: "fixed" (the core's integers), "float" (binary32), "double" (binary64), "quad"
    (113 bits). No pins, no supervisor: whether it is armed is told to run().
    """

    def __init__(self, design: str = "lever", arithmetic: str = "fixed"):
        design_files(design)
        self._core = _core.Chain(design, arithmetic)
        self.design, self.arithmetic = design, arithmetic

    def set(self, **values: float) -> "Chain":
        """Parameters by name, in the units that feltgate.parameters() lists: chain.set(torque_limit=0.3).

        Real arithmetic takes the value as it is, "fixed" rounds it to its register.
        Returns the chain.
        """
        for name, value in values.items():
            self._core.set(name, value)
        return self

    def reset(self) -> None:
        """State and parameters as the design has them."""
        self._core.reset()

    def run(self, counts: npt.ArrayLike, scene: str = "free", *, mode: str = "closed_loop",
            armed: bool = True) -> Columns:
        """Signals for encoder counts, one for each tick; the state goes on from call to call."""
        return Columns(self._core.run(_integers(counts, np.int32), scene, mode, armed))


class Plant:
    """Motor, lever, friction, encoder, supply and hand: what the core drives.

    name    one of feltgate.plants(), or the path of a plant file
    set     constants to change: {"lever.inertia_kg_m2": 2e-4}; parameters lists them
    design  whose bridge drives it (PWM rate, dead time, clock)
    hand    what holds the lever; left out: nothing
    """

    def __init__(self, name: PathLike = "p24", *, set: Optional[Mapping[str, float]] = None,
                 design: str = "lever", hand: Optional[Hand] = None):
        design_files(design)
        self._core = _core.Plant(find(name, PLANTS), dict(set or {}), design,
                                 (hand or Hand.free())._core)

    @property
    def name(self) -> str:
        """As its file says."""
        return str(self._core.name)

    @property
    def parameters(self) -> Dict[str, float]:
        """Every constant by "section.key", SI."""
        return dict(self._core.parameters)

    @property
    def theta_rad(self) -> float:
        """Angle of the lever now, rad."""
        return float(self._core.theta_rad)

    @property
    def counts(self) -> int:
        """What the encoder shows now."""
        return int(self._core.counts)

    @property
    def time_s(self) -> float:
        """Time since the start, s."""
        return float(self._core.time_s)

    def run(self, duty: npt.ArrayLike, *, step_clocks: int = 25, gates_on: bool = True) -> Columns:
        """Each duty (-1 to 1) holds for step_clocks clocks; what the plant shows after each.

        25 clocks are 0.5 us at 50 MHz. Columns: time_s, theta_rad, omega_rad_s, motor_current_a,
        motor_torque_nm, friction_nm, hand_torque_nm, supply_current_a, bus_v, counts. gates_on
        False: no gate is on, the current dies away through the diodes.
        """
        return Columns(self._core.run(np.atleast_1d(np.asarray(duty, dtype=float)), step_clocks,
                                      gates_on))

    def __repr__(self) -> str:
        return f"<Plant {self.name}: {self.theta_rad:g} rad after {self.time_s:g} s>"

    def reset(self) -> None:
        """At rest at the hand's first angle, time 0."""
        self._core.reset()


class Twin:
    """The core itself, bit by bit: an encoder count for each tick in, what its snapshots show out.

        twin = feltgate.Twin("lever")
        twin.set(torque_limit=0.3).arm("spring_tension")
        out = twin.run(counts)      # out.tau_ref_nm, out.faults, ...: one value for each tick
        out = twin.tick(120)        # one tick

    Encoder decoder, register port, ramp and supervisor are in it, so what is set or armed takes
    effect with one of the next ticks, and counts[i] shows in row i + 1.
    """

    def __init__(self, design: str = "lever"):
        design_files(design)
        self._core = _core.Twin(design)
        self.design = design
        self._scene, self._mode = "free", "closed_loop"

    def set(self, **values: float) -> "Twin":
        """Parameters by name, rounded to their registers; returns the twin.

        feltgate.parameters() lists names and units; count_rad() turns a stiffness in Nm/rad into
        Nm/count. The host port carries one write a tick.
        """
        for name, value in values.items():
            self._core.set(name, value)
        return self

    def arm(self, scene: str = "free", *, mode: str = "closed_loop") -> "Twin":
        """Renders a scene of feltgate.laws(); the torque ramps up. Returns the twin.

        mode: "closed_loop", "open_loop" (no feedback of tau_hat) or "voltage".
        """
        self._core.control(scene, mode, True)
        self._scene, self._mode = scene, mode
        return self

    def disarm(self) -> "Twin":
        """Gates off."""
        self._core.control(self._scene, self._mode, False)
        return self

    def clear_faults(self) -> "Twin":
        """Disarms and forgets the latched faults; run a few ticks, then arm again."""
        self.disarm()
        self._core.clear_faults()
        return self

    def stop(self, pressed: bool = True) -> "Twin":
        """The stop pin: opens the gates whatever the host says."""
        self._core.stop(pressed)
        return self

    def run(self, counts: npt.ArrayLike) -> Columns:
        """One tick for each count; the state goes on from call to call.

        Columns: position (counts), velocity_rad_s, tau_ref_nm, tau_hat_nm, torque_nm, current_a,
        voltage_v, duty, limits and faults (bit sets), armed. From one count to the next at most half
        as many counts as a tick has clocks, 25 with most designs. The first call begins at 0.
        """
        return Columns(self._core.run(_integers(counts, np.int64)))

    def tick(self, count: int) -> Dict[str, float]:
        """One tick with the encoder going to this count."""
        return {name: column[-1].item() for name, column in self.run([count]).items()}

    def reset(self) -> None:
        """As after power-up: count 0, disarmed. Parameters are the design's again."""
        self._core.reset()
        self._scene, self._mode = "free", "closed_loop"


def _integers(counts: npt.ArrayLike, kind: Any) -> Any:
    given = np.asarray(counts)
    integers = np.ascontiguousarray(given, dtype=kind)
    if not np.array_equal(integers, given):
        raise ValueError(f"counts holds numbers that are no {np.dtype(kind)}; round them")
    return integers
