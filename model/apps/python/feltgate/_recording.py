# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Encoder edges."""

import os
import warnings
from typing import Any, Dict, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from feltgate import _core
from feltgate._files import PathLike


class Recording:
    """An encoder recording as arrays, one value for each change of A, B or Z.

    feltgate.Recording("hand.sr", probes="XA,XB")     sigrok, VCD, Saleae, CSV or this project's .vec
    feltgate.Recording("axis.sr", step="5", dir="6")  STEP and DIR
    feltgate.Recording("log.csv", time_column="t", count_column="theta", scale="2048/2pi")
    feltgate.Recording.of_counts(time_s, counts)      a motion of your own

    probes        names of A, B and perhaps Z, "A,B" or a list; left out: guessed
    step, dir     names of the signals of a STEP and DIR recording
    time_column, count_column, scale   of a table; scale is counts per unit of the column
    time_unit     "s", "ms", "us" or "ns" of the time column; left out: as its name says, else "s"
    wrap          the count column begins again after so many of its units: 360, "2pi", 65536; True:
                  a turn of an angle, or 2^16 or 2^32 counts, as its first jump tells
    sample_hz     rate of the capture, where the file does not say it; rows without a time are its
                  samples
    format        "sigrok", "vcd", "saleae", "levels", "columns", "vector"; left out: by content
    jitter, seed  edges at a seeded place inside their sample, or at its start (docs/traces.md)
    clock_hz      clock of the design that will see it
    Raises ValueError "file:position: what is wrong; mend"; warns of what is hardly meant.
    """

    def __init__(self, path: PathLike, probes: Union[str, Sequence[str]] = (), *, step: str = "",
                 dir: str = "", time_column: str = "", time_unit: str = "", count_column: str = "",
                 scale: Union[str, float] = "", wrap: Union[None, bool, str, float] = None,
                 sample_hz: int = 0, format: str = "",
                 jitter: bool = True, seed: int = 1, clock_hz: int = 50_000_000):
        if isinstance(probes, str):
            probes = [name.strip() for name in probes.split(",") if name.strip()]
        wraps = None if wrap is None or wrap is False else "" if wrap is True else str(wrap)
        self._core = _core.Recording.read(
            os.fspath(path), list(probes), step, dir, time_column, time_unit, count_column,
            str(scale), wraps, sample_hz, format, jitter, seed, clock_hz)
        self._arrays = None  # type: Optional[Dict[str, Any]]
        for text in self._core.warnings:
            warnings.warn(text, stacklevel=2)

    @classmethod
    def of_counts(cls, time_s: npt.ArrayLike, counts: npt.ArrayLike, *,
                  clock_hz: int = 50_000_000) -> "Recording":
        """Positions [counts] at rising times [s]; the counts between two rows are spread evenly."""
        self = cls.__new__(cls)
        self._core = _core.Recording.of_counts(time_s, counts, clock_hz)
        self._arrays = None
        return self

    @property
    def name(self) -> str:
        """Name of the file."""
        return str(self._core.name)

    @property
    def clock_hz(self) -> int:
        """Clock that the edges are placed on, Hz."""
        return int(self._core.clock_hz)

    @property
    def length_s(self) -> float:
        """Length, s."""
        return float(self._core.length_clocks / self._core.clock_hz)

    @property
    def clock(self) -> "npt.NDArray[np.int64]":
        """Clock of each edge."""
        return self._all()["clock"]

    @property
    def time_s(self) -> "npt.NDArray[np.float64]":
        """Time of each edge, s."""
        return self.clock / self.clock_hz

    @property
    def counts(self) -> "npt.NDArray[np.int64]":
        """Position after each edge in counts from the start; an illegal edge leaves it."""
        return self._all()["counts"]

    @property
    def pins(self) -> "npt.NDArray[np.uint8]":
        """Levels after each edge: A in bit 0, B in bit 1, Z in bit 2."""
        return self._all()["pins"]

    @property
    def illegal(self) -> int:
        """Edges at which A and B changed at once."""
        return int(self._all()["illegal"])

    @property
    def reversals(self) -> int:
        """Changes of direction."""
        return int(self._all()["reversals"])

    def counts_at(self, time_s: npt.ArrayLike) -> "npt.NDArray[np.int32]":
        """Position at these times [s], in counts from the start: what a Chain takes."""
        before = np.searchsorted(self.clock, np.asarray(time_s) * self.clock_hz, side="right")
        return np.concatenate(([0], self.counts))[before].astype(np.int32)

    def _all(self) -> Dict[str, Any]:
        if self._arrays is None:
            self._arrays = self._core.arrays()
        return self._arrays

    def __len__(self) -> int:
        return len(self.clock)

    def __repr__(self) -> str:
        return f"<Recording {self.name}: {len(self)} edges in {self.length_s:g} s>"
