#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Stands in for the feltgate program in the tests of the reports: same options, same JSON and CSV,
crude numbers from closed forms. FAKE_MISMATCHES=N makes every run report N mismatches.
"""

import argparse
import json
import os
import sys
import tomllib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
COUNT_RAD = 2 * np.pi / 4096
PLANT = ("theta_rad", "omega_rad_s", "motor_torque_nm", "hand_torque_nm", "hand_felt_nm")
SIGNALS = ("velocity_rad_s", "tau_ref_nm", "tau_hat_nm", "torque_nm", "current_a", "voltage_v")
QUAD = ("quad_velocity_rad_s", "quad_tau_hat_nm", "quad_torque_nm", "quad_current_a")
CORE = ("time_s", "position_rad", *SIGNALS, "duty", "limits", "faults", *QUAD)
COLUMNS = (*CORE, *PLANT)


def profile(segments, time, start):
    """Position of the hand's motion at each time."""
    theta, begin, at = np.full_like(time, start), 0.0, start
    for segment in segments:
        length, goal = segment["duration_s"], segment.get("to_rad", at)
        s = np.clip((time - begin) / length, 0, 1)
        if segment["kind"] == "minimum_jerk":
            s = 10 * s**3 - 15 * s**4 + 6 * s**5
        theta = np.where(time >= begin, at + (goal - at) * s, theta)
        begin, at = begin + length, goal
    return theta


def scene_path(subject):
    """A scene's name, or the path of its file, as the program takes them."""
    return Path(subject) if subject.endswith(".toml") else ROOT / f"vectors/scenes/{subject}.toml"


def scene_torque(scene, x, omega):
    if scene == "membrane":
        return np.where((x > 0.5) & (x < 0.7), 0.5, 0.0)
    if scene == "spring_compression":
        return np.clip(0.5 - x, 0, 0.5)
    if scene == "spring_tension":
        return np.clip(-0.5 * x, -0.5, 0)
    if scene == "damper":
        return np.clip(-0.03 * omega, -0.5, 0.5)
    inverse = np.where(np.abs(x) < 0.2, 2.5 * x, 0.02 / np.maximum(x, 1e-9) ** 2)
    return {"charge_attract": -inverse, "charge_repel": inverse}.get(scene, 0 * x)


def low_pass(x, dt, pole):
    y, a, state = np.empty_like(x), 1 - np.exp(-pole * dt), 0.0
    for i, value in enumerate(x):
        state += a * (value - state)
        y[i] = state
    return y


def run(options):
    """CSV columns and step responses of a scene."""
    scene_file = scene_path(options.subject)
    if not scene_file.exists():
        raise SystemExit(f"{options.subject}: no such scene; see vectors/scenes")
    scene = tomllib.loads(scene_file.read_text())
    dt = 1e-6 * options.every
    time = np.arange(dt, scene["duration_s"] + dt / 2, dt)
    phase = scene["hand"]["phase"][0]
    theta = profile(phase.get("motion", []), time, scene["hand"].get("start_rad", 0.0))
    omega = np.gradient(theta, time)
    paper = options.design == "paper"
    constant = 0.0605 if paper else 0.0302
    motor_constant, resistance = (0.0603, 1.25) if options.plant == "p48" else (0.0302, 0.42)
    velocity = low_pass(omega, dt, 500)
    armed = time >= scene["core"].get("arm_s", 0)
    reference = scene_torque(scene["core"]["scene"], theta, velocity) * armed
    direct = np.zeros_like(time)
    for event in scene.get("event", []):
        sets = event.get("set", {})
        later = time >= event["at_s"]
        reference = np.where(later, sets.get("setpoint_torque", reference), reference)
        direct = np.where(later, sets.get("voltage_setpoint", direct), direct)
    if paper:
        tau_hat = low_pass(reference, dt, 391.68)
        current = (0.78336 * reference + 0.21664 * tau_hat) / constant
        low, high = (
            dict(options.set).get(k, v)
            for k, v in (("voltage_gain", 1.25), ("voltage_gain_high", 0.95))
        )
        voltage = np.where(np.abs(reference) > 0.15, float(high), float(low)) * current
    else:
        current = reference / constant
        tau_hat = low_pass(reference, dt, 500)
        voltage = current * 0.42 + np.clip(34 * reference, -0.34, 0.34) + 0.0302 * velocity
    if scene["core"].get("mode") == "voltage":
        voltage, current = direct, direct if paper else direct / 0.42
        tau_hat = low_pass(constant * current, dt, 500)
    dead = np.clip(voltage, -0.34, 0.34)
    torque = low_pass(motor_constant * (voltage - dead) / resistance, dt, 5000)
    data = dict.fromkeys(COLUMNS, np.zeros_like(time))
    data |= {"time_s": time, "theta_rad": theta, "omega_rad_s": omega, "motor_torque_nm": torque}
    data |= {"hand_torque_nm": -torque, "hand_felt_nm": -torque}
    data |= {"position_rad": np.round(theta / COUNT_RAD) * COUNT_RAD}
    data |= {"velocity_rad_s": velocity, "tau_ref_nm": reference, "tau_hat_nm": tau_hat}
    data |= {"current_a": current, "voltage_v": voltage, "duty": voltage / 24}
    data |= {"torque_nm": constant * current, "quad_torque_nm": constant * current}
    noise = np.random.default_rng(1).normal(0, 2e-6, len(time))
    data |= {"quad_velocity_rad_s": velocity + noise / 10, "quad_tau_hat_nm": tau_hat + noise}
    data |= {"quad_current_a": current + noise}
    steps = [
        {
            "tau_ref_nm": e["step_nm"],
            "tau_hat_settling_ms": 9.99 if paper else 7.8,
            "torque_settling_ms": 6.6 if paper else 0.77,
            "overshoot_pct": 0.1,
            "final_error_pct": 4.8 if paper else -0.1,
            "tau_hat_final_error_pct": 0.001,
        }
        for e in scene.get("event", [])
        if "step_nm" in e
    ]
    return data, steps


