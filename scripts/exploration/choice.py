# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Alternatives of `feltgate choose`: which designs of the explored table a scene can run on, what
each costs as sums with their parts, which meet the wishes, and why the others do not.

All figures come from the program's JSON and the committed tables; this adds and compares.
Documentation: docs/speed-for-accuracy.md
"""

import json
import math
from dataclasses import dataclass

from exploration.front import beats

CUTOFF, OBSERVER, INCLUDE = "velocity.cutoff_rad_s", "observer.cutoff_rad_s", "scenes.include"
TICK = "clock.tick_hz"
LOOP = (TICK, "velocity.m1", "velocity.n", "velocity.gain", CUTOFF)
BEFORE, AFTER = "front", "bound_holds"  # the columns of the table between these are the design's
NOT_ASKED = "left out, see below"
MORE = 5  # alternatives that are shown
ALIKE = 0.02  # of the logarithms: what misses the wishes by next to the same is alike


@dataclass(frozen=True)
class Chip:
    """What a chip has, by its maker's data sheet."""

    name: str
    cells: int
    multipliers: int
    multipliers_each: int  # for a product of 18 x 18 bits
    memories: int
    memories_each: int  # for a block RAM of 18 kbit
    cyclone: bool = False  # counted in Cyclone IV E cells, not in LUT4 equivalents of the ECP5


CHIPS = {
    "ecp5-25": Chip("Lattice LFE5U-25F", 24288, 28, 1, 56, 1),
    "up5k": Chip("Lattice iCE40UP5K", 5280, 8, 4, 30, 5),
    "gw1nr-9": Chip("Gowin GW1NR-9", 8640, 20, 1, 26, 1),
    "ep4ce22": Chip("Intel EP4CE22", 22320, 66, 1, 66, 2, cyclone=True),
}


def settings(row):
    """{"section.key": text}: what a row of the table changes in `lever`."""
    keys = list(row)
    between = keys[keys.index(BEFORE) + 1 : keys.index(AFTER)]
    return {key: row[key] for key in between if row[key]}


def word(cutoff_rad_s, tick_hz):
    """Coefficient of a low-pass, as registers.toml has it."""
    return -math.expm1(-cutoff_rad_s / tick_hz)


def value_of(text):
    """A value of the table as a design file has it."""
    try:
        return json.loads(text)
    except ValueError:
        return text


@dataclass(frozen=True)
class Row:
    """A design of the table: what it changes in `lever`. Its observer, which only displays, stays."""

    figures: dict
    change: dict
    base: dict

    def get(self, key):
        section, name = key.split(".")
        return self.change.get(key, self.base.get(section, {}).get(name))

    def loop(self):
        """What decides the velocity estimate and the linear loop."""
        return {key: self.change[key] for key in LOOP if key in self.change}

    def in_registers(self):
        """Whether the built programs of `lever` run it, by a value in a register."""
        tick_hz, own = self.base["clock"]["tick_hz"], self.base["velocity"]["cutoff_rad_s"]
        octave = [math.frexp(word(cutoff, tick_hz))[1] for cutoff in (self.get(CUTOFF), own)]
        return not set(self.change) - {CUTOFF} and octave[0] == octave[1]


def designs(rows, base, scene):
    """([Row], {why the others are left out: how many}) of the table's rows for a scene of the core,
    or None: a law. `base` is the parsed design file of `lever`."""
    kept, left, seen = [], {}, set()
    for row in rows:
        change = {key: value_of(text) for key, text in settings(row).items()}
        observer = change.pop(OBSERVER, None)
        own = Row(row, {}, base)
        change = {key: value for key, value in change.items() if value != own.get(key)}
        included = change.get(INCLUDE)
        why = ""
        if row["status"] != "ok" or row["mismatches"] != "0":
            why = "not measured"
        elif row["coarse"] == "True":
            why = "too coarse for use"
        elif row["stable"] != "True":
            why = "unstable around p24"
        elif included is not None and scene not in included:
            why = "without this scene" if scene else "other scenes: a law needs the set-point alone"
        elif json.dumps(change) in seen:
            why = "the same as another" if observer is None else "another cut-off of the observer alone"
        else:
            seen.add(json.dumps(change))
            kept.append(Row(row, change, base))
        if why:
            left[why] = left.get(why, 0) + 1
    return kept, left


