# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A space file: a base design and sweeps over its keys, as a list of design points.

A point is {"base": NAME, "set": {"section.key": value}}; `set` holds only what differs from the
base, so the same design from two sweeps is one point. Documentation: docs/speed-for-accuracy.md
"""

import difflib
import hashlib
import itertools
import json
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

from command_line import Refused

# Keys that a design may leave out, with what it then means.
OPTIONAL = {
    "velocity.gain": None,
    "formats.rounding": "half_up",
}
# Keys that designs had, and what is so in all of them now.
GONE = {
    "formats.coefficient_bits": "coefficients have 17 bits",
    "fabric.multipliers": "each block has a multiplier of its own",
    "commutation.modulation": "three phases are driven by space vectors",
}
# A register carries these: points that differ in nothing else can share one built structure.
CARRIED = ("velocity.cutoff_rad_s", "observer.cutoff_rad_s")
MAX_POINTS = 100_000


class SpaceError(Refused):
    """A space file that cannot be used: 'file:line: what; mend'."""


@dataclass(frozen=True)
class Space:
    """What a space file says, and its points in their order."""

    name: str
    description: str
    base: str
    points: tuple


def canonical(value):
    """One text for one value, whatever the order of its keys."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)


def point_id(point):
    return hashlib.sha256(canonical(point).encode()).hexdigest()[:12]


def structure(point):
    """What the point builds, without the values that a register carries."""
    kept = {key: value for key, value in point["set"].items() if key not in CARRIED}
    return canonical({"base": point["base"], "set": kept})


def flattened(table, prefix=""):
    """{"a.b": value} of nested tables."""
    found = {}
    for key, value in table.items():
        if isinstance(value, dict):
            found |= flattened(value, f"{prefix}{key}.")
        else:
            found[prefix + key] = value
    return found


def design_path(root, base):
    return Path(root) / f"rtl/designs/{base}.toml"


class Reader:
    """Reads one space file; every complaint names the line."""

    def __init__(self, root, path):
        self.root, self.path = Path(root), Path(path)
        try:
            self.text = self.path.read_text(encoding="utf-8")
        except OSError as error:
            raise SpaceError(f"{path}: {error.strerror}; check the path") from None
        try:
            self.table = tomllib.loads(self.text)
        except tomllib.TOMLDecodeError as error:
            line = re.search(r"at line (\d+)", str(error))
            where = line.group(1) if line else str(self.text.count("\n") + 1)
            what = re.sub(r" \(at .*\)", "", str(error))
            raise SpaceError(f"{path}:{where}: {what}; correct the TOML") from None

    def fail(self, word, what, mend, sweep=None):
        """`word` is looked for from the n-th [[sweep]] on."""
        lines = self.text.splitlines()
        starts = [i for i, line in enumerate(lines) if re.match(r"\s*\[\[\s*sweep\s*\]\]", line)]
        first = starts[sweep] if sweep is not None and sweep < len(starts) else 0
        last = word.rsplit(".", 1)[-1]
        places = [
            i for i in range(first, len(lines)) if re.search(rf"\b{re.escape(word)}\b", lines[i])
        ]
        places += [
            i
            for i in range(first, len(lines))
            if re.match(rf'\s*"?([\w.]+\.)?{last}"?\s*=', lines[i])
        ]
        line = (places[0] if places else first) + 1
        raise SpaceError(f"{self.path}:{line}: {what}; {mend}")

    def read(self):
        for key in self.table:
            if key not in ("description", "base", "sweep"):
                self.fail(key, f"unknown key {key}", "there are description, base and [[sweep]]")
        base = self.table.get("base")
        path = design_path(self.root, base)
        if not isinstance(base, str) or not path.is_file():
            names = ", ".join(sorted(p.stem for p in path.parent.glob("*.toml")))
            self.fail("base", f"base is {base!r}, no design", f"name one of {names}")
        design = flattened(tomllib.loads(path.read_text(encoding="utf-8")))
        sweeps = self.table.get("sweep")
        if not isinstance(sweeps, list) or not sweeps:
            self.fail("sweep", "no [[sweep]]", "add one with a table [sweep.axes]")
        found = {}
        for number, sweep in enumerate(sweeps):
            for point in self.sweep_points(base, design, number, sweep):
                found.setdefault(canonical(point), point)
                if len(found) > MAX_POINTS:
                    self.fail("sweep", f"over {MAX_POINTS} points", "shorten an axis", number)
        points = sorted(found.values(), key=lambda p: (structure(p), canonical(p)))
        return Space(self.path.stem, self.table.get("description", ""), base, tuple(points))

    def sweep_points(self, base, design, number, sweep):
        for key in sweep:
            if key not in ("name", "set", "axes"):
                self.fail(key, f"unknown key {key} in a sweep", "there are name, set, axes", number)
        fixed = flattened(sweep.get("set", {}))
        axes = flattened(sweep.get("axes", {}))
        for key in [*fixed, *axes]:
            self.check_key(design, key, number)
        for key, values in axes.items():
            if key in fixed:
                self.fail(key, f"{key} is in both set and axes", "keep one", number)
            if not isinstance(values, list) or not values:
                self.fail(key, f"axis {key} is no list of values", f"write {key} = [...]", number)
        for chosen in itertools.product(*axes.values()):
            changes = fixed | dict(zip(axes, chosen, strict=True))
            yield self.point(base, design, changes, number)

    def check_key(self, design, key, number):
        if key in GONE:
            self.fail(key, f"no design has {key} any more: {GONE[key]}", "leave it out", number)
        if key not in design and key not in OPTIONAL:
            near = difflib.get_close_matches(key, [*design, *OPTIONAL], 1)
            mend = f"did you mean {near[0]}" if near else "docs/designs.md lists the keys"
            self.fail(key, f"a design has no key {key}", mend, number)

    def point(self, base, design, changes, number):
        kept = {}
        for key, value in changes.items():
            there = design.get(key, OPTIONAL.get(key))
            if isinstance(there, float) and type(value) is int:
                value = float(value)
            if there is not None and type(value) is not type(there):
                wanted = type(there).__name__
                self.fail(key, f"{key} = {value!r}, wanted {wanted}", "correct the value", number)
            if value != there:
                kept[key] = value
        return {"base": base, "set": dict(sorted(kept.items()))}


def read_space(root, path):
    """The Space of a file. Raises SpaceError."""
    return Reader(root, path).read()
