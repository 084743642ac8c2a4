# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The three numbers at the top of a page, each with its bound. All come from the runs' JSON and
the files that set the bounds. Documentation: docs/figures.md, docs/json.md
"""

from dataclasses import dataclass
from html import escape

from reports import page
from reports.runs import design

FIXED = ("rtl", "twin")  # the engines in fixed point, whose errors have proven bounds
ARITHMETIC = {"quad": "113-bit arithmetic", "double": "binary64 arithmetic"}


@dataclass(frozen=True)
class Headline:
    """`value` with unit, what it is, its bound in words."""

    value: str
    what: str
    bound: str
    good: bool | None = None  # None: nothing was held against a bound


def where(summary):
    return f"{summary.get('scene') or summary.get('trace') or 'run'}, {summary.get('design', '?')}"


def compared(clocks, mismatches):
    """The first number: clocks and mismatches; None mismatches where only one back-end ran."""
    if mismatches is None:
        return Headline(f"{clocks:,}", "clocks computed", "RTL and twin were not compared: --engine all")
    what = f"mismatches between RTL and twin, every output compared in each of {clocks:,} clocks"
    return Headline(f"{mismatches:,}", what, "allowed: 0", mismatches == 0)


def torque_error(summary):
    """(largest error of the commanded torque, its bound or None, where, against what) of a run; None where nothing
    was compared with the reference."""
    for name in FIXED:
        if found := summary.get("engines", {}).get(name, {}).get("torque_nm"):
            against = ARITHMETIC.get(summary.get("reference", "quad"), "another engine")
            return found["max_error"], found.get("bound"), where(summary), against
    return None


def error(summaries):
    """The second: the largest error of any run, or the one that breaks its bound."""
    errors = [e for e in map(torque_error, summaries) if e]
    if not errors:
        return Headline("–", "error of the commanded torque", "no engine ran beside the reference: --engine all")
    bounded = [e for e in errors if e[1]]
    nm, bound, place, against = max(bounded or errors, key=lambda e: (e[1] and e[0] > e[1] and e[0] / e[1] or 0, e[0]))
    what = f"largest error of the commanded torque against {against}"
    if not bound and against != ARITHMETIC["quad"]:
        return Headline(micro(nm), what, "its proven bound is against 113-bit arithmetic: --engine all")
    if not bound:
        return Headline(micro(nm), what, f"no bound is proven for {place}")
    return Headline(micro(nm), what, f"proven bound for this motion: {micro(bound)} ({place})", nm <= bound)


def micro(nm):
    """A torque of some last bits."""
    return f"{page.number(1e6 * nm)} µNm"


def settling(summary, steps):
    """The third, where there are torque steps: how long the slowest took, and what the scene's file allows."""
    slowest = max(step["torque_settling_ms"] for step in steps)
    expected = summary.get("felt", {}).get("expectations", [])
    limits = [e["high"] for e in expected if e["figure"].startswith("torque_settling_ms") and "high" in e]
    what = f"until the motor's torque has settled after a step ({where(summary)})"
    value = f"{page.number(slowest)} ms"
    if not limits:
        return Headline(value, what, "the scene sets no limit")
    return Headline(value, what, f"allowed by the scene: {page.number(max(limits))} ms", slowest <= max(limits))


def peak(summary):
    """The third, of another scene: the largest torque."""
    largest = abs(summary.get("felt", {}).get("torque", {}).get("asked", {}).get("peak_nm", 0.0))
    what, value = "largest torque that the scene asked for", f"{page.number(largest)} Nm"
    try:
        limit = float(design(summary["design"])["control"]["torque_limit_nm"])
    except (OSError, KeyError):
        return Headline(value, what, f"design {summary.get('design', '?')} is not at hand")
    # The limit itself is rounded to the format of a torque.
    return Headline(value, what, f"torque limit of the design: {limit:g} Nm", largest < 1.001 * limit)


def read(summary):
    """The third, of a recording: what was read."""
    p = summary.get("position", {})
    told = f"illegal steps: {p.get('illegal', 0):,}; reversals: {p.get('reversals', 0):,}"
    return Headline(f"{p.get('steps', 0):,}", "steps of the encoder read", told)


def of_run(summary, steps):
    """Three numbers of one run."""
    if steps:
        third = settling(summary, steps)
    else:
        third = peak(summary) if "scene" in summary else read(summary)
    return [compared(summary["clocks"], summary.get("mismatches")), error([summary]), third]


def html(headlines):
    return '<div class="headlines">' + "".join(map(tile, headlines)) + "</div>"


def tile(h):
    state = {True: " kept", False: " broken", None: ""}[h.good]
    return (
        f'<div class="headline{state}"><b>{escape(h.value)}</b><span>{escape(h.what)}</span>'
        f"<small>{escape(h.bound)}</small></div>"
    )
