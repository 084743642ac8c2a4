# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""explore.svg, error over area and over delay, and explore.html: the picture, the front, every design. No network.

Documentation: docs/speed-for-accuracy.md
"""

import outputs
from reports import page, plots

from exploration import front
from exploration.design_text import toml_value

NAME = "explore.html"
# Figure, what it is, unit, factor to that unit.
FIGURES = (
    ("lut4_equivalents", "LUT4 equivalents", "", 1),
    ("torque_error_rms_nm", "rms torque error", "µNm", 1e6),
    ("torque_error_max_nm", "worst torque error", "µNm", 1e6),
    ("bound_torque_nm", "proven bound of the torque error", "µNm", 1e6),
    ("velocity_error_max_rad_s", "worst velocity error", "mrad/s", 1e3),
    ("bound_velocity_rad_s", "proven bound of the velocity error", "mrad/s", 1e3),
    ("velocity_error_rms_rad_s", "rms velocity error", "mrad/s", 1e3),
    ("tau_hat_error_max_nm", "worst error of the observed torque", "µNm", 1e6),
    ("delay_s", "estimator delay", "ms", 1e3),
    ("latency_us", "latency", "µs", 1),
    ("count_ripple_rad_s", "velocity ripple of one count", "rad/s", 1),
    ("torque_settling_s", "torque settling", "ms", 1e3),
    ("ff", "flip-flops", "", 1),
    ("mult18", "MULT18", "", 1),
    ("bram", "block RAM", "", 1),
    ("fmax_mhz", "Fmax", "MHz", 1),
)


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
    def place(row):
        return factor * row["result"][across], 1e6 * row["result"]["torque_error_rms_nm"]

    on_front = {row["id"] for row in front.find(rows)}
    for index, (name, colour) in enumerate(KINDS):
        for is_front in (False, True):
            part = [place(r) for r in rows if kind(r) == index and (r["id"] in on_front) == is_front]
            look = {"markersize": 5, "label": name, "zorder": 3} if is_front else {"markersize": 4, "fillstyle": "none"}
            if part:
                axes.plot(*zip(*part), "o", color=colour, markeredgewidth=0.9, **look)
    for level, (name, row) in enumerate(front.presets(rows).items()):
        axes.annotate(name, place(row), xytext=(6, 9 + 22 * level), textcoords="offset points", fontweight="bold",
                      fontsize=8, arrowprops={"arrowstyle": "-", "linewidth": 0.6})
    axes.set(yscale="log", xlabel=label, ylabel="rms torque error, µNm")


def words(point):
    """What sets the point apart from its base, in few words."""
    if not point["set"]:
        return f"{point['base']} as it is"
    return ", ".join(f"{key} {toml_value(v)}" for key, v in point["set"].items())


def table_of(rows):
    head = ["design", *(f"{what} {unit}".strip() for _, what, unit, _ in FIGURES)]
    lines = []
    for row in rows:
        values = [row["result"].get(key) for key, *_ in FIGURES]
        scaled = [page.number(None if v is None else v * f) for v, (*_, f) in zip(values, FIGURES, strict=True)]
        lines.append([words(row), *scaled])
    return page.table(head, lines, words=(0,))


def picture(rows):
    figure, axes = plots.stacked("", [2.6, 2.6], apart=2)
    draw_axes(axes[0], rows, "lut4_equivalents", 1, "LUT4 equivalents on ECP5")
    draw_axes(axes[1], rows, "delay_s", 1e3, "delay of the velocity, ms")
    plots.legend(axes[0], columns=2)
    return plots.finish(figure, "explore", "Filled: on the front.")


INTRODUCTION = (
    "{points} designs, each built, run beside its twin and found equal to it bit for bit, or "
    "refused ({refused}). On the front: no other design with the same scenes is at "
    "least as good in rms torque error, LUT4 equivalents, MULT18 and delay and better in one. "
    "Errors are against the same chain in 113-bit floating point on the same encoder counts. "
    "A design is its base with the values that its row says. "
    "Simulation and synthesis: nothing ran on a board."
)


def write(folder, found, rows):
    """Writes page and picture of a sweep's results; their paths."""
    good = [row for row in rows if front.good(row)]
    drawn = picture(good)
    body = f"<h1>{page.escape(found.name)}: {page.escape(found.description)}</h1>"
    body += page.paragraph(INTRODUCTION.format(points=len(rows), refused=len(rows) - len(good)))
    body += page.pictures([drawn]) + page.section("front", "The front", table_of(front.find(rows)))
    body += page.fold("Every design", table_of(good))
    outputs.write_whole(folder / "explore.svg", drawn.svg)
    outputs.write_whole(folder / NAME, page.document(f"feltgate explore: {found.name}", body))
    return [folder / "explore.svg", folder / NAME]
