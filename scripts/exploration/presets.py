# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Three points of the front that get a name, as design files.

fast has the shortest delay, and exact the smallest error. balanced lies between them: its distance
from the best of every objective, each on a logarithmic scale from 0 to 1, is the smallest.
Documentation: docs/speed-for-accuracy.md
"""

import math
import re

import outputs
from exploration import design_text, front

NAMES = ("fast", "balanced", "exact")


def candidates(rows):
    """The front among designs for use: stable, and with all scenes of the base."""

    def usable(row):
        result = row["result"]
        good = not result.get("coarse") and result.get("stable", True)
        return good and front.SCENES not in row["set"]

    return front.find([row for row in rows if usable(row)])


def distance(row, rows):
    total = 0.0
    for key, *_ in front.OBJECTIVES:
        values = [math.log(max(1e-12, other["result"][key])) for other in rows]
        if max(values) > min(values):
            value = math.log(max(1e-12, row["result"][key]))
            total += ((value - min(values)) / (max(values) - min(values))) ** 2
    return total


def choose(rows):
    """{name: row} among the candidates."""
    rows = candidates(rows)
    if not rows:
        return {}

    def least(key):
        order = [key, *(k for k, *_ in front.OBJECTIVES)]
        return min(rows, key=lambda row: [row["result"][k] for k in order])

    fast, exact = least("delay_s"), least("torque_error_rms_nm")
    rest = [row for row in rows if row["id"] not in (fast["id"], exact["id"])] or rows
    balanced = min(rest, key=lambda row: (distance(row, rows), row["id"]))
    return {"fast": fast, "balanced": balanced, "exact": exact}


def sentence(name, chosen):
    """What a preset is best at, and what it gives up for that."""
    me = chosen[name]["result"]
    fast, exact = chosen["fast"]["result"], chosen["exact"]["result"]
    figures = (
        f"{1e3 * me['delay_s']:.2f} ms of delay, {1e6 * me['torque_error_rms_nm']:.1f} uNm rms "
        f"torque error, {me['lut4_equivalents']} LUT4, {me['mult18']} MULT18"
    )
    later_ms = 1e3 * (me["delay_s"] - fast["delay_s"])
    worse_unm = 1e6 * (me["torque_error_rms_nm"] - exact["torque_error_rms_nm"])
    more_lut4 = me["lut4_equivalents"] - fast["lut4_equivalents"]
    more_mult18 = me["mult18"] - fast["mult18"]
    gives_up = {
        "fast": f"{worse_unm:.1f} uNm against exact and a quiet velocity: one encoder count "
        f"moves it by {me['count_ripple_rad_s']:.2f} rad/s, in exact by "
        f"{exact['count_ripple_rad_s']:.2f}",
        "balanced": f"{later_ms:.2f} ms against fast and {worse_unm:.1f} uNm against exact",
        "exact": f"{later_ms:.2f} ms, {more_lut4} LUT4 and {more_mult18} MULT18 against fast",
    }[name]
    return f"{figures}; gives up {gives_up}"


def preset_text(root, name, chosen, plan):
    """The design file: the base's text, under a head of its own."""
    text = design_text.design_text(root, chosen[name])
    text = re.sub(r"\A(#.*\n)*", "", text)
    told = sentence(name, chosen)
    text = re.sub(
        r"^description = .*$", lambda _: f'description = "{told}"', text, count=1, flags=re.M
    )
    where = f"vectors/spaces/{plan.name}.toml"
    head = f"# Preset {name}: a point of the front of {where}; docs/speed-for-accuracy.md.\n"
    return head + text


def write(plan, rows, root):
    """Writes the three files; their paths."""
    chosen = choose(rows)
    paths = []
    for name in chosen:
        path = plan.folder / f"{name}.toml"
        outputs.write_whole(path, preset_text(root, name, chosen, plan))
        paths.append(path)
    return paths