def axes_run(options, device):
    """CSV columns and JSON of a device of several axes: all move, and the hand is pushed."""
    dt = 1e-6 * options.every
    time = np.arange(dt, 0.1 + dt / 2, dt)
    rise = np.clip(time / 0.1, 0, 1)
    data = {"time_s": time}
    axes = 3 if device == "stylus" else 2
    for n in range(axes):
        data |= {f"theta_rad.{n}": 0.5 + (0.3 - 0.2 * n) * rise}
        data |= {f"motor_torque_nm.{n}": (0.1 - 0.2 * n) * rise}
    if device == "pantograph":
        data |= {"pen_x_m": 0.02 * rise, "pen_y_m": 0.1 + 0.01 * rise**2}
        data |= {"hand_x_n": 0 * rise, "hand_y_n": -2 * rise}
    elif device == "stylus":
        data |= {"pen_x_m": 0.02 * rise, "pen_y_m": 0 * rise, "pen_z_m": 0.01 * rise**2}
        data |= {"hand_x_n": 0 * rise, "hand_y_n": 0 * rise, "hand_z_n": -2 * rise}
    else:
        data |= {"hand_nm": 0.3 * rise}
    axis = {"asked_peak_nm": 0.11, "motor_peak_nm": 0.1, "limits": {}, "faults": {}}
    axis["law_nm"] = {"max_error": 2.6e-3, "rms_error": 1e-3, "ticks": 90000, "bound": 8.2e-3}
    mismatches = int(os.environ.get("FAKE_MISMATCHES", "0"))
    broken = ["mismatches = 1 is outside its bounds"] if mismatches else []
    return data, {
        "schema": "feltgate-axes-run/1",
        "version": "0.0.0-fake",
        "scene": options.subject,
        "device": device,
        "design": options.design,
        "simulated_s": 0.1,
        "clocks": 5_000_000,
        "mismatches": mismatches,
        "axes": [axis] * axes,
        "expectations": {"checked": 7, "broken": broken},
    }


def device_of(scene):
    path = scene_path(scene)
    return tomllib.loads(path.read_text()).get("device") if path.exists() else None


def replay(options):
    path = Path(options.subject)
    if not path.exists() or path.stat().st_size < 10:
        raise SystemExit(f"{path}: empty; record it again")
    dt = 1e-6 * options.every
    time = np.arange(dt, 0.5, dt)
    data = dict.fromkeys(CORE, np.zeros_like(time))
    theta = np.round(np.sin(12 * time) / COUNT_RAD) * COUNT_RAD
    velocity = low_pass(12 * np.cos(12 * time), dt, 500)
    return data | {
        "time_s": time,
        "position_rad": theta,
        "velocity_rad_s": velocity,
        "quad_velocity_rad_s": velocity,
    }


