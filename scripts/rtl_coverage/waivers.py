# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""testbench/campaigns/coverage/waivers.toml: points that need not be reached, each with its reason."""

import re
import tomllib
from dataclasses import dataclass, field

from command_line import Refused

from .data import KINDS

FILE = "testbench/campaigns/coverage/waivers.toml"
MOST = 10


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
    """All of them; Refused where one cannot be used."""
    try:
        tables = tomllib.loads((root / FILE).read_text(encoding="utf-8")).get("waiver", [])
        found = [Waiver(**table | {"points": re.compile(table["points"])}) for table in tables]
    except (OSError, KeyError, TypeError, tomllib.TOMLDecodeError, re.error) as error:
        raise Refused(f"{FILE}: {error}") from error
    if any(waiver.kind not in KINDS or waiver.most < 1 for waiver in found):
        raise Refused(f"{FILE}: a kind is one of {', '.join(KINDS)}, and most is 1 or more")
    if len(found) > MOST:
        raise Refused(f"{FILE}: {len(found)} waivers, more than {MOST}")
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
