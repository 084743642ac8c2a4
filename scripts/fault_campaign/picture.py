# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the hand would have felt: peak and integral of the torque's deviation, a dot for each fault."""

from reports import plots

COLOURS = {"latent": "#bbbbbb", "transient": "#7fb3d5", "off": "#af7ac5", "detected": "#2e8b57",
           "silent": "#e67e22", "unsafe": "#c0392b"}
TITLES = {("state",): "one bit of state flips", ("pins", "words"): "pins and words"}
LEAST = 1e-4  # what is smaller is drawn there


def draw(faults, kind="svg"):
    """The picture as text or bytes; both axes are logarithmic."""
    figure = plots.figure((9, 4.2), "Torque that the hand would have felt; dotted 5 % of the limit, dashed the limit")
    for axes, (points, title) in zip(figure.subplots(1, 2, sharex=True, sharey=True), TITLES.items()):
        for name, colour in COLOURS.items():
            of = [f for f in faults if f["point"] in points and f["class"] == name]
            if of:
                axes.loglog([max(f["peak_nm"], LEAST) for f in of], [max(1e3 * f["integral_nm_s"], LEAST) for f in of],
                            ".", ms=4, color=colour, alpha=0.6, label=f"{name} ({len(of)})", rasterized=True)
        axes.axvline(0.025, color=plots.COLOURS["reference"], lw=0.8, ls=":")
        axes.axvline(0.5, color=plots.COLOURS["reference"], lw=0.8, ls="--")
        axes.set(title=title, xlabel="peak of the deviation, Nm", ylabel="its integral to the gates off, mNm s")
        axes.legend(loc="upper left", markerscale=2)
    drawn = plots.finish(figure, "faults", png=kind == "png")
    return drawn.png or drawn.svg
