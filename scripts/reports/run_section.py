# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The words and tables of a page about one run. Documentation: docs/figures.md"""

from reports import page

ENGINES = ("rtl", "twin", "float", "double", "quad")
ENGINE_NAMES = {"rtl": "RTL"}


def closed_loop(summary):
    return "scene" in summary


def subject(summary):
    return summary.get("scene") or summary.get("trace") or "run"


def joule(value):
    return f"{page.number(1e3 * value)} mJ"


def acted(found, what):
    """["limit torque: acted for 0.3 s, first at 1.1 s", ...]"""
    return [
        f"{what} {name.replace('_', ' ')}: acted for {page.number(a['seconds'])} s, first at "
        f"{page.number(a['first_s'])} s"
        for name, a in found.items()
    ]


def felt_lines(summary):
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


def expectations_table(summary):
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


def facts(summary):
    """What ran, as a list of lines."""
    kind = "scene" if closed_loop(summary) else "recording"
    lines = [f"{kind} {subject(summary)} on design {summary['design']}"]
    if "plant" in summary:
        lines[0] += f", plant {summary['plant']}"
    if summary.get("probes"):
        probes = summary["probes"]
        lines.append(f"probes: {probes if isinstance(probes, str) else ', '.join(probes)}")
    lines.append(
        f"{page.number(summary['simulated_s'])} s of device time: {summary['clocks']:,} clocks, "
        f"{summary['ticks']:,} ticks"
    )
    p = summary["position"]
    lines.append(
        f"encoder: {p['steps']:,} steps, {p['illegal']:,} illegal, {p['reversals']:,} reversals"
    )
    return lines + felt_lines(summary)


def error_cells(engine):
    """Largest and rms error of each signal, in micro-units."""
    errors = [engine.get(key, {}) for key in ("velocity_rad_s", "tau_hat_nm", "torque_nm")]
    return [
        page.number(1e6 * found[kind] if kind in found else None)
        for found in errors
        for kind in ("max_error", "rms_error")
    ]


def engine_table(summary):
    head = [
        "engine",
        "velocity, largest error, µrad/s",
        "rms error",
        "observed torque, largest error, µNm",
        "rms error",
        "commanded torque, largest error, µNm",
        "rms error",
        "saturated ticks",
        "speed, s/s",
    ]
    rows = []
    for name in ENGINES:
        engine = summary["engines"].get(name)
        if engine is None:
            continue
        rows.append(
            [ENGINE_NAMES.get(name, name)]
            + error_cells(engine)
            + [f"{engine['saturations']:,}" if "saturations" in engine else "–"]
            + [page.number(engine.get("speed"))]
        )
    return page.table(head, rows)


def steps_of(summary):
    """Step responses of the back-end that drove the motor."""
    for name in ENGINES:
        steps = summary["engines"].get(name, {}).get("step_responses")
        if steps:
            return steps
    return []


STEP_KEYS = (
    ("step to, Nm", "tau_ref_nm"),
    ("motor settles, ms", "torque_settling_ms"),
    ("observer settles, ms", "tau_hat_settling_ms"),
    ("overshoot, %", "overshoot_pct"),
    ("final error, %", "final_error_pct"),
    ("observer's final error, %", "tau_hat_final_error_pct"),
)


def step_table(summary):
    rows = [[page.number(step.get(key)) for _, key in STEP_KEYS] for step in steps_of(summary)]
    return page.table([title for title, _ in STEP_KEYS], rows)


def faults_of(summary):
    """Everything that makes a run wrong, one line each."""
    count = summary.get("mismatches", 0)
    texts = [f"{count:,} mismatches"] if count else []
    if "first_mismatch" in summary:
        texts[-1:] = [f"{count:,} mismatches, the first: {summary['first_mismatch']}"]
    texts += summary.get("expectations", {}).get("broken", [])
    texts += broken_bounds(summary)
    return [f"{subject(summary)}, {summary['design']}: {text}" for text in texts]


def inside(summary, drawn):
    """The section's body: facts and pictures, the tables folded."""
    parts = [page.bullets(facts(summary)), page.pictures(drawn)]
    parts.append(page.fold("Torque steps", step_table(summary)))
    parts.append(page.fold("What the scene expects", expectations_table(summary)))
    parts.append(page.fold("Errors and speed of each back-end", engine_table(summary)))
    return "\n".join(parts)


def axes_facts(summary):
    """What was held in a run of several axes, as a list of lines."""
    worst = max(summary["axes"], key=lambda a: a["law_nm"]["max_error"])["law_nm"]
    bound = worst.get("bound")
    proven = f", proven bound {page.number(1e6 * bound)}" if bound else ""
    return [
        f"{summary['clocks']:,} clocks of {len(summary['axes'])} axes, {summary['mismatches']:,} mismatches",
        f"the engine's torque is off by at most {page.number(1e6 * worst['max_error'])} µNm{proven}",
        f"{summary['expectations']['checked']} expectations",
    ]
