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
    """`value` with unit, what it is, its bound in words; `share` of the bound, for the bar."""

    value: str
    what: str
    bound: str
    share: float | None = None
    good: bool | None = None  # None: nothing was held against a bound


@dataclass(frozen=True)
class Error:
    """Largest error of the commanded torque of a run where its bound holds."""

    nm: float
    bound_nm: float | None
    where: str
    against: str

    @property
    def share(self):
        return self.nm / self.bound_nm if self.bound_nm else 0.0


def where(summary):
    return f"{summary.get('scene') or summary.get('trace') or 'run'}, {summary.get('design', '?')}"


def torque_error(summary):
    """Error of a run, None where nothing was compared with the reference."""
    for name in FIXED:
        found = summary.get("engines", {}).get(name, {}).get("torque_nm")
        if found:
            against = ARITHMETIC.get(summary.get("reference", "quad"), "another engine")
            return Error(found["max_error"], found.get("bound"), where(summary), against)
    return None


def compared(clocks, mismatches):
    """The first number: clocks and mismatches; None mismatches where only one back-end ran."""
    if mismatches is None:
        return Headline(
            f"{clocks:,}", "clocks computed", "RTL and twin were not compared: --engine all"
        )
    return Headline(
        f"{mismatches:,}",
        f"mismatches between RTL and twin, every output compared in each of {clocks:,} clocks",
        "allowed: 0",
        None,
        mismatches == 0,
    )


def error(summaries):
    """The second: the largest error of any run, or the one that breaks its bound."""
    errors = [e for e in map(torque_error, summaries) if e]
    if not errors:
        return Headline(
            "–", "error of the commanded torque", "no engine ran beside the reference: --engine all"
        )
    bounded = [e for e in errors if e.bound_nm]
    worst = max(bounded or errors, key=lambda e: (e.share > 1 and e.share, e.nm))
    what = f"largest error of the commanded torque against {worst.against}"
    value = micro(worst.nm)
    if not worst.bound_nm and worst.against != ARITHMETIC["quad"]:
        return Headline(value, what, "its proven bound is against 113-bit arithmetic: --engine all")
    if not worst.bound_nm:
        return Headline(value, what, f"no bound is proven for {worst.where}")
    told = f"proven bound for this motion: {micro(worst.bound_nm)} ({worst.where})"
    return Headline(value, what, told, worst.share, worst.share <= 1)


def micro(nm):
    """A torque of some last bits."""
    return f"{page.number(1e6 * nm)} µNm"


def allowed_ms(summary):
    """The longest settling of a torque step that the run's scene file allows; None without one."""
    limits = [
        e["high"]
        for e in summary.get("felt", {}).get("expectations", [])
        if e["figure"].startswith("torque_settling_ms") and "high" in e
    ]
    return max(limits, default=None)


def settling(summary, steps):
    """The third, where there are torque steps: how long the slowest took."""
    slowest = max(step["torque_settling_ms"] for step in steps)
    allowed = allowed_ms(summary)
    what = f"until the motor's torque has settled after a step ({where(summary)})"
    value = f"{page.number(slowest)} ms"
    if allowed is None:
        return Headline(value, what, "the scene sets no limit")
    told = f"allowed by the scene: {page.number(allowed)} ms"
    return Headline(value, what, told, slowest / allowed, slowest <= allowed)


def torque_limit(summary):
    try:
        return float(design(summary["design"])["control"]["torque_limit_nm"])
    except (OSError, KeyError):
        return None


def peak(summary):
    """The third, of another scene: the largest torque."""
    largest = abs(summary.get("felt", {}).get("torque", {}).get("asked", {}).get("peak_nm", 0.0))
    limit = torque_limit(summary)
    what = "largest torque that the scene asked for"
    value = f"{page.number(largest)} Nm"
    if limit is None:
        return Headline(value, what, f"design {summary.get('design', '?')} is not at hand")
    share = largest / limit
    # The limit itself is rounded to the format of a torque.
    return Headline(value, what, f"torque limit of the design: {limit:g} Nm", share, share < 1.001)


def read(summary):
    """The third, of a recording: what was read."""
    p = summary.get("position", {})
    return Headline(
        f"{p.get('steps', 0):,}",
        "steps of the encoder read",
        f"illegal steps: {p.get('illegal', 0):,}; reversals: {p.get('reversals', 0):,}",
    )


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
    bar = ""
    if h.share is not None:
        filled = min(100.0, 100 * h.share)
        bar = f'<div class="bar"><i style="width:{filled:.1f}%"></i></div>'
    return (
        f'<div class="headline{state}"><b>{escape(h.value)}</b><span>{escape(h.what)}'
        f"</span>{bar}<small>{escape(h.bound)}</small></div>"
    )
