# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The sentence of a run's card: one for each object, with numbers from the run's rows.

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
    "free_lever": "Free lever",
    "damped_lever": "Free lever with a damper",
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
    "turn_switch": "Turn switch with a latch",
    "graded_membrane": "Graded membrane",
    "end_stops": "End stops",
    "end_stops_thrown": "Thrown against an end stop",
    "scroll_wheel": "Scroll wheel with inertia",
    "moved_detents": "Detents that the host moves",
    "flywheel": "Flywheel behind a spring",
    "pendulum": "Pendulum behind a spring",
    "collision": "Collision of two",
    "pantograph_floor": "A floor under a pen",
    "hidden_shapes": "Seven hidden shapes, changed under the pen",
    "pantograph_wall": "A floor of 50 N/m at 1 kHz",
    "pantograph_wall_filtered": "The same floor behind filters",
    "coupled_levers": "Two levers coupled",
    "coupled_levers_drag": "Two levers coupled by their positions",
    "coupled_levers_free": "Two levers coupled, the other one free",
    "material_fields": "The fields of a material, one by one",
    "material_stick_slip": "Stick and slip",
    "material_stone": "Stone",
    "material_fabric": "Fabric",
    "material_water": "Water",
    "texture": "A row of an image under the pen",
    "plane_circle": "A disc by its tangents, 1000 a second",
    "plane_circle_slow": "A disc by its tangents, 50 a second",
    "plane_floor": "A floor by its plane",
    "stylus_cube": "Over the edge of a cube",
    "stylus_floor": "3.3 N on a floor of 206 N/m",
    "stylus_sphere": "A sphere by its tangent planes",
    "gimbal": "A handle that a spring turns back by the shorter way",
    "bowed_string": "Bow on a string",
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
    "bowed_string": "The hand draws a bow across a string, which sticks to it and tears itself off "
    "196 times a second: the motor pulls back with up to {most}.",
    "turn_switch": "The hand moves a stalk between {low} and {high}: it springs back with up to "
    "{most} until it falls into a latch, which then holds it.",
    "graded_membrane": "The hand goes through a skin that grows stronger on the way, up to {most}; "
    "then the host turns it round, and it grows weaker.",
    "end_stops": "The lever runs freely between two stops that give way a little: they push back "
    "with up to {most} on the way in, and with a quarter of the energy on the way out.",
    "end_stops_thrown": "The lever is thrown against a stop: the motor catches it with up to {most} "
    "and gives less back than it took.",
    "scroll_wheel": "The hand spins up a wheel that exists only as numbers, holds the knob still, "
    "and the wheel goes on pulling: up to {most}.",
    "moved_detents": "The hand turns a knob from {low} to {high} through detents that the host sets "
    "while it turns: the motor pushes with up to {most} to the nearest.",
    "flywheel": "The hand pushes a flywheel by a spring, and then holds the lever: the wheel swings "
    "through and pulls with up to {most}.",
    "pendulum": "The hand lifts a pendulum by a spring and lets go: lever and pendulum swing between "
    "{low} and {high}, driven by up to {most}.",
    "collision": "The hand moves a puck that runs into another one: it feels the blow, up to {most}, "
    "and the other puck flies off.",
    "material_fields": "The hand goes into a material eight times, and each time another of its "
    "fields acts alone, with up to {most}.",
    "material_stick_slip": "A soft hand draws the lever over a surface: it sticks, tears off at "
    "{most}, overshoots and sticks again.",
    "material_stone": "The hand leans into stone: hard, smooth, with a fine vibration; the motor "
    "pushes back with up to {most}.",
    "material_fabric": "The hand leans into fabric: soft, rough, with a coarse vibration; the "
    "motor gives up to {most}.",
    "material_water": "The hand goes into water and out: it hardly pushes back, and slows both "
    "ways with up to {most}.",
}
# Devices of several axes.
OF_AXES = {
    "pantograph": "A hand leads the pen of two cranks over {way_mm} mm; where it meets "
    "something, both motors together push back with up to {force}.",
    "stylus": "A hand leads a stylus over {way_mm} mm through space; where it meets something, "
    "three motors together push back with up to {force}.",
    "gimbal": "A hand turns a handle in two rings by {first}; motors on all joints push it to "
    "where it began, the shorter way: up to {most} at the outer one.",
    "two_levers": "The hand turns a lever by {first}, another one follows by {second}, and what that "
    "one meets is felt: up to {most}.",
}
MOVED = "The lever moves between {low} and {high}, and the motor puts up to {most} on it."
STILL = "The lever stands still, and the motor puts up to {most} on it."
REPLAYED = (
    "A recording moves the lever between {low} and {high}. The core asks for up to {most}, but "
    "nothing feels it: a recording cannot give way."
)


def of_axes(summary, csv):
    """The sentence of a device of several axes."""

    def turned(n):
        return degrees(np.degrees(np.ptp(csv[f"theta_rad.{n}"])))

    words = {"first": turned(0), "second": turned(1)}
    if "hand_nm" in csv:
        words["most"] = f"{np.abs(csv['hand_nm']).max():.2f} Nm"
    if "handle_w" in csv:
        words["most"] = f"{np.abs(csv['motor_torque_nm.0']).max():.2f} Nm"
    if "pen_x_m" in csv:
        axes = [a for a in "xyz" if f"pen_{a}_m" in csv]
        way = np.linalg.norm([np.ptp(csv[f"pen_{a}_m"]) for a in axes])
        words["way_mm"] = f"{1e3 * way:.0f}"
        forces = np.linalg.norm([csv[f"hand_{a}_n"] for a in axes], axis=0)
        words["force"] = f"{forces.max():.1f} N"
    return OF_AXES[summary["device"]].format(**words)


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
