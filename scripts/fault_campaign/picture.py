# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the hand would have felt: peak and integral of the torque's deviation, a dot for each
fault."""

import io

from matplotlib.figure import Figure

COLOURS = {
    "latent": "#bbbbbb",
    "transient": "#7fb3d5",
    "off": "#af7ac5",
    "detected": "#2e8b57",
    "silent": "#e67e22",
    "unsafe": "#c0392b",
}
TITLES = {"state": "one bit of state flips", "pins": "pins and words"}


def points(faults, panel, name):
    """(peak in Nm, integral in mNm s) of the faults of one class; both axes are logarithmic."""
    wanted = ("state",) if panel == "state" else ("pins", "words")
    return [
        (max(f["peak_nm"], 1e-4), max(1e3 * f["integral_nm_s"], 1e-4))
        for f in faults
        if f["point"] in wanted and f["class"] == name
    ]


def draw(faults, kind="svg"):
    """The picture as bytes."""
    figure = Figure(figsize=(9.0, 4.2), layout="constrained")
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for axes, panel in zip(panels, TITLES):
        for name, colour in COLOURS.items():
            dots = points(faults, panel, name)
            if dots:
                axes.loglog(
                    *zip(*dots),
                    ".",
                    ms=4,
                    color=colour,
                    alpha=0.6,
                    label=f"{name} ({len(dots)})",
                    rasterized=True,
                )
        axes.axvline(0.025, color="#888888", lw=0.8, ls=":")
        axes.axvline(0.5, color="#888888", lw=0.8, ls="--")
        axes.set_title(TITLES[panel], fontsize=10)
        axes.set_xlabel("peak of the deviation [Nm]")
        axes.legend(fontsize=7, loc="upper left", markerscale=2)
    panels[0].set_ylabel("its integral to the gates off [mNm s]")
    figure.supxlabel(
        "dotted: 5 % of the limit, dashed: the limit; what is smaller than 1e-4 is drawn there",
        fontsize=7,
        color="#666666",
    )
    out = io.BytesIO()
    figure.savefig(out, format=kind, dpi=200, metadata={"Date": None} if kind == "svg" else None)
    return out.getvalue()
