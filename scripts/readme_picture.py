#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/chip.svg, the picture of the README: a hand on the lever, and the chip between encoder and bridge."""

import numpy as np
from matplotlib.patches import Circle, FancyBboxPatch, Rectangle

from docs_picture import BLUE, GREY, RED, plt, save

CHIP, BOX = "#eef4fa", "white"


def box(axes, x, y, width, height, text, color="k", fill=BOX):
    axes.add_patch(FancyBboxPatch((x, y), width, height, boxstyle="round,pad=0,rounding_size=0.08", fc=fill, ec=color))
    axes.text(x + width / 2, y + height / 2, text, ha="center", va="center", fontsize=9, color=color)


def arrow(axes, *points, text="", at=None, color="k"):
    xs, ys = zip(*points, strict=True)
    axes.plot(xs[:-1], ys[:-1], color=color, lw=1.1)
    axes.annotate("", points[-1], points[-2], arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.1})
    if text:
        axes.text(*at, text, fontsize=8, color=color, ha="center", va="bottom")


def lever(axes):
    """Motor, encoder, lever, hand, and the wall that is only arithmetic."""
    axes.add_patch(Circle((1.35, 1.35), 0.55, fc="#dddddd", ec="k"))
    axes.text(1.35, 0.6, "motor, encoder", ha="center", fontsize=8)
    angle = np.radians(68)
    tip = (1.35 + 1.9 * np.cos(angle), 1.35 + 1.9 * np.sin(angle))
    axes.plot((1.35, tip[0]), (1.35, tip[1]), color="k", lw=5, solid_capstyle="round")
    axes.add_patch(Circle(tip, 0.17, fc=RED, ec="k"))
    axes.annotate("", (tip[0] - 0.2, tip[1]), (tip[0] - 1.25, tip[1]), arrowprops={"arrowstyle": "-|>", "color": RED, "lw": 2})
    axes.text(tip[0] - 0.75, tip[1] + 0.12, "hand", color=RED, fontsize=9, ha="center")
    for row in range(5):
        for left, width in ((2.3, 0.3), (2.62, 0.3)) if row % 2 else ((2.3, 0.14), (2.46, 0.3), (2.78, 0.14)):
            axes.add_patch(Rectangle((left, 2.35 + 0.2 * row), width, 0.17, fc="#f3d9c4", ec=GREY, lw=0.6))
    axes.text(2.65, 3.45, "a wall that is\nonly arithmetic", fontsize=8, ha="center", va="bottom", color=GREY)


def chip(axes):
    axes.add_patch(FancyBboxPatch((3.9, 0.35), 6.9, 3.75, boxstyle="round,pad=0,rounding_size=0.15", fc=CHIP, ec=BLUE, lw=1.6))
    for n in range(12):
        for y in (0.2, 4.1):
            axes.add_patch(Rectangle((4.25 + 0.55 * n, y), 0.2, 0.15, fc=BLUE, ec="none"))
    axes.text(7.35, 3.83, "FPGA: a new torque every microsecond, equal to its C++ twin bit by bit", ha="center", fontsize=9, color=BLUE)
    box(axes, 4.2, 2.75, 1.35, 0.6, "quadrature\ndecoder")
    box(axes, 6.0, 2.75, 1.35, 0.6, "velocity\n(N-method)")
    box(axes, 7.9, 2.75, 1.5, 0.6, "disturbance\nobserver", color=RED)
    box(axes, 4.2, 1.65, 1.35, 0.6, "scene:\nwall, spring ...")
    box(axes, 6.0, 1.65, 1.35, 0.6, "limit, ramp")
    box(axes, 7.9, 1.65, 1.5, 0.6, "torque law")
    box(axes, 9.75, 1.65, 0.8, 0.6, "PWM")
    box(axes, 4.2, 0.6, 6.35, 0.55, "safety: stop, speed, polarity, heat, encoder, watchdog, self-test", color=GREY)
    arrow(axes, (2.0, 1.5), (3.3, 1.5), (3.3, 3.05), (4.2, 3.05), text="A, B, Z", at=(3.6, 3.08))
    arrow(axes, (5.55, 3.05), (6.0, 3.05))
    arrow(axes, (7.35, 3.05), (7.9, 3.05))
    arrow(axes, (4.87, 2.75), (4.87, 2.25))
    arrow(axes, (5.55, 1.95), (6.0, 1.95))
    arrow(axes, (7.35, 1.95), (7.9, 1.95), text="tau_ref", at=(7.63, 2.0))
    arrow(axes, (8.65, 2.75), (8.65, 2.25), text="tau_hat", at=(9.0, 2.4), color=RED)
    arrow(axes, (9.4, 1.95), (9.75, 1.95))
    arrow(axes, (10.15, 1.15), (10.15, 1.65), color=GREY)
    arrow(axes, (10.55, 1.95), (11.15, 1.95), (11.15, -0.1), (1.35, -0.1), (1.35, 0.5), text="H-bridge, current", at=(6.3, -0.42))


def main():
    figure, axes = plt.subplots(figsize=(9.6, 3.9), layout="constrained")
    lever(axes)
    chip(axes)
    axes.set(xlim=(0, 11.4), ylim=(-0.55, 4.4), aspect="equal")
    axes.axis("off")
    save(figure, "chip")


if __name__ == "__main__":
    main()
