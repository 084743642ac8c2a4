#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The K-B plot and the eigenvalue locus of a stability study: stability.py STUDY.json FOLDER.

Called by `feltgate stability --plot`; it only draws. Documentation: docs/speed-for-accuracy.md
"""

import sys

import numpy as np

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


def locus(study, png=False):
    """Poles of the core's own wall while its stiffness grows."""
    figure, (axis,) = plots.stacked(
        f"Poles of a wall at the tick rate, {study['design']}, "
        f"B = {study['locus_damping_nm_s_rad']:g} Nm s/rad",
        [3.2],
    )
    stiffness, real, imaginary = [], [], []
    for point in study["locus"]:
        for pole in point["poles_rad_s"]:
            stiffness.append(point["stiffness_nm_rad"])
            real.append(pole[0])
            imaginary.append(pole[1])
    if stiffness:
        dots = axis.scatter(
            real, imaginary, c=np.log10(stiffness), s=7, cmap="viridis", linewidths=0
        )
        bar = figure.colorbar(dots, ax=axis, pad=0.02)
        bar.set_label("log10 of K, Nm/rad", fontsize=8)
    axis.axvline(0, color="#1d2329", linewidth=0.8)
    axis.set_xlim(-60, 40)
    axis.set_ylim(bottom=-20, top=700)
    axis.set(xlabel="growth, rad/s", ylabel="frequency, rad/s")
    caption = (
        "Each dot is an eigenvalue; right of the line the swing grows. The other slow one, the "
        "low-pass of the velocity, stays near -500 rad/s and out of the picture."
    )
    return plots.finish(figure, "stability_locus", caption, png)


def draw(study, options):
    for picture in (k_b(study, png=True), locus(study, png=True)):
        print(options.to / picture.write(options.to)[0])


if __name__ == "__main__":
    sys.exit(plots.main(__doc__, "stability", ["feltgate-stability/1"], draw))