def expectations(options):
    """Each as the scene's file has it, and kept: its bound is what came out."""
    scene = tomllib.loads(scene_path(options.subject).read_text())
    return [
        {k: e[k] for k in ("figure", "low", "high") if k in e}
        | {"value": e.get("high", e.get("low")), "line": 1, "kept": True}
        for e in scene.get("expect", [])
        if e.get("design", options.design) == options.design
    ]


def felt(options, data):
    def peak(name):
        at = int(np.abs(data[name]).argmax())
        return {"peak_nm": float(data[name][at]), "at_s": float(data["time_s"][at])}

    torque = {"asked": peak("tau_ref_nm"), "commanded": peak("torque_nm")}
    told = {"torque": torque, "limits": {"gates_closed": {"seconds": 0.05, "first_s": 0.0}}}
    told |= {"faults": {}}
    if options.command == "replay":
        return told
    off = data["motor_torque_nm"] - data["tau_ref_nm"]
    torque |= {"motor": peak("motor_torque_nm"), "hand": peak("hand_torque_nm")}
    torque |= {"motor_less_asked_nm": {"max_error": float(np.abs(off).max()), "rms_error": 1e-3}}
    energy = {"taken_from_hand_j": 0.0061, "given_to_hand_j": 0.0012}
    return told | {"energy": energy, "expectations": expectations(options)}


def summary(options, data, steps):
    mismatches = int(os.environ.get("FAKE_MISMATCHES", "0"))
    length, errors = float(data["time_s"][-1]), {"max_error": 3.1e-5, "rms_error": 4e-6}
    engines = {}
    for name, speed in (("rtl", 0.4), ("twin", 2.0), ("double", 9.0), ("quad", 0.5)):
        engine = {"saturations": 0, "speed": speed}
        if name != "quad":
            bound = {"bound": 4e-5} if name != "double" else {}
            engine |= {
                signal: errors | bound for signal in ("velocity_rad_s", "tau_hat_nm", "torque_nm")
            }
        if steps and name == "rtl":
            engine |= {"step_responses": steps, "ripple_nm": 1e-4}
        engines[name] = engine
    out = {
        "schema": "feltgate-run/1",
        "version": "0.0.0-fake",
        "design": options.design,
        "simulated_s": length,
        "clocks": round(length * 5e7),
        "ticks": round(length * 1e6),
        "mismatches": mismatches,
        "position": {"steps": 42, "illegal": 0, "reversals": 3},
        "reference": "quad",
        "engines": engines,
        "felt": felt(options, data),
    }
    if options.engine and "twin" in options.engine.split(","):  # the twin alone
        del out["mismatches"], engines["rtl"]
    if options.command == "run":
        broken = ["mismatches = 1 is outside its bounds"] if mismatches else []
        return out | {
            "scene": options.subject,
            "plant": options.plant or "p24",
            "expectations": {"checked": len(out["felt"]["expectations"]), "broken": broken},
        }
    return out | {"trace": Path(options.subject).name, "probes": options.probes or ""}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command", choices=["run", "replay"])
    parser.add_argument("subject")
    recording = ("--step", "--dir", "--time-column", "--count-column", "--scale")
    for name in ("--plant", "--engine", "--json", "--csv", "--probes", "--scene", "--seed", *recording):
        parser.add_argument(name)
    parser.add_argument("--design", default="lever")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--set", action="append", default=[], type=lambda s: s.split("=", 1))
    parser.add_argument("--quiet", action="store_true")
    options = parser.parse_args()
    device = device_of(options.subject) if options.command == "run" else None
    if device:
        data, result = axes_run(options, device)
    elif options.command == "run":
        data, steps = run(options)
        result = summary(options, data, steps)
    else:
        data = replay(options)
        result = summary(options, data, [])
    table = np.column_stack(list(data.values()))
    np.savetxt(options.csv, table, fmt="%.9g", delimiter=",", header=",".join(data), comments="")
    Path(options.json).write_text(json.dumps(result))
    return 1 if result["mismatches"] else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except SystemExit as error:
        if isinstance(error.code, str):
            print(error.code, file=sys.stderr)
            sys.exit(2)
        raise
