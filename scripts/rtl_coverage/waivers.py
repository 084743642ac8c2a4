# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""testbench/campaigns/coverage/waivers.toml: points that need not be reached, each with its reason."""

import re
import tomllib
from dataclasses import dataclass, field

from .data import KINDS

from command_line import Refused

FILE = "testbench/campaigns/coverage/waivers.toml"
MOST = 10
KEYS = {"block", "kind", "points", "most", "reason"}


class WaiverError(Refused):
    """A waiver that cannot be used; the message says which and why."""


@dataclass
class Waiver:
    """Points that need not be reached."""

    block: str  # or some, with blanks between
    kind: str
    points: re.Pattern  # of the whole name
    most: int  # so many of them
    reason: str
    used: list = field(default_factory=list)

    def fits(self, point):
        """Whether it takes this point, too."""
        if len(self.used) == self.most:
            return False
        return (
            point.kind == self.kind
            and point.block in self.block.split()
            and bool(self.points.fullmatch(point.name))
        )


def read(root):
    """All of them; WaiverError where one cannot be used."""
    path = root / FILE
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8")).get("waiver", [])
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise WaiverError(f"{FILE}: {error}") from error
    if len(tables) > MOST:
        raise WaiverError(f"{FILE}: {len(tables)} waivers, more than {MOST}")
    found = []
    for number, table in enumerate(tables, 1):
        where = f"{FILE}: waiver {number}"
        if set(table) != KEYS:
            raise WaiverError(f"{where}: needs the keys {', '.join(sorted(KEYS))} and no others")
        if table["kind"] not in KINDS:
            raise WaiverError(f"{where}: kind '{table['kind']}'; there are {', '.join(KINDS)}")
        if len(table["reason"]) < 20:
            raise WaiverError(f"{where}: a reason is a sentence")
        if not isinstance(table["most"], int) or table["most"] < 1:
            raise WaiverError(f"{where}: most is a number of points")
        try:
            found.append(
                Waiver(
                    table["block"],
                    table["kind"],
                    re.compile(table["points"]),
                    table["most"],
                    table["reason"],
                )
            )
        except re.error as error:
            raise WaiverError(f"{where}: points: {error}") from error
    return found


def take(waivers, missed):
    """The points of `missed` that no waiver fits; those that one does are entered in it."""
    left = []
    for point in missed:
        fitting = next((waiver for waiver in waivers if waiver.fits(point)), None)
        if fitting:
            fitting.used.append(point)
        else:
            left.append(point)
    return left
