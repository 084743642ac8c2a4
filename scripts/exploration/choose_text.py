# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The answer of `feltgate choose` for people: the text of its JSON. It computes nothing.

Documentation: docs/speed-for-accuracy.md
"""


def rate(hz):
    for unit, factor in (("MHz", 1e6), ("kHz", 1e3)):
        if hz >= factor:
            return f"{hz / factor:.4g} {unit}"
    return f"{hz:.4g} Hz"


def in_words(one):
    """Design and rate of an alternative."""
    by = "the core's block" if one["by"] == "block" else "the law on the engine"
    return f"design {one['design']}, {by} at {rate(one['rate_hz'])}"


def changes(one):
    """What a design of the table changes in `lever`."""
    return ", ".join(f"{key} {value}" for key, value in one["set"].items()).replace('"', "")


def of_wish(wish, value):
    """A value in the unit of its wish."""
    if value is None:
        return "not known"
    if wish == "torque_error":
        return f"{100 * value:.3g} %"
    return f"{value:.3g} ms" if wish == "latency" else f"{value:.3g}" if wish == "margin" else str(value)


def simulation(told):
    sim = told["simulation"]
    speed = 1 / sim["cpu_s_per_s"] if sim["cpu_s_per_s"] else 0.0
    lines = [
        f"simulation  engine twin: the RTL's bits, {speed:.3g} times real time here; in the core alone "
        f"{sim['core_times_faster_than_rtl']:.0f} times as fast as the RTL",
        f"            ({sim['bench']}); double would be {sim['double_times_faster_in_the_core']:.2g} times "
        f"as fast in the core and lose the rounding, {1e3 * sim['double_loses_nm']:.2g} mNm there",
    ]
    if sim["effects_off"] is None:
        lines.append("plant       every effect of the scene stays on")
    else:
        faster = sim["faster"]
        off = ", ".join(sim["effects_off"]) or "nothing"
        step = f"steps of {sim['step_clocks']} clocks; {faster['median']:.3g} times the full "
        step += "model's speed "
        step += f"({faster['least']:.3g} to {faster['most']:.3g} in {faster['runs']} runs)"
        lines.append(f"plant       left out: {off}; {step}")
    return lines


def sums(one, largest_nm):
    """The three sums of an alternative with their parts."""
    error = one["error"]
    lines = ["", f"{'torque error, mNm':<38}{'rms':>9}{'worst':>9}   from"]
    for p in error["parts"]:
        lines.append(f"  {p['part']:<36}{1e3 * p['rms_nm']:9.4g}{1e3 * p['worst_nm']:9.4g}   {p['from']}")
    lines.append(
        f"  {'sum':<36}{1e3 * error['rms_nm']:9.4g}{1e3 * error['worst_nm']:9.4g}   "
        f"rms: {100 * error['share']:.3g} % of the law's largest, {largest_nm:.3g} Nm"
    )
    lines += ["", "margin: largest stable stiffness over the law's"]
    if one["margin"] is None:
        lines.append(f"  {one['margin_by']}")
    else:
        lines += [f"  {p['part']:<36}{p['margin']:9.4g}" for p in one["margin"]["parts"]]
        lines.append(f"  {'sum':<36}{one['margin']['margin']:9.4g}")
    lines += ["", "latency, ms"]
    lines += [f"  {p['part']:<36}{p['ms']:9.4g}" for p in one["latency"]["parts"]]
    lines.append(f"  {'sum':<36}{one['latency']['ms']:9.4g}")
    lines += ["", f"{'gates':<38}{'LUT4 eq':>9}{'MULT18':>9}{'BRAM':>9}"]
    keys = ("lut4_equivalents", "mult18", "bram")
    for p in [*one["gates"]["parts"], one["gates"] | {"part": "sum"}]:
        lines.append(f"  {p['part']:<36}" + "".join(f"{p[key]:9}" for key in keys))
    return lines


def chips(told):
    lines = ["", "chips, counted and not placed (the clock of 50 MHz is measured on the ECP5 alone)"]
    for name, rows in told["choice"]["chips"].items():
        short = [f"{needed} of {there} {what}" for what, needed, there in rows if needed > there]
        used = ", ".join(f"{needed} of {there} {what}" for what, needed, there in rows)
        lines.append(f"  {name:<9}{'does not fit: ' + ', '.join(short) if short else 'fits: ' + used}")
    return lines


def front(told):
    lines = ["", f"front: {len(told['front'])} of {told['measured']} measured"]
    lines.append(f"  {'':<54}{'error':>8}{'margin':>9}{'latency':>10}{'LUT4 eq':>9}")
    for one in told["front"]:
        margin = f"{one['margin']['margin']:.3g}" if one["margin"] else "-"
        mark = "*" if one is told["front"][0] else " "
        lines.append(
            f"{mark} {in_words(one):<54}{100 * one['error']['share']:6.3g} %{margin:>9}"
            f"{one['latency']['ms']:7.3g} ms{one['gates']['lut4_equivalents']:9}"
        )
        if one["set"]:
            lines.append(f"    {changes(one)}")
    left = told["designs"]["left_out"]
    whole = told["designs"]["in_table"]
    lines.append(f"left out of the {whole} designs of the table: {sum(left.values())}")
    lines += [f"  {count:4} {why}" for why, count in left.items()]
    return lines


def why_not(told):
    lines = []
    for w in told["why_not"]:
        kind = "wish" if w["stated"] else "aim, not asked for"
        asked = "" if w["asked"] is None else f" {of_wish(w['wish'], w['asked'])}"
        name, value = w["wish"].replace("_", " "), of_wish(w["wish"], w["is"])
        lines.append(f"NOT MET  {name}{asked} ({kind}): {value}, by {w['by']}")
        if w["alone"]:
            lines.append("         another alternative meets it, but not the other wishes")
        elif w["wish"] == "chip":
            lines.append(f"         it fits: {', '.join(w['fits']) or 'none of these chips'}")
        elif w["wish"] != "the scene's expectations":
            best = of_wish(w["wish"], w["best"])
            lines.append(f"         the best of all measured: {best}, by {w['best_by']}")
    if lines:
        lines.append("         the choice above is the nearest to all wishes")
    return ["", *lines] if lines else []


def verified(told):
    v = told["verified"]
    ran = f"{v['clocks']} clocks of lock-step, {v['rtl_s']:g} s of the scene"
    lines = ["", f"verified in RTL and twin: {ran}"]
    for c in v["checks"]:
        limit = "not known" if c["limit"] is None else f"{c['limit']:.4g}"
        mark = "ok" if c["holds"] else "NOT KEPT"
        lines.append(f"  {c['what']:<38}{c['measured']:>11.4g}  said {limit:<10} {mark}")
    return lines


def text(told):
    asked, one = told["asked"], told["choice"]
    where = f"plant {asked.get('plant')}"
    if "device" in asked:
        where = f"device {asked['device']}, {asked['axes']} axes"
    stiff, damping = asked["stiffness_nm_rad"], asked["damping_nm_s_rad"]
    slope = f"at its steepest {stiff:.4g} Nm/rad with {damping:.4g} Nm s/rad"
    lines = [f"{told['scene']}: {told['title']}"]
    lines.append(f"law {told['law']}, to {asked['largest_nm']:.3g} Nm; {slope}; {where}")
    if told["made_motion"]:
        lines.append("a law has no motion: a hand sweeps 0.8 rad to both sides; give a scene for yours")
    lines += ["", f"CHOICE      {in_words(one)}"]
    if one["set"]:
        lines.append(f"            lever with {changes(one)}")
    if one["by"] == "engine":
        lines.append(f"            a run takes {one['clocks'][0]} of {one['clocks'][1]} clocks of the engine")
    lines += [*simulation(told), *sums(one, asked["largest_nm"])]
    lines += [*chips(told), *front(told), *why_not(told)]
    if told["slowest_for_a_host"]:
        slowest = rate(told["slowest_for_a_host"])
        lines += ["", f"a host may compute the same force from {slowest} on, within these aims"]
    lines += verified(told)
    for left in told["left_out"]:
        lines.append(f"left out: {left['part']}: {left['why']}")
    lines += ["", "files:", *(f"  {path}" for path in told["files"])]
    return "\n".join([*lines, "go on with:", *(f"  {command}" for command in told["commands"])])
