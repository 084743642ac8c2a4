# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Closed loop and replay."""

import os
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Set, Tuple, Union

import numpy as np
import numpy.typing as npt

from feltgate import _core
from feltgate._files import PLANTS, SCENES, PathLike, design_files, find
from feltgate._hand import HandLike, as_hand
from feltgate._models import Plant
from feltgate._recording import Recording
from feltgate._results import Result

#: Left alone, every is chosen so that about this many rows come out.
ROWS = 20_000
ENGINES = ("twin", "float", "double", "quad")

Engines = Union[str, Sequence[str]]
Progress = Optional[Callable[[float], None]]


class Scene:
    """A scene file: what the core renders, what the hand does, how long it lasts.

    name: one of feltgate.scenes(), or the path of a scene file (docs/scenes.md).
    """

    def __init__(self, name: PathLike):
        self._core = _core.Scene(find(name, SCENES))

    @property
    def name(self) -> str:
        """Stem of its file."""
        return str(self._core.name)

    @property
    def title(self) -> str:
        """What it is called."""
        return str(self._core.title)

    @property
    def about(self) -> str:
        """What happens in it."""
        return str(self._core.about)

    @property
    def duration_s(self) -> float:
        """How long it lasts, s."""
        return float(self._core.duration_s)

    @property
    def plant(self) -> str:
        """Name of its plant."""
        return str(self._core.plant)

    @property
    def renders(self) -> Set[str]:
        """Torque laws of the core that it uses."""
        return set(self._core.renders)

    @property
    def parameters(self) -> Dict[str, float]:
        """Parameters that it sets before arming, in their units."""
        return dict(self._core.parameters)


def run(scene: Union[PathLike, Scene], design: str = "lever", engine: Engines = ENGINES, *,
        plant: Union[None, PathLike, Plant] = None, duration_s: Optional[float] = None,
        every: Optional[int] = None, set: Optional[Mapping[str, float]] = None,
        hand: Optional[HandLike] = None, seed: int = 1, progress: Progress = None) -> Result:
    """Runs a scene in closed loop: core, bridge, motor, lever, encoder and hand.

        r = feltgate.run("membrane")
        r = feltgate.run("spring_tension", hand=(time_s, angle_rad), set={"torque_limit": 0.3})
        r = feltgate.run("wall", "paper", "twin", every=1, duration_s=0.5)

    scene       one of feltgate.scenes(), the path of a scene file, or a Scene
    design      one of feltgate.designs()
    engine      one or several of "twin", "float" (binary32), "double" (binary64), "quad" (113 bits).
                The twin drives the motor, without it the first; the others see the same counts.
                Errors are taken against the most exact of them, and "quad" beside the twin brings
                the proven bounds.
    plant       one of feltgate.plants(), the path of a plant file, or a Plant whose constants are
                taken; left out: the scene's
    duration_s  left out: the scene's, or to the end of your hand's array
    every       keep one tick of so many; 1 keeps all (a million a second: 8 MB for each column);
                left out: about 20 000 rows. Errors and figures always come from all ticks.
    set         parameters of the core to set before arming, by name, in the units that
                feltgate.parameters() lists
    hand        what holds the lever instead of the scene's hand: a Hand, a pair of arrays (time_s,
                angle_rad), or a function that makes angles [rad] of an array of times [s]
    seed        of what reset leaves open
    progress    is called with 0..1 now and then

    What the scene expects is checked (Result.broken) unless hand or duration_s is given. Warns
    (UserWarning) where the speed that the scene's hand imposes jumps. Raises
    ValueError for input that cannot be used, KeyboardInterrupt after Ctrl-C.
    """
    chosen = scene if isinstance(scene, Scene) else Scene(scene)
    own = None
    if hand is not None:
        own = as_hand(hand, duration_s if duration_s is not None else chosen.duration_s)
        if duration_s is None:
            duration_s = own.end_s if own.end_s > 0 else chosen.duration_s
    if not isinstance(plant, Plant):
        plant = Plant(plant if plant is not None else chosen.plant, design=design)
    length_s = duration_s if duration_s is not None else chosen.duration_s
    what, names = _what(design, engine, every, length_s, seed)
    raw = _core.run(chosen._core, plant._core, what, dict(set or {}), duration_s,
                    own._core if own is not None else None, progress)
    return Result(raw, names, what.every)


def replay(recording: Union[PathLike, Recording, npt.ArrayLike], design: str = "lever",
           engine: Engines = ENGINES, *, scene: str = "spring_tension", arm: bool = True,
           every: Optional[int] = None, seed: int = 1, progress: Progress = None) -> Result:
    """Lets a recording move the lever while the core renders a scene; nothing feeds back.

        r = feltgate.replay("hand.vec", scene="damper")
        r = feltgate.replay(feltgate.Recording("hand.sr", probes="XA,XB"))
        r = feltgate.replay(counts)       # positions in counts, one for each tick

    recording  the path of a file whose probes can be guessed, a Recording, or an array of counts
    scene      what the core renders meanwhile (a law of the core, not a scene file)
    arm        False leaves the core disarmed
    design, engine, every, seed, progress: as in run()

    The rows have no plant: no theta_rad, no motor_torque_nm.
    """
    clock_hz, tick_hz = _core.rates(design_files(design) and design)
    if isinstance(recording, (str, os.PathLike)):
        recording = Recording(recording, clock_hz=clock_hz)
    elif not isinstance(recording, Recording):
        counts = np.asarray(recording)
        times = np.arange(counts.size) / tick_hz
        recording = Recording.of_counts(times, counts, clock_hz=clock_hz)
    what, names = _what(design, engine, every, recording.length_s, seed)
    return Result(_core.replay(recording._core, what, scene, arm, progress), names, what.every)


def _what(design: str, engine: Engines, every: Optional[int], length_s: float,
          seed: int) -> Tuple[Any, List[str]]:
    """What both kinds of run are told, and the back-ends that have columns."""
    design_path, registers_path = design_files(design)
    engines = engine if isinstance(engine, str) else ",".join(engine)
    if every is None:
        ticks = length_s * _core.rates(design)[1]
        every = round(ticks / ROWS) if ROWS < ticks < float("inf") else 1
    if every < 1:
        raise ValueError(f"every is {every}; give 1 to keep all ticks, or more to keep fewer")
    what = _core.What(design, design_path, registers_path, engines, every, seed)
    return what, list(_core.backend_names(engines))
