# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The points of a sweep as a picture for a document: error over area, and over delay.

Documentation: docs/speed-for-accuracy.md
"""

import outputs
from reports import plots

from exploration import front, presets

NAME = "explore.svg"
KINDS = (
    ("1 MHz, outputs of the base", "#0072b2"),
    ("other tick rate", "#009e73"),
    ("coarser or finer outputs", "#cc79a7"),
    ("fewer scenes", "#8c96a0"),
)
OUTPUTS = {"formats.torque", "formats.current", "formats.voltage"}


def kind(row):
    """Index into KINDS."""
    if front.SCENES in row["set"]:
        return 3
    if OUTPUTS & row["set"].keys():
        return 2
    return 1 if "clock.tick_hz" in row["set"] else 0


def draw_axes(axes, rows, across, factor, label):
    on_front = {row["id"] for row in front.find(rows)}
    for index, (name, colour) in enumerate(KINDS):
        for is_front in (False, True):
            part = [
                row for row in rows if kind(row) == index and (row["id"] in on_front) == is_front
            ]
            axes.scatter(
                [factor * row["result"][across] for row in part],
                [1e6 * row["result"]["torque_error_rms_nm"] for row in part],
                s=26 if is_front else 14,
                facecolors=colour if is_front else "none",
                edgecolors=colour,
                linewidths=0.9,
                label=name if is_front else "_nolegend_",
                zorder=3 if is_front else 2,
            )
    for level, (name, row) in enumerate(presets.choose(rows).items()):
        place = (factor * row["result"][across], 1e6 * row["result"]["torque_error_rms_nm"])
        axes.annotate(
            name,
            place,
            xytext=(6, 9 + 22 * level),  # dots of two may be beside each other
            textcoords="offset points",
            fontsize=8,
            fontweight="bold",
            arrowprops={"arrowstyle": "-", "linewidth": 0.6},
        )
    axes.set(yscale="log", xlabel=label, ylabel="rms torque error, µNm")


def write(plan, rows):
    """Writes the picture of a merged plan; its path."""
    rows = [row for row in rows if front.good(row)]
    figure, axes = plots.stacked("", [2.6, 2.6], apart=2)
    draw_axes(axes[0], rows, "lut4_equivalents", 1, "LUT4 equivalents on ECP5")
    draw_axes(axes[1], rows, "delay_s", 1e3, "delay of the velocity, ms")
    plots.legend(axes[0], columns=2)
    picture = plots.finish(figure, plan.name)
    path = plan.folder / NAME
    outputs.write_whole(path, picture.svg)
    return path
