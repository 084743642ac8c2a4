# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Numbers taken from runs, and the closed forms and laws with which they are compared.

Documentation: docs/figures.md, docs/scenes.md
"""

import numpy as np

from reports.runs import ROOT, design, read_toml, scene_file


def plant(name="p24"):
    return read_toml(ROOT / "vectors" / "plants" / f"{name}.toml")


def slope(x, y):
    """(slope, offset) of the straight line that fits best."""
    a, b = np.polyfit(x, y, 1)
    return float(a), float(b)


def steps(scene):
    """[(from_s, until_s, event)] of a scene's torque steps."""
    file = scene_file(scene)
    times = [event["at_s"] for event in file["event"]] + [file["duration_s"]]
    return [
        (event["at_s"], times[i + 1], event)
        for i, event in enumerate(file["event"])
        if "step_nm" in event
    ]


def finals(run, column, scene):
    """Mean of a column in the last tenth of each step."""
    time, values = run.csv["time_s"], run.csv[column]
    return np.array(
        [
            values[(time > until - 0.1 * (until - begin)) & (time <= until)].mean()
            for begin, until, _ in steps(scene)
        ]
    )


def set_values(scene, name):
    return np.array([event["set"][name] for _, _, event in steps(scene)])


RAMPED_S = 0.11  # from arming to the end of the torque's ramp, and some more


def arm_time(scene):
    """When the torque of a scene stands: armed, and the ramp of the torque over."""
    return scene_file(scene)["core"].get("arm_s", 0.0) + RAMPED_S


def ideal_torque(scene, design_name, theta, omega):
    """Torque of the object itself at the true angle and speed of the lever, Nm on the lever."""
    s = design(design_name)["scenes"]
    limit = design(design_name)["control"]["torque_limit_nm"]
    if scene == "membrane":
        torque = membrane(theta, s["membrane_lower_rad"], s["membrane_upper_rad"], s["membrane_nm"])
    elif scene == "spring_compression":
        depth = np.maximum(s["compression_contact_rad"] - theta, 0)
        torque = s["compression_nm_rad"] * depth
    elif scene == "spring_tension":
        torque = -s["tension_nm_rad"] * np.maximum(theta - s["tension_rest_rad"], 0)
    elif scene == "wall":
        push = s["wall_nm_rad"] * (theta - s["wall_contact_rad"]) + s["wall_nm_s_rad"] * omega
        torque = np.where(theta > s["wall_contact_rad"], np.minimum(-push, 0), 0.0)
    elif scene == "damper":
        torque = -s["damper_nm_s_rad"] * omega
    elif scene in ("charge_attract", "charge_repel"):
        torque = charge(theta - s["charge_centre_rad"], s["charge_nm_rad2"], s["charge_core_rad"])
        torque = -torque if scene == "charge_attract" else torque
    else:
        raise ValueError(f"{scene}: not an object that has a torque of its own")
    return np.clip(torque, -limit, limit)


def membrane(theta, lower, upper, torque):
    """Against the direction in which it was entered: positive when entered from above."""
    side = np.where(theta > upper, 1.0, np.where(theta < lower, -1.0, np.nan))
    known = np.maximum.accumulate(np.where(np.isnan(side), -1, np.arange(len(side))))
    entered = np.where(known >= 0, side[np.maximum(known, 0)], 1.0)
    return np.where(np.isnan(side), torque * entered, 0.0)


def charge(x, strength, core):
    """Repulsion c/x^2; inside the core, where there is one, a straight line."""
    side = np.where(x < 0, -1.0, 1.0)  # on the charge itself as above it
    outside = side * strength / np.maximum(x * x, 1e-12)
    if core <= 0:
        return outside
    return np.where(np.abs(x) < core, strength * x / core**3, outside)


def observer_pole(design_name):
    """Pole of the observed torque at a blocked shaft, rad/s: g*Jn*Kp when it is fed back."""
    observer, control = design(design_name)["observer"], design(design_name)["control"]
    if "kp_1_kg_m2" not in control:  # Kp = 1/Jn
        return observer["cutoff_rad_s"]
    return observer["cutoff_rad_s"] * observer["inertia_kg_m2"] * control["kp_1_kg_m2"]


def zero_crossing(x, y):
    """Where the line through the points first changes its sign; None when it never does."""
    for i in range(len(x) - 1):
        if y[i] == 0 or y[i] * y[i + 1] < 0:
            return float(x[i] - y[i] * (x[i + 1] - x[i]) / (y[i + 1] - y[i]))
    return None


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def ripple(time, values, window_s=0.02):
    """What is left of a signal without its running mean: its vibration."""
    width = max(1, round(window_s / float(np.median(np.diff(time)))))
    if len(values) <= 2 * width:
        raise ValueError("too short for a running mean")
    smooth = np.convolve(values, np.full(width, 1 / width), "valid")
    start = (width - 1) // 2
    return values[start : start + len(smooth)] - smooth


def dead_time_v(design_name):
    """Voltage that the dead time of the bridge takes, V."""
    pwm = design(design_name)["pwm"]
    return pwm["dead_time_s"] * pwm["frequency_hz"] * pwm["supply_v"]


def lag_s(time, follower, leader, most_s=0.01):
    """By how much a signal lags another: the delay at which they fit best, between rows too."""
    dt = float(np.median(np.diff(time)))
    most = int(most_s / dt)
    length = len(time) - most
    errors = np.array(
        [np.mean((follower[k : k + length] - leader[:length]) ** 2) for k in range(most)]
    )
    k = int(errors.argmin())
    if 0 < k < most - 1:  # the parabola through the smallest three
        a, b, c = errors[k - 1 : k + 2]
        return dt * (k + 0.5 * (a - c) / (a - 2 * b + c))
    return dt * k
