#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws error and margin over the rate from the JSON of feltgate rates; it only draws.

  feltgate rates wall -o wall.svg            calls it
  feltgate rates --json rates.json && scripts/rates_picture.py rates.json rates.svg

Documentation: docs/speed-for-accuracy.md
"""

import math
import sys

from matplotlib.ticker import LogLocator
from outputs import write_whole
from reports import plots

COLOURS = ["#0072b2", "#b23a00", "#008a64", "#7d4bb5", "#b04a8b", "#8a6d00", "#1d2329", "#5c6670"]
MARKS = "os^DvP<"
TICKS = {144: "144", 490: "490", 1e3: "1 k", 1e4: "10 k", 4e4: "40 k", 1e5: "100 k", 1e6: "1 M"}


def points(scene, key, factor=1.0):
    """Rates and values of the engine's rows, and of the block's, where they have the value; a gap
    where it is 0, for which a logarithm has no place."""
    out = {}
    for by in ("engine", "block"):
        rows = [r for r in scene["rates"] if r["by"] == by and r.get(key) is not None]
        out[by] = ([r["rate_hz"] for r in rows], [factor * r[key] or math.nan for r in rows])
    return out


def draw(axis, scene, key, factor, label="", **style):
    """A line through the engine's rows and a ring for the block. Whether there was anything."""
    found = points(scene, key, factor)
    if found["engine"][0]:
        axis.plot(*found["engine"], markersize=4, linewidth=1.1, label=label, **style)
    if found["block"][0]:
        ring = {"marker": "o", "markersize": 8, "markerfacecolor": "none", "linestyle": ""}
        axis.plot(*found["block"], **ring, color=style["color"])
    return bool(found["engine"][0])


def finish(figure, axes, name):
    for axis in axes:
        axis.set_xscale("log")
        # A swing may be 0.
        values = [value for line in axis.lines for value in line.get_ydata()]
        whole = all(value > 0 for value in values if not math.isnan(value))
        axis.set_yscale("log" if whole else "linear")
        axis.set_xticks(list(TICKS), list(TICKS.values()))
        axis.minorticks_off()
        low, high = axis.get_ylim()
        if whole and high < 100 * low:  # decades alone would leave one label, or none
            axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
        axis.set_xlim(110, 1.4e6)
    axes[-1].set_xlabel("torque renewed at, Hz")
    return plots.finish(figure, name)


def one(scene):
    """One scene: rms and worst error, its margin, and a device's swing."""
    device = "device" in scene
    has_margin = any("margin" in r for r in scene["rates"])
    title = f"{scene['scene']}: what a slower torque costs; law {scene['law']} on the engine"
    figure, axes = plots.stacked(title, [2.4] + [1.6] * (has_margin + device))
    for kind, colour, mark in (("max", COLOURS[1], "s"), ("rms", COLOURS[0], "o")):
        draw(axes[0], scene, f"error_{kind}_nm", 1e3, {"max": "worst"}.get(kind, kind), color=colour, marker=mark)
        if scene[f"counts_alone_{kind}_nm"] > 0:
            axes[0].axhline(1e3 * scene[f"counts_alone_{kind}_nm"], color=colour, linewidth=0.9, linestyle="--")
    axes[0].set_ylabel("torque error, mNm")
    axes[0].legend(loc="upper right")
    if has_margin:
        draw(axes[1], scene, "margin", 1, color=COLOURS[2], marker="o")
        axes[1].axhline(1, color="#d55e00", linewidth=0.9)
        axes[1].set_ylabel("border / scene")
    if device:
        rates, swings = zip(*((r["rate_hz"], 1e3 * r["swing_nm"]) for r in scene["rates"]))
        axes[-1].plot(rates, swings, color=COLOURS[2], linewidth=1.1)
        for r in scene["rates"]:  # full marks where all of the scene's expectations are kept
            axes[-1].plot(r["rate_hz"], 1e3 * r["swing_nm"], "o", markersize=5, color=COLOURS[2],
                          fillstyle="none" if r["broken"] else "full")
        axes[-1].set_ylabel("swing, mNm")
    return finish(figure, axes, f"rates_{scene['scene']}")


def several(scenes):
    """All scenes: rms error as a share of the law's largest torque, and margins."""
    figure, axes = plots.stacked("Every scene at every rate", [2.8, 2.4], width=7.6)
    for number, scene in enumerate(scenes):
        style = {
            "color": COLOURS[number % len(COLOURS)],
            "marker": MARKS[number // len(COLOURS) % len(MARKS)],
            "linestyle": "--" if "device" in scene else "-",
        }
        share = 100 / scene["largest_nm"] if scene["largest_nm"] > 0 else 0
        draw(axes[0], scene, "error_rms_nm", share, scene["scene"], **style)
        draw(axes[1], scene, "margin", 1, **style)
    axes[0].set_ylabel("torque error rms, %")
    if axes[0].get_legend_handles_labels()[0]:
        # Taller than the axes: it has the right quarter for itself.
        figure.get_layout_engine().set(rect=(0, 0, 0.76, 1))
        figure.legend(loc="upper right", bbox_to_anchor=(1.0, 0.96), fontsize=8 if len(scenes) < 30 else 6)
    axes[1].axhline(1, color="#d55e00", linewidth=0.9)
    axes[1].set_ylabel("border / scene")
    return finish(figure, axes, "rates")


def draw_all(data, options):
    scenes = data["scenes"]
    if not scenes:
        raise ValueError("no scene was measured")
    write_whole(options.to, (one(scenes[0]) if len(scenes) == 1 else several(scenes)).svg)


if __name__ == "__main__":
    sys.exit(plots.main(__doc__, "rates", ["feltgate-rates/1"], draw_all))
