# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the hand felt in a run, as lines and a table, from the `felt` of its JSON.

Documentation: docs/json.md, docs/figures.md
"""

from reports import page


def joule(value):
    return f"{page.number(1e3 * value)} mJ"


def acted(found, what):
    """["limit torque: acted for 0.3 s, first at 1.1 s", ...]"""
    return [
        f"{what} {name.replace('_', ' ')}: acted for {page.number(a['seconds'])} s, first at "
        f"{page.number(a['first_s'])} s"
        for name, a in found.items()
    ]


def lines(summary):
    """Torque, energy, limits and faults; nothing of a run that does not tell."""
    felt = summary.get("felt", {})
    torque, energy = felt.get("torque", {}), felt.get("energy")
    told = []
    if "motor" in torque:
        asked, motor = torque["asked"], torque["motor"]
        off = torque["motor_less_asked_nm"]
        told.append(
            f"felt: at most {page.number(motor['peak_nm'])} Nm from the motor, where the scene "
            f"asked for {page.number(asked['peak_nm'])} Nm; off by "
            f"{page.number(1e3 * off['rms_error'])} mNm rms, at most "
            f"{page.number(1e3 * off['max_error'])} mNm"
        )
    if energy:
        told.append(
            f"energy: the hand gave {joule(energy['taken_from_hand_j'])} and got "
            f"{joule(energy['given_to_hand_j'])} back"
        )
    outside = felt.get("errors", {}).get("torque_nm", {})
    if outside.get("ticks_outside"):
        told.append(
            f"no bound holds in {outside['ticks_outside']:,} ticks of a ramp or saturation and after it: the "
            f"commanded torque was off by up to {page.number(1e6 * outside['max_error_outside'])} µNm there; no "
            "other error has these ticks in it"
        )
    told += acted(felt.get("limits", {}), "limit")
    told += acted(felt.get("faults", {}), "fault")
    return told + summary.get("speed_jumps", [])


def allowed(expectation):
    low, high = expectation.get("low"), expectation.get("high")
    if low is None:
        return f"at most {high:g}"
    return f"at least {low:g}" if high is None else f"{low:g} to {high:g}"


def table(summary):
    """What the scene's file expects, and what came out."""
    rows = [
        [
            e["figure"],
            f"{e['value']:.6g}",
            allowed(e),
            page.mark(e["kept"], "yes" if e["kept"] else "no"),
        ]
        for e in summary.get("felt", {}).get("expectations", [])
    ]
    return page.table(["figure", "came out", "expected", "kept"], rows)


def broken_bounds(summary):
    """One line for each error above its bound, of runs that do not list it as an expectation."""
    if "expectations" in summary:
        return []
    return [
        f"{signal} is off by {e['max_error']:.3g}, above its proven bound "
        f"{e['bound']:.3g}"
        for signal, e in summary.get("felt", {}).get("errors", {}).items()
        if not e["holds"]
    ]