def total(parts, key):
    return sum(part[key] for part in parts)


def error_of(parts, largest_nm):
    """Sum of the error's parts: the rms of a sum is at most the sum of the rms."""
    rms, worst = total(parts, "rms_nm"), total(parts, "worst_nm")
    return {
        "parts": parts,
        "rms_nm": rms,
        "worst_nm": worst,
        "share": rms / largest_nm if largest_nm > 0 else math.inf,
    }


def error_parts(counts, rate, rounding, plant, rounded_by="run: measured and proven worst"):
    """Of one rate: counts alone, what the rate adds to it, the rounding behind the law, and the plant
    that is left out; (rms, worst) each, None where no command says."""
    named = (
        ("encoder and velocity estimate", counts, "rates: counts alone"),
        ("rate and bits of the law", rate, "rates: this rate, less the counts"),
        ("rounding behind the law", rounding, rounded_by),
        ("plant effects left out", plant, "trim: own and unseen motions"),
        ("simulation engine twin", (0.0, 0.0), "the RTL's bits, verified below"),
    )
    told = []
    for part, value, source in named:
        rms, worst = value or (0.0, 0.0)
        source = source if value else NOT_ASKED
        told.append({"part": part, "rms_nm": rms, "worst_nm": worst, "from": source})
    return told


def added(row, counts):
    """(rms, worst) of what a rate adds to the counts alone."""
    return [max(0.0, row[f"error_{key}_nm"] - of) for key, of in zip(("rms", "max"), counts, strict=True)]


def plant_part(trim, largest_nm):
    """(rms, worst) of what the left-out effects change in the torque, over all motions tried."""
    motions = [trim["own_motion"], *(m["difference"] for m in trim["unseen"])]
    worst = {key: max(m["torque"][key] for m in motions) for key in ("rms", "peak")}
    return worst["rms"] * largest_nm, worst["peak"] * largest_nm


def summed(parts, key):
    return {"parts": parts, key: total(parts, key)}


def margin_of(at_fastest, at_rate, of_design):
    """From the fastest rate on `lever` to this rate and this design; None where one is not known."""
    steps = (at_fastest, at_rate, of_design)
    if None in steps:
        return None
    names = ("lever at the fastest rate", "this rate", "this design")
    values = (steps[0], steps[1] - steps[0], steps[2] - steps[1])
    return summed([{"part": p, "margin": v} for p, v in zip(names, values, strict=True)], "margin")


def latency_of(row, delays):
    """Mean time from a motion to the torque that answers it; `delays` are those of the design."""
    run_s = row.get("clocks_used", 0) / delays["clock_hz"] if row["by"] == "engine" else 0.0
    named = [("hold: half a period of the law", 0.5 / row["rate_hz"]), ("run of the engine", run_s)]
    named += [(name, value) for name, value in delays["parts"].items()]
    return summed([{"part": part, "ms": 1e3 * seconds} for part, seconds in named], "ms")


def gates_of(core, engine):
    """Of the core and, where the law needs it, the engine."""
    keys = ("lut4_equivalents", "mult18", "bram")
    parts = [{"part": what} | {k: int(of[k]) for k in keys} for what, of in filter(None, (core, engine))]
    return {"parts": parts} | {key: total(parts, key) for key in keys}


def fit(chip, gates, cyclone_cells_per_lut4):
    """[(what, needed, there is)] of a chip."""
    cells = gates["lut4_equivalents"] * (cyclone_cells_per_lut4 if chip.cyclone else 1)
    return [
        ("cells", math.ceil(cells), chip.cells),
        ("multipliers", gates["mult18"] * chip.multipliers_each, chip.multipliers),
        ("block memories", gates["bram"] * chip.memories_each, chip.memories),
    ]


