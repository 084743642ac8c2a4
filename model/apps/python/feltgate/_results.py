# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What runs give back. Columns are numpy arrays, one value for each tick that was kept."""

from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Mapping, Optional

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Bits = npt.NDArray[np.uint8]


class Columns(Mapping[str, Any]):
    """Arrays by name: c.velocity_rad_s or c["velocity_rad_s"]; list(c) names them all."""

    def __init__(self, columns: Mapping[str, Any]):
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> Any:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __getattr__(self, name: str) -> Any:
        # Only what is no real attribute comes here; during unpickling there is nothing yet.
        columns = self.__dict__.get("_columns", {})
        if name in columns:
            return columns[name]
        raise AttributeError(f"no column \"{name}\"; there are {', '.join(columns)}")

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._columns]

    def __repr__(self) -> str:
        rows = len(next(iter(self._columns.values()))) if self._columns else 0
        return f"<{type(self).__name__}: {rows} rows of {', '.join(self._columns)}>"


@dataclass(frozen=True)
class ErrorFigure:
    """Difference of a signal from its reference over a run: largest magnitude and root mean square of the
    ticks for which its bound holds, and the largest of the others: ramps, saturation and what follows."""

    max: float
    rms: float
    outside: float = 0.0
    ticks_outside: int = 0


class Signals(Columns):
    """What one back-end computed in each tick kept."""

    velocity_rad_s: Floats  #: velocity after its low-pass, rad/s
    tau_ref_nm: Floats  #: torque that the scene asks for, limited and ramped, Nm
    tau_hat_nm: Floats  #: torque that the observer sees, Nm
    torque_nm: Floats  #: torque that is commanded: nominal torque constant times current_a, Nm
    current_a: Floats  #: current reference, A
    voltage_v: Floats  #: voltage for the motor, V
    duty: Floats  #: of the PWM period, -1 to 1

    #: Of all ticks, kept or not, against Result.reference; empty for the reference itself.
    errors: Dict[str, ErrorFigure]
    #: Time spent in this back-end, s.
    busy_s: float

    def __init__(self, columns: Mapping[str, Any], errors: Mapping[str, Mapping[str, float]],
                 busy_s: float):
        super().__init__(columns)
        self.errors = {name: ErrorFigure(**figure) for name, figure in errors.items()}
        self.busy_s = busy_s


@dataclass(frozen=True)
class Peak:
    """Largest magnitude of a signal, with its sign, and when it came."""

    value: float
    at_s: float


@dataclass(frozen=True)
class Acted:
    """How long a limit or fault acted, and since when, in s."""

    seconds: float
    first_s: float


@dataclass(frozen=True)
class Expected:
    """An expectation of the scene: the figure, its value and bounds, and whether it was kept."""

    figure: str
    value: float
    low: float
    high: float
    kept: bool


@dataclass(frozen=True)
class Felt:
    """What was felt. Torques in Nm, work in J; None where there was no plant."""

    asked_nm: Peak  #: by the scene
    commanded_nm: Peak  #: nominal torque constant times the current reference
    motor_nm: Optional[Peak] = None  #: of the plant's motor, averaged over each PWM period
    hand_nm: Optional[Peak] = None  #: of the hand on the lever
    motor_error_nm: Optional[ErrorFigure] = None  #: motor less asked
    taken_from_hand_j: Optional[float] = None  #: sum of all that the hand gave
    given_to_hand_j: Optional[float] = None  #: sum of all that it got
    limits: Dict[str, Acted] = field(default_factory=dict)  #: only those that acted
    faults: Dict[str, Acted] = field(default_factory=dict)
    tau_hat_void_s: float = 0.0  #: how long voltage or duty were at the limit, so that tau_hat was void
    expectations: List[Expected] = field(default_factory=list)

    @staticmethod
    def _of(raw: Mapping[str, Any]) -> "Felt":
        values = dict(raw)
        for name in ("asked_nm", "commanded_nm", "motor_nm", "hand_nm"):
            if name in values:
                values[name] = Peak(**values[name])
        if "motor_error_nm" in values:
            values["motor_error_nm"] = ErrorFigure(**values["motor_error_nm"])
        for name in ("limits", "faults"):
            values[name] = {key: Acted(**value) for key, value in values[name].items()}
        values["expectations"] = [Expected(**one) for one in values["expectations"]]
        return Felt(**values)


class Result(Columns):
    """A run: its columns, those of each back-end as r["twin"], and what was felt.

    The signals of the base (r.velocity_rad_s and so on) are those of the back-end that drove the
    motor: the twin, or the first one named without it. pandas.DataFrame(dict(r.table())) makes a table of everything.
    """

    time_s: Floats  #: device time of the tick, s
    theta_rad: Floats  #: angle of the plant's lever, rad; not in a replay
    omega_rad_s: Floats  #: its velocity, rad/s; not in a replay
    motor_torque_nm: Floats  #: of the plant's motor, averaged over each PWM period, Nm; not in a replay
    hand_torque_nm: Floats  #: of the hand on the lever, Nm; not in a replay
    hand_felt_nm: Floats  #: its mean over the last 1 ms that is over, Nm; not in a replay
    position_rad: Floats  #: the core's count as an angle, rad
    velocity_rad_s: Floats  #: these seven as in Signals, of the back-end that drove the motor
    tau_ref_nm: Floats
    tau_hat_nm: Floats
    torque_nm: Floats
    current_a: Floats
    voltage_v: Floats
    duty: Floats
    limits: Bits  #: bit set of the limits that hold the torque
    faults: Bits  #: bit set of the latched faults

    design: str
    subject: str  #: scene or recording
    ticks: int  #: all that ran, kept or not
    simulated_s: float
    every: int  #: one tick of so many was kept
    reference: Optional[str]  #: back-end that the errors are taken against: "quad" or "double"
    engines: Dict[str, Signals]
    felt: Felt
    #: Proven bounds on errors[...].max of the fixed point in this motion, against "quad"; None without it.
    bounds: Optional[Dict[str, float]]
    figures: Dict[str, float]  #: what scene files put bounds on; docs/scenes.md
    broken: List[str]  #: expectations and bounds that do not hold, one line each

    def __init__(self, raw: Mapping[str, Any], names: List[str], every: int):
        columns = dict(raw["columns"])
        self._table = dict(columns)
        own = {name: {} for name in names}  # type: Dict[str, Dict[str, Any]]
        for column in list(columns):
            for name in names:
                if column.startswith(name + "_"):
                    own[name][column[len(name) + 1:]] = columns.pop(column)
        if len(names) == 1:
            # One back-end: its signals are those of the base, and the same arrays.
            own[names[0]] = {name: columns[name] for name in Signals.__annotations__
                             if name in columns}
            self._table.update({f"{names[0]}_{name}": own[names[0]][name] for name in own[names[0]]})
        super().__init__(columns)
        figures = raw["engines"]
        self.engines = {name: Signals(own[name], figures[name].get("errors", {}),
                                      figures[name]["busy_s"]) for name in names}
        self.felt = Felt._of(raw["felt"])
        self.every = every
        for name in ("design", "subject", "ticks", "simulated_s", "reference", "bounds", "figures",
                     "broken"):
            setattr(self, name, raw[name])

    def __getitem__(self, name: str) -> Any:
        """Signals of a back-end, or a column."""
        if name in self.engines:
            return self.engines[name]
        return super().__getitem__(name)

    def table(self) -> Dict[str, Any]:
        """Every column under the name that it has in the CSV of feltgate run."""
        return dict(self._table)
