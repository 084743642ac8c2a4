# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What a run's card says: one plain sentence for each object, its numbers from the run's rows.

Documentation: docs/figures.md
"""

import numpy as np

from reporting import moments

TITLES = {
    "membrane": "Membrane",
    "spring_compression": "Spring",
    "spring_tension": "Spring that is pulled",
    "wall": "Wall",
    "damper": "Damper",
    "charge_attract": "Charges that attract",
    "charge_repel": "Charges that repel",
    "torque_step": "Steps of torque",
    "torque_step_cord": "Steps of torque against a cord",
    "hold_and_release": "Hold and release",
    "calibration_open_loop": "Calibration with voltages",
    "calibration_closed_loop": "Calibration with torques",
    "detent": "Knob with clicks, from a law file",
    "ceiling": "Soft ceiling over a stick",
    "wall_tracked": "Wall on a tracker",
    "ceiling_tracked": "Ceiling on a tracker and an encoder",
    "drums": "Three drums under a stick",
}

SAID = {
    "membrane": "The hand moves the lever through a thin skin: between {far} and {near} the motor "
    "pushes back with {most}, and on either side the lever is free.",
    "spring_compression": "The hand presses the lever into a spring that begins at {near}: the "
    "deeper it goes, the harder the motor pushes back, up to {most} at {far}.",
    "spring_tension": "The hand pulls on a spring: the farther it draws the lever from its rest, "
    "the harder the motor pulls back, up to {most} and no further.",
    "wall": "The lever meets a wall at {near}: the motor pushes back with up to {most} while the "
    "hand presses {depth} into it, and never pulls when the hand leaves.",
    "damper": "The lever moves as in honey: the faster the hand moves it, the harder the motor "
    "brakes, up to {most}.",
    "charge_attract": "A charge draws the lever to itself: the nearer the lever comes, the harder "
    "the motor pulls, up to {most}.",
    "charge_repel": "A charge pushes the lever away: the nearer the hand brings it, the harder the "
    "motor pushes back, up to {most}.",
    "torque_step": "The lever is locked and the motor is asked for sudden steps of torque, up to "
    "{most}.",
    "torque_step_cord": "A cord holds the lever while the motor is asked for sudden steps of "
    "torque, up to {most}.",
    "hold_and_release": "The hand blocks the lever while the motor pushes with {most}, and then "
    "lets go: nothing has wound up, and the lever does not leap.",
    "detent": "The hand turns a knob with clicks, between {low} and {high}: the motor pushes with "
    "up to {most} to the nearest one. The force is a law file, which the FPGA runs as a program.",
    "ceiling": "A stick on the lever goes up into a soft ceiling: the motor pushes back with the "
    "square of the depth, up to {most}.",
    "wall_tracked": "The hand leans on a wall that sees the lever only 144 times a second, with "
    "noise: the motor pushes back with up to {most}, and trembles.",
    "ceiling_tracked": "The hand leans on a soft ceiling that sees the lever by a tracker and goes "
    "on by the encoder: the motor pushes back with up to {most}.",
    "drums": "A stick strikes the drums beneath it one after the other: a skin pushes back with up "
    "to {most}, and the program tells how hard and where it was hit.",
}
MOVED = "The lever moves between {low} and {high}, and the motor puts up to {most} on it."
STILL = "The lever stands still, and the motor puts up to {most} on it."
REPLAYED = (
    "A recording moves the lever between {low} and {high}. The core asks for up to {most}, but "
    "nothing feels it: a recording cannot give way."
)


def degrees(value):
    return f"{value + 0.0:.0f}°".replace("-", "−")


def title(subject):
    return TITLES.get(subject, subject)


def said(summary, m):
    """The sentence, from the rows that the card shows."""
    torque = m.asked if m.felt is None else m.felt
    strong = np.abs(m.asked) >= 0.5 * np.abs(m.asked).max()
    begun = int(np.argmax(np.abs(m.asked) > moments.LEAST_NM))
    entered, deepest = float(m.angle[begun]), float(m.angle[m.peak])
    if summary.get("scene") == "membrane":  # the edges, not where its torque is largest
        entered, deepest = float(m.angle[strong].max()), float(m.angle[strong].min())
    low, high = float(m.angle.min()), float(m.angle.max())
    words = {
        "most": f"{np.abs(torque).max():.2f} Nm",
        "near": degrees(entered),
        "far": degrees(deepest),
        "depth": degrees(abs(deepest - entered)),
        "low": degrees(low),
        "high": degrees(high),
    }
    plain = MOVED if high - low > 1 else STILL
    if "scene" not in summary:
        return REPLAYED.format(**words)
    # What was never met is not described.
    sentence = SAID.get(summary["scene"], plain) if m.touched.any() else plain
    return sentence.format(**words)
