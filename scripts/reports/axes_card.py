# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The card of a device with several axes: one sentence, the path of its pen, joints and torques
over time. Documentation: docs/figures.md
"""

from html import escape

import numpy as np

from reports import glossary, page, sentences, time_chart

KINDS = ("angle", "hand", "motor")  # colours of the joints
PEN = (300, 260)  # the drawing of the pen's way
LEAST_MM = 1.0  # a way that is narrower says nothing as a drawing
NAMES = {
    "pantograph": ("left crank", "right crank"),
    "two_levers": ("lever", "the other lever"),
    "stylus": ("x", "y", "z"),
    "gimbal": ("outer joint", "middle joint", "inner joint"),
}


def joints(csv):
    return [int(name.rpartition(".")[2]) for name in csv if name.startswith("theta_rad.")]


def seen_along(csv):
    """The two directions in which a pen moved most."""
    there = [a for a in "xyz" if f"pen_{a}_m" in csv]
    return sorted(sorted(there, key=lambda a: -np.ptp(csv[f"pen_{a}_m"]))[:2])


def pen(csv):
    """The pen's way in a plane, to one scale, with the force at it as lines; SVG."""
    along = seen_along(csv)
    x, y = (1e3 * csv[f"pen_{a}_m"] for a in along)
    rows = np.unique(np.linspace(0, len(x) - 1, 240).round().astype(int))
    x, y = x[rows], y[rows]
    forces = [csv[f"hand_{a}_n"][rows] for a in along]
    most = max(float(np.hypot(*forces).max()), 1e-9)
    span = max(float(np.ptp(x)), float(np.ptp(y)), 1.0)
    middle = 0.5 * (x.min() + x.max()), 0.5 * (y.min() + y.max())
    scale = 0.5 * PEN[1] / span

    def place(right, up):
        return scale * (right - middle[0]), -scale * (up - middle[1])

    way = "L".join("{:.1f} {:.1f}".format(*place(a, b)) for a, b in zip(x, y, strict=True))
    pushes = ""
    for a, b, right, up in zip(x[::4], y[::4], forces[0][::4], forces[1][::4], strict=True):
        from_x, from_y = place(a, b)
        to = f"{from_x - 60 * right / most:.1f} {from_y + 60 * up / most:.1f}"
        pushes += f"M{from_x:.1f} {from_y:.1f}L{to}"
    return (
        f'<svg viewBox="{-PEN[0] / 2} {-PEN[1] / 2} {PEN[0]} {PEN[1]}" role="img" '
        'aria-label="The way of the pen and the force on it">'
        f'<path class="motor" fill="none" stroke-width=".6" d="{pushes}"/>'
        f'<path class="angle" fill="none" stroke-width="1.7" d="M{way}"/></svg>'
        f"<figcaption>the pen's way along {' and '.join(along)} over {page.number(span)} mm, "
        "and the force that the hand feels, "
        f"up to {page.number(most)} N</figcaption>"
    )


def has_way(csv):
    """Whether a pen moved in two directions."""
    return "pen_x_m" in csv and all(
        1e3 * np.ptp(csv[f"pen_{a}_m"]) > LEAST_MM for a in seen_along(csv)
    )


def chart(summary, csv):
    """Angles and torques of the joints over time; SVG."""
    time, found = csv["time_s"], joints(csv)
    angles = [np.degrees(csv[f"theta_rad.{n}"] - csv[f"theta_rad.{n}"][0]) for n in found]
    torques = [csv[f"motor_torque_nm.{n}"] for n in found]
    angle = time_chart.Panel(time, angles, time_chart.ANGLE, 1.0, time_chart.TURNS)
    torque = time_chart.Panel(
        time, [*torques, np.zeros(1)], time_chart.TORQUE, 0.01, time_chart.DECIMAL
    )
    curves = "".join(
        angle.curve(time, a, kind) + torque.curve(time, t, kind)
        for a, t, kind in zip(angles, torques, KINDS, strict=False)
    )
    return (
        f'<svg class="traces" viewBox="0 0 {time_chart.WIDTH} {time_chart.HEIGHT}" role="img" '
        f'aria-label="{escape(summary["scene"], quote=True)}: joints and motors over time">'
        + time_chart.time_axis(angle)
        + angle.frame("joints, degrees from where they began")
        + torque.frame("torque of the motors, Nm")
        + f'<path class="zero" d="M{time_chart.LEFT} {torque.y(0.0):.1f}'
        f'H{time_chart.WIDTH - time_chart.RIGHT}"/>{curves}</svg>'
    )


def legend(summary):
    names = NAMES.get(summary["device"], ("first axis", "second axis"))
    parts = "".join(
        f'<span><i class="swatch {kind}"></i>{escape(name)}</span>'
        for kind, name in zip(KINDS, names, strict=False)
    )
    return f'<p class="legend">{parts}</p>'


def facts(summary):
    """What was held, in a line."""
    worst = max(summary["axes"], key=lambda a: a["law_nm"]["max_error"])["law_nm"]
    bound = worst.get("bound")
    off = f"the engine's torque is off by at most {page.number(1e6 * worst['max_error'])} µNm"
    proven = f", proven bound {page.number(1e6 * bound)}" if bound else ""
    checked = summary["expectations"]["checked"]
    every = "both" if len(summary["axes"]) == 2 else "all"
    return (
        f"{summary['clocks']:,} clocks of {every} axes, {summary['mismatches']:,} mismatches; {off}"
        f"{proven}; {checked} expectations"
    )


def html(anchor, summary, csv):
    said = sentences.of_axes(summary, csv)
    drawn = f"<figure>{legend(summary)}{chart(summary, csv)}</figure>"
    if has_way(csv):
        drawn = f'<div class="moving"><figure>{pen(csv)}</figure>{drawn}</div>'
    return (
        f'<section class="card" id="{escape(anchor, quote=True)}">'
        f"<h3>{escape(sentences.title(summary['scene']))}</h3>"
        f'<p class="said">{glossary.marked(said)}</p>{drawn}'
        f"{page.paragraph(facts(summary), soft=True)}</section>"
    )
