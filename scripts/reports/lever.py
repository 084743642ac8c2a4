# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A lever drawn as SVG and moved by rows of a run: the hand's push and the motor's as arrows.

Without JavaScript it is shown where the torque is largest. lever.js moves it. Angle 0 is upright;
counting up turns clockwise. Documentation: docs/figures.md
"""

import math

from reports import moments, page

ROWS = 500  # a page holds three of these and more
ARROW = 64  # longest arrow, in units of the drawing
HAND_AT, MOTOR_AT = -112, -62  # where the arrows stand on the lever
PLAYING_S = 7.0  # how long a turn through the rows takes at least
SPEEDS = (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5)
SPEEDS += (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)


def arrow(torque, scale, start=12):
    """Path of an arrow along x, from beside the lever; nothing for what cannot be seen. lever.js
    has the same."""
    share = max(-1.4, min(1.4, torque / scale))
    if abs(share) < 0.03:
        return ""
    side = math.copysign(1, share)
    tip = side * start + share * ARROW
    head = side * min(9, abs(share) * ARROW)
    return f"M{side * start:.0f} 0H{tip:.1f}M{tip - head:.1f} -6L{tip:.1f} 0L{tip - head:.1f} 6"


def point(angle, radius):
    turned = math.radians(angle)
    return f"{radius * math.sin(turned):.1f} {-radius * math.cos(turned):.1f}"


def sector(begin, end, share, inner=88, outer=138):
    """Part of a ring, the stronger the more torque it stands for."""
    wide = 1 if end - begin > 180 else 0
    path = (
        f"M{point(begin, inner)}L{point(begin, outer)}A{outer} {outer} 0 {wide} 1 "
        f"{point(end, outer)}L{point(end, inner)}A{inner} {inner} 0 {wide} 0 {point(begin, inner)}Z"
    )
    return f'<path class="zone" d="{path}" fill-opacity="{0.12 + 0.5 * share:.2f}"/>'


def drawing(m):
    """The SVG, with the lever where the torque is largest."""
    at, scale = m.peak, m.scale_nm
    hand = "" if m.hand is None else arrow(m.hand[at], scale)
    motor = arrow(m.asked[at] if m.felt is None else m.felt[at], scale)
    marks = "".join(
        f'<path class="mark" d="M{point(a, 141)}L{point(a, 145 if a % 90 else 149)}"/>'
        for a in range(0, 360, 15)
    )
    return (
        '<svg class="lever" viewBox="-160 -151 320 302" role="img" aria-label="The lever, the push '
        'of the hand and of the motor">'
        + f'<circle class="mark" r="{-HAND_AT}"/>{marks}'
        + "".join(sector(*zone) for zone in moments.zones(m))
        + f'<g class="arm" transform="rotate({m.angle[at]:.2f})">'
        '<path class="bar" d="M-8 0L-5 -112H5L8 0Z"/><circle class="bar" r="15"/>'
        '<circle class="hub" r="5"/><circle class="grip" cy="-112" r="11"/>'
        f'<path class="motor" transform="translate(0 {MOTOR_AT})" d="{motor}"/>'
        f'<path class="hand" transform="translate(0 {HAND_AT})" d="{hand}"/></g></svg>'
    )


def slower(m):
    """(factor, words): by how much the drawing moves slower than what it shows."""
    span = max(float(m.time[-1] - m.time[0]), 1e-6)
    speed = max((s for s in SPEEDS if span / s >= PLAYING_S), default=SPEEDS[0])
    if speed == 1:
        return 1.0, "as fast as it was"
    if speed > 1:
        return 1 / speed, f"{speed:g} times faster"
    return 1 / speed, f"{1 / speed:g} times slower"


def rounded(values, digits):
    """Numbers as short as may be: whole ones where no digit is left."""
    if values is None:
        return None
    return [int(v) if digits == 0 else round(float(v), digits) for v in values.round(digits)]


def data(m, chart):
    """What lever.js needs, as JSON that may stand inside a page. Torques in mNm, angles in degrees;
    `chart` is (left, right) of the time axis that its cursor moves along."""
    rows = moments.thin(m, ROWS)
    told = {
        "begin_s": round(float(rows.time[0]), 6),
        "end_s": round(float(rows.time[-1]), 6),
        "slower": slower(m)[0],
        "scale_mnm": round(1e3 * m.scale_nm, 3),
        "chart": chart,
        "peak": int(abs(rows.time - m.time[m.peak]).argmin()),
        "angle_deg": rounded(rows.angle, 1 if abs(rows.angle).max() > 100 else 2),
        "asked_mnm": rounded(1e3 * rows.asked, 1 if m.scale_nm < 0.05 else 0),
        "felt_mnm": rounded(None if m.felt is None else 1e3 * rows.felt, 1),
        "hand_mnm": rounded(None if m.hand is None else 1e3 * rows.hand, 0),
    }
    return page.embedded(told)
