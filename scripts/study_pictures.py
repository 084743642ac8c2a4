#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws what a study wrote as JSON: study_pictures.py STUDY.json PICTURE; of stability a folder.

  feltgate controllers -o docs/images/controllers.svg        calls it
  feltgate stability --plot FOLDER                           calls it
  scripts/study_pictures.py docs/images/bench.json docs/images/bench.svg

It only draws. Documentation: docs/speed-for-accuracy.md
"""

import sys

from outputs import write_whole
from reports import plots

RATE_COLOURS = ["#7d4bb5", "#0072b2", "#008a64", "#b23a00", "#1d2329"]


def rate_text(hz):
    for unit, size in (("MHz", 1e6), ("kHz", 1e3)):
        if hz >= size:
            return f"{hz / size:g} {unit}"
    return f"{hz:g} Hz"


def k_b(study, png=False):
    """Stiffest stable wall against damping, a colour per scene rate."""
    figure, (axis,) = plots.stacked(f"Stiffest stable wall, {study['design']}", [3.2])
    rates = sorted({p["rate_hz"] for p in study["borders"]})
    for number, rate in enumerate(rates):
        colour = RATE_COLOURS[number % len(RATE_COLOURS)]
        points = [p for p in study["borders"] if p["rate_hz"] == rate and p["eigenvalues_nm_rad"]]
        damping = [p["damping_nm_s_rad"] for p in points]
        axis.plot(
            damping, [p["eigenvalues_nm_rad"] for p in points], color=colour, label=rate_text(rate)
        )
        axis.plot(damping, [p["closed_nm_rad"] for p in points], ":", color=colour, linewidth=0.9)
        bits = [(b, p["bits_nm_rad"]) for b, p in zip(damping, points, strict=True)]
        bits = [(b, k) for b, k in bits if k is not None]
        if bits:
            axis.plot(*zip(*bits, strict=True), "o", color=colour, markersize=4)
    rule = study["encoder_rule_nm_rad"]
    axis.axhline(rule, color="#8c96a0", linewidth=0.9, linestyle="--")
    axis.annotate(
        f"2f/q = {rule:.2f}",
        (0.99, rule),
        xycoords=("axes fraction", "data"),
        ha="right",
        va="bottom",
        fontsize=8,
        color="#5c6670",
    )
    axis.set_yscale("log")
    top = max((p["eigenvalues_nm_rad"] for p in study["borders"]), default=1)
    axis.set_ylim(top=4 * max(top, 1e-3))
    axis.set(xlabel="damping B of the wall, Nm s/rad", ylabel="stiffness K, Nm/rad")
    axis.legend(title="scene rate", loc="lower right", ncols=2)
    caption = (
        "Line: eigenvalues of the loop. Dot: bisection on the chain's own bits. Dotted: "
        "(b+B)/(T/2+td). Below a line the wall is stable; above the dashed line friction cannot "
        "hold the lever between two counts."
    )
    return plots.finish(figure, "stability_k_b", caption, png)


KIND_COLOURS = {
    "observer": "#0072b2",
    "feed-forward": "#008a64",
    "PI": "#b23a00",
    "PID": "#b04a8b",
    "reaction observer": "#7d4bb5",
}
DASHES = {"PI": (0, (4, 3)), "reaction observer": (0, (4, 3))}
STALL_MS = 10


def style(name):
    return {"color": KIND_COLOURS[name], "linestyle": DASHES.get(name, "-"), "linewidth": 1.2}


def controllers(data):
    title = "A disturbance observer beside what one would use instead"
    figure, (step, border, noise) = plots.stacked(title, [1.9, 1.7, 1.7], apart=2)
    for one in data["controllers"]:
        name = one["name"]
        values = [1e3 * v for v in one["stall_nm"]]
        times = [1e3 * data["stall_trace_s"] * i for i in range(len(values))]
        step.plot(times, values, label=name, **style(name))
        ratios = one["inertia_ratios"]
        x, y = [r["ratio"] for r in ratios], [r["border_nm_rad"] for r in ratios]
        border.plot(x, y, marker="o", markersize=4, **style(name))
        x, y = ([e[key] for e in one["encoders"]] for key in ("lines", "noise_nm"))
        noise.plot(x, [1e3 * v for v in y], marker="o", markersize=4, **style(name))
    step.set(xlim=(0, STALL_MS), xlabel="after the step, ms", ylabel="motor torque, mNm")
    step.legend(loc="lower right", ncols=2)
    for axis, ticks in ((border, (0.5, 1, 2, 4)), (noise, (500, 1024, 2500, 10000))):
        axis.set_xscale("log")
        axis.set_xticks(ticks, [f"{t:g}" for t in ticks])
        axis.minorticks_off()
    border.set(xlabel="nominal over true inertia", ylabel="largest wall, Nm/rad")
    noise.set(xlabel="lines of the encoder", ylabel="noise, mNm rms")
    noise.set_ylim(bottom=0)
    return plots.finish(figure, "controllers")


def bench(data):
    """A dot for each back-end; those without an error stand on the floor, 300 times below the least error."""
    title = "For the RTL's bits twin_event or twin_tick; without quantisation double"
    engines = [(name, e["simulated_s_per_s"], e.get("torque_error_nm", {}).get("max"), e["arithmetic"])
               for name, e in data["engines"].items()]
    floor = min((error for _, _, error, _ in engines if error), default=3e-16) / 300
    figure, (axes,) = plots.stacked(title, [3.6], width=8)
    taken = {}
    for name, speed, error, arithmetic in sorted(engines, key=lambda e: e[1]["median"]):
        colour = plots.COLOURS["motor" if arithmetic == "integer" else "quad"]
        at = error or floor
        axes.plot([speed["min"], speed["max"]], [at, at], color=colour, lw=2.5, alpha=0.35)
        axes.plot(speed["median"], at, "o", color=colour)
        row, before = taken.get(at, (0, 0))  # labels of neighbours stand above one another
        row = row + 1 if speed["median"] < 4 * before else 1
        taken[at] = row, speed["median"]
        axes.annotate(name, (speed["median"], at), xytext=(4, 1 + 10 * row), textcoords="offset points", fontsize=8,
                      arrowprops={"arrowstyle": "-", "lw": 0.5})
    axes.axvline(1, color=plots.COLOURS["reference"], lw=0.8, ls=":", label="real time")
    for kind, text in (("motor", "the RTL's integers, equal in every bit"), ("quad", "real arithmetic, the same laws")):
        axes.plot([], [], "o", color=plots.COLOURS[kind], label=text)
    axes.set(xscale="log", yscale="log", xlabel="simulated seconds per second of one core",
             ylabel="largest torque error against 113 bits, Nm")
    axes.margins(x=0.12, y=0.35)
    axes.legend(loc="center left")
    axes.set_title(f"{data['machine']}, {data['compiler']}, {data['date']}, simulation", fontsize=7)
    return plots.finish(figure, "bench")


PICTURES = {"feltgate-controllers/1": controllers, "feltgate-bench/2": bench}


def draw(data, options):
    if data["schema"] == "feltgate-stability/2":
        print(options.to / k_b(data, png=True).write(options.to)[0])
    else:
        write_whole(options.to, PICTURES[data["schema"]](data).svg)


if __name__ == "__main__":
    sys.exit(plots.main(__doc__, "study", ["feltgate-stability/2", *PICTURES], draw))
