# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Angle and torque over time as SVG inside the page. It uses the page's colours, so it is readable
in dark mode too. A cursor moves with the lever. Documentation: docs/figures.md
"""

from html import escape

import numpy as np
from matplotlib.ticker import MaxNLocator

from reports import moments, plots

WIDTH, LEFT, RIGHT = 760, 46, 8
ANGLE = (22, 118)  # top and bottom of the panels
TORQUE = (150, 278)
HEIGHT = 316
DECIMAL = (1, 2, 5, 10)
TURNS = (1, 1.5, 3, 4.5, 6, 9, 10)  # parts of a right angle
POINTS = 320  # slices of a curve, of which each keeps its smallest and its largest value


class Panel:
    """One pair of axes: numbers to places in the drawing."""

    def __init__(self, time, curves, place, least, steps):
        self.begin, self.end = float(time[0]), float(time[-1])
        low = min(float(c.min()) for c in curves)
        high = max(float(c.max()) for c in curves)
        middle, half = 0.5 * (low + high), 0.54 * max(high - low, least)
        self.low, self.high = middle - half, middle + half
        self.top, self.bottom = place
        self.ticks = shown_ticks(self.low, self.high, 5, steps)

    def x(self, time):
        share = (np.asarray(time) - self.begin) / max(self.end - self.begin, 1e-9)
        return LEFT + share * (WIDTH - LEFT - RIGHT)

    def y(self, value):
        share = (np.asarray(value) - self.low) / (self.high - self.low)
        return self.bottom - share * (self.bottom - self.top)

    def frame(self, title):
        places = [(float(self.y(t)), label(t, self.ticks)) for t in self.ticks]
        lines = [
            f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>'
            f'<text class="left" x="{LEFT - 7}" y="{y + 4:.1f}">{text}</text>'
            for y, text in places
        ]
        name = f'<text class="name" x="{LEFT}" y="{self.top - 9}">{escape(title)}</text>'
        return "".join(lines) + name

    def curve(self, time, values, kind):
        x, y = plots.thinned(np.asarray(time), np.asarray(values), POINTS)
        path = "L".join(f"{a:.1f} {b:.1f}" for a, b in zip(self.x(x), self.y(y), strict=True))
        return f'<path class="curve {kind}" d="M{path}"/>'


def shown_ticks(low, high, most, steps=DECIMAL):
    ticks = MaxNLocator(most, steps=steps).tick_values(low, high)
    return [float(t) for t in ticks if low <= t <= high]


def label(value, ticks):
    """A tick's number with as many digits as its neighbours need."""
    step = ticks[1] - ticks[0] if len(ticks) > 1 else 1.0
    digits = max(0, -int(np.floor(np.log10(step) + 1e-9)))
    return f"{value + 0.0:.{digits}f}".replace("-", "−")


def time_axis(panel):
    ticks = shown_ticks(panel.begin, panel.end, 7)
    marks = "".join(
        f'<path class="grid" d="M{panel.x(t):.1f} {ANGLE[0]}V{ANGLE[1]}M{panel.x(t):.1f} '
        f'{TORQUE[0]}V{TORQUE[1]}"/>'
        f'<text class="middle" x="{panel.x(t):.1f}" y="{TORQUE[1] + 17}">{label(t, ticks)}</text>'
        for t in ticks
    )
    return marks + f'<text class="right" x="{WIDTH - RIGHT}" y="{HEIGHT - 4}">time, s</text>'


def angle_panel(m):
    return Panel(m.time, [m.angle], ANGLE, 1.0, TURNS)


def touched(m, panel):
    """Pale bands over the time in which the object is felt; none where it is felt all the time."""
    found = moments.spans(m.touched)
    if len(found) > 12 or m.touched.mean() > 0.9:
        return ""
    bands = []
    for first, last in found:
        left, right = float(panel.x(m.time[first])), float(panel.x(m.time[last]))
        size = f'x="{left:.1f}" width="{max(1.0, right - left):.1f}"'
        bands += [
            f'<rect class="zone" {size} y="{top}" height="{bottom - top}" fill-opacity="0.16"/>'
            for top, bottom in (ANGLE, TORQUE)
        ]
    return "".join(bands)


def svg(m, title):
    """Two panels, one above the other. The torque asked for lies broad and pale under the other."""
    angle = angle_panel(m)
    torques = [x for x in (m.asked, m.felt, np.zeros(1)) if x is not None]
    torque = Panel(m.time, torques, TORQUE, 0.01, DECIMAL)
    at = float(angle.x(m.time[m.peak]))
    parts = [
        f'<svg class="traces" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="{escape(title, quote=True)}: angle and torque over time">',
        touched(m, angle),
        time_axis(angle),
        angle.frame("angle of the lever, degrees"),
        torque.frame("torque on the lever, Nm"),
        f'<path class="zero" d="M{LEFT} {torque.y(0.0):.1f}H{WIDTH - RIGHT}"/>',
        angle.curve(m.time, m.angle, "angle"),
        torque.curve(m.time, m.asked, "asked"),
        "" if m.felt is None else torque.curve(m.time, m.felt, "motor"),
        f'<path class="cursor" d="M0 {ANGLE[0]}V{ANGLE[1]}M0 {TORQUE[0]}V{TORQUE[1]}" '
        f'transform="translate({at:.1f} 0)"/></svg>',
    ]
    return "".join(parts)


def span():
    """Where the time axis begins and ends in the drawing, for the cursor."""
    return [LEFT, WIDTH - RIGHT]