def broken(one, wishes):
    """[{wish, asked, is, by}] that an alternative does not meet, the largest part named."""

    def largest(of, key):
        part = max(of["parts"], key=lambda p: p[key])
        return part["part"]

    found = []

    def add(wish, asked, value, by, excess):
        found.append({"wish": wish, "asked": asked, "is": value, "by": by, "excess": excess})

    error, margin, latency = one["error"], one["margin"], one["latency"]
    if not error["share"] <= wishes["torque_error"]:
        asked, is_now = wishes["torque_error"], error["share"]
        add("torque_error", asked, is_now, largest(error, "rms_nm"), is_now / asked)
    if margin is not None and not margin["margin"] >= wishes["margin"]:
        asked, is_now = wishes["margin"], margin["margin"]
        add("margin", asked, is_now, one["margin_by"], asked / max(is_now, 1e-9))
    if margin is None and "margin" in wishes["stated"]:
        add("margin", wishes["margin"], None, one["margin_by"], 10.0)
    if wishes["latency"] is not None and not latency["ms"] <= wishes["latency"]:
        asked, is_now = wishes["latency"], latency["ms"]
        add("latency", asked, is_now, largest(latency, "ms"), is_now / asked)
    short = [row for row in one["chips"].get(wishes["chip"], []) if row[1] > row[2]]
    if short:
        most = max(short, key=lambda row: row[1] / row[2])
        lacks = ", ".join(f"{needed} of {there} {what}" for what, needed, there in short)
        add("chip", wishes["chip"], lacks, most[0], most[1] / most[2])
    if one["broken"]:
        add("the scene's expectations", None, "; ".join(one["broken"]), "the bits", 10.0)
    return found


def distance(one, wishes, stated_only=False):
    """How far from the wishes: 0 where all are met."""
    return sum(
        math.log(max(1.0, b["excess"])) + 1e-9
        for b in broken(one, wishes)
        if not stated_only or b["wish"] in wishes["stated"]
    )


def alike(lut4_equivalents):
    """The tools' own choices change an area by tens: what differs by less is the same."""
    return round(lut4_equivalents / 50)


def measures(one):
    """Less is better. A slower law leaves clocks of the engine to others."""
    margin = one["margin"]["margin"] if one["margin"] else 0.0
    gates = alike(one["gates"]["lut4_equivalents"])
    return one["error"]["share"], -margin, one["latency"]["ms"], gates, one["rate_hz"]


def order(objective):
    """What the choice is by: the objective first, then gates, the slowest law, and the error. Without
    an objective a design of the built programs goes first: it needs no program of its own."""
    keys = {"fastest": lambda o: o["latency"]["ms"], "stiffest": lambda o: measures(o)[1]}
    keys |= {"smallest": lambda o: alike(o["gates"]["lut4_equivalents"])}

    def sorted_by(one):
        first = keys[objective](one) if objective else not one["built"]
        gates = alike(one["gates"]["lut4_equivalents"])
        return first, gates, not one["built"], one["rate_hz"], one["error"]["share"], one["cutoff_rad_s"]

    return sorted_by


def choose(all_of, wishes):
    """(the choice, the front with it first): of those that meet the wishes, or the nearest to them.
    An objective takes the place of what nobody asked for."""
    stated_only = wishes["objective"] is not None
    near = {id(o): distance(o, wishes, stated_only) for o in all_of}
    least = min(near.values())
    able = [o for o in all_of if near[id(o)] <= (least + ALIKE if least else 0.0)]
    best = min(able, key=order(wishes["objective"]))
    front = [o for o in all_of if not any(beats(measures(p), measures(o)) for p in all_of)]
    others = sorted((o for o in front if o is not best), key=lambda o: (near[id(o)], order(None)(o)))
    ends = [min(front, key=order(name)) for name in ("fastest", "smallest", "stiffest")]
    ends.append(min(front, key=lambda o: o["error"]["share"]))
    picked = [best]
    for one in [*ends, *others]:
        if len(picked) < MORE and not any(one is p for p in picked):
            picked.append(one)
    return best, picked


def why_not(all_of, best, wishes):
    """For each wish that the choice does not meet: what the best of all reaches, and by what it is
    held; `alone`: another alternative meets it, but not the other wishes."""
    found = []
    for b in broken(best, wishes):
        others = [next((x for x in broken(o, wishes) if x["wish"] == b["wish"]), None) for o in all_of]
        nearest = b if None in others else min(others, key=lambda x: x["excess"])
        told = {key: value for key, value in b.items() if key != "excess"}
        told |= {"stated": b["wish"] in wishes["stated"], "alone": None in others}
        if b["wish"] == "chip":
            told["fits"] = [n for n, rows in best["chips"].items() if all(r[1] <= r[2] for r in rows)]
        found.append(told | {"best": nearest["is"], "best_by": nearest["by"]})
    return found
