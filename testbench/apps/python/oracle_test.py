# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The tick of `lever` and `paper` written a second time, in the fixed-point numbers of another library (APyTypes), beside the twin's
chain: all bits of its six signals, on random and extreme counts, parameters, scenes and modes. docs/fixed-point.md

oracle_test.py VENV: where scripts/build.sh has fetched APyTypes."""

import collections
import math
import os
import random
import sys
import unittest
from pathlib import Path

sys.path += map(str, Path(sys.argv.pop(1)).glob("lib/python3*/site-packages"))
try:
    from apytypes import APyFixed, OverflowMode, QuantizationMode
except ImportError:
    if os.environ.get("CI"):
        raise
    APyFixed = None
import feltgate

# Window, 2^n, bits behind the point of the observer's operand, whether the voltage law gives the back-EMF back, clocks of a
# PWM period.
DESIGNS = {"lever": (767, 2, 26, True, 1000), "paper": (386, 4, 24, False, 2500)}
# Parameters of the supervisor, which the chain has not.
OTHERS = ("i2t", "hold", "polarity", "watchdog", "self_test", "overspeed", "inverse", "emf_over", "nominal")
SIGNALS = ("velocity_rad_s", "tau_hat_nm", "tau_ref_nm", "current_a", "voltage_v", "duty")


def number(value, fraction=32, bits=80):
    return APyFixed.from_float(value, bits=bits, frac_bits=fraction)


def floor(x, fraction):
    return x.cast(bits=80, frac_bits=fraction, quantization=QuantizationMode.TRN)


def rounded(x, fraction):
    return x.cast(bits=80, frac_bits=fraction, quantization=QuantizationMode.RND)


def saturated(x, bits, fraction):
    return x.cast(bits=bits, frac_bits=fraction, overflow=OverflowMode.SAT)


def limited(x, limit):
    """x in [-limit, limit]; a negative limit counts as 0."""
    limit = max(limit, number(0))
    return max(min(x, limit), -limit)


class Oracle:
    """The binary points are written here once more; what the twin takes from its design are the parameters p."""

    def __init__(self, window, gain, operand, emf_in_law, period):
        self.line, self.gain, self.operand = collections.deque([0] * window), gain, operand
        self.emf_in_law, self.period = emf_in_law, period
        self.velocity = self.state = self.current = self.voltage = self.reference = number(0)
        self.side, self.scene, self.ramping = 0, "free", True

    def torque(self, p, scene, count):
        theta = max(min(count, 2**17 - 1), -(2**17))
        if scene != "membrane":
            self.side = 0
        if scene == "setpoint":
            return p["setpoint_torque"]
        if scene == "membrane":
            outside = -1 if theta < p["membrane_lower"] else int(theta > p["membrane_upper"])
            self.side = outside or self.side
            return number(0) if outside or p["membrane_torque"] < 0 else p["membrane_torque"] * self.side
        if scene == "spring_compression":
            return rounded(max(p["compression_contact"] - theta, number(0)) * p["compression_stiffness"], 16)
        if scene == "spring_tension":
            return rounded((p["tension_rest"] - theta) * p["tension_stiffness"], 16)
        if scene == "damper":
            return -rounded(self.velocity * p["damper_damping"], 16)
        if scene == "wall":
            spring = floor((p["wall_contact"] - theta) * p["wall_stiffness"], 18)
            push = rounded(spring - floor(self.velocity * p["wall_damping"], 18), 16)
            return min(push, number(0)) if theta > p["wall_contact"] else number(0)
        if scene not in ("charge_attract", "charge_repel"):
            return number(0)
        sign, name = (1, "attract") if scene == "charge_attract" else (-1, "repel")
        distance = math.floor(float(p[f"{name}_centre"])) - theta
        if 0 < p[f"{name}_core"] and abs(distance) <= p[f"{name}_core"]:
            return rounded(distance * p[f"{name}_core_slope"], 16) * sign
        strength = int(float(p[f"{name}_strength"]) * 65536)
        force = 65535 if strength // 65536 >= distance**2 else strength // distance**2
        return number(force / 65536) * (sign if distance > 0 else -sign)

    def tick(self, p, count, armed, scene, mode):
        self.line.append(count)
        travel = (count - self.line.popleft() + 2**15) % 2**16 - 2**15
        raw = saturated(number(self.gain * travel), 32, 21)
        self.velocity = rounded(self.velocity + p["velocity_a1"] * (raw - self.velocity), 21)
        drive = floor(self.current * p["torque_constant"], 30) if armed else number(0)
        inertia = floor(self.velocity * p["inertia_gain"], 30)
        change = floor(drive + inertia - self.state, self.operand) * p["observer_a1"]
        self.state = rounded(self.state + change, 30) if armed else drive + inertia
        tau_hat = saturated(rounded(self.state - inertia, 16), 21, 16)
        # The scene's torque, limited and ramped with 24 bits.
        torque = self.torque(p, scene, count)
        target = limited(torque if armed else number(0), p["torque_limit"])
        self.ramping |= not armed or scene != self.scene
        self.scene = scene
        step, excess = max(p["ramp_step"], number(2**-24)), self.reference - target
        if not armed or not self.ramping:
            self.reference = target
        elif abs(excess) <= step:
            self.ramping = False
        else:
            self.reference = floor(self.reference + (-step if excess > 0 else step), 24)
        tau_ref = floor(self.reference, 16)
        # Current, voltage and duty.
        emf = floor(self.velocity * p["emf_constant"], 14)
        if mode == "voltage":
            asked = floor(self.voltage * p["voltage_to_current"], 16)
            volt = self.voltage + limited(p["voltage_setpoint"] - self.voltage, p["voltage_step"]) - emf
        else:
            by_hat = floor(tau_hat * p["observer_gain"], 16) if mode == "closed_loop" else number(0)
            asked = floor(tau_ref * p["torque_gain"], 16) + by_hat
            volt = limited(floor(tau_ref * p["dead_voltage_slope"], 14), p["dead_voltage"])
        self.current = floor(limited(asked, p["current_limit"]), 16) if armed else number(0)
        if mode != "voltage":
            region = max(p["region_torque"], number(0))  # its word has no sign
            gain = "voltage_gain_high" if abs(tau_ref) > region else "voltage_gain"
            volt += floor(self.current * p[gain], 14) - (number(0) if self.emf_in_law else emf)
        applied = limited(volt, p["voltage_window"]) + emf if armed else number(0)
        self.voltage = floor(saturated(floor(applied, 14), 20, 14), 14)
        duty = limited(rounded(applied * p["duty_gain"], 0), p["duty_limit"])
        return *map(float, (self.velocity, tau_hat, tau_ref, self.current, self.voltage)), float(duty) / self.period


@unittest.skipIf(APyFixed is None, "APyTypes could not be fetched")
class Ticks(unittest.TestCase):
    def test_random_and_extreme_lives(self):
        for design, constants in DESIGNS.items():
            with self.subTest(design=design):
                self.live(design, Oracle(*constants))

    def live(self, design, oracle):
        draw, chain = random.Random(1), feltgate.Chain(design, "fixed")

        def fits(name, value):
            try:
                chain.set(**{name: value})
            except ValueError:  # its register cannot hold it
                return False
            return True

        words, p = {}, {}
        for name, one in feltgate.parameters(design).items():
            if name.startswith(OTHERS):
                continue
            step, own = one["step"], round(one["value"] / one["step"])
            high = max(2**n - 1 for n in range(33) if fits(name, (2**n - 1) * step))
            low = -high - 1 if fits(name, -(high + 1) * step) else 0
            # With the design's ramp the output would be almost always a ramp.
            words[name] = step, low, high, 2**18 if name == "ramp_step" else own
            self.assertTrue(fits(name, words[name][3] * step))
            p[name] = number(words[name][3] * step)
        count, largest, ticks, pace = 0, dict.fromkeys(SIGNALS, 0), 0, 1

        while ticks < 10_000:
            for _ in range(draw.randrange(25)):
                name = draw.choice(list(words))
                step, low, high, own = words[name]
                word = draw.choice((own, own, own, draw.choice((0, 1, low, high)), draw.randrange(low, high + 1)))
                self.assertTrue(fits(name, word * step))
                p[name] = number(word * step)
            scene, mode = draw.choice(feltgate.laws(design)), draw.choice(("closed_loop", "closed_loop", "open_loop", "voltage"))
            armed, counts = draw.random() < 0.9, []
            if ticks > 3000 and draw.random() < 0.05:  # a count a tick for long is faster than the velocity's format
                pace = draw.choice((0, 0.7, 1, 1, -1, -1, 50))
            for _ in range(draw.randrange(1, 120)):
                count += pace if abs(pace) == 1 else round(draw.uniform(-pace, pace))
                counts.append(count)
            found = chain.run(counts, scene, mode=mode, armed=armed)
            for i, at in enumerate(counts):
                right = oracle.tick(p, at, armed, scene, mode)
                for name, value in zip(SIGNALS, right):
                    self.assertEqual(found[name][i], value, f"tick {ticks + i}, {name}, {scene}, {mode}, armed {armed}")
                    largest[name] = max(largest[name], abs(value))
            ticks += len(counts)
            count = draw.choice((0, 200, 400, -(2**18), 2**18)) if ticks > 3000 and draw.random() < 0.1 else count
        # Of words that end at 1024 rad/s, 16 Nm, 16 Nm, 32 A, 32 V and the period.
        for name, least in zip(SIGNALS, (700, 16, 1, 16, 24, 0.9)):
            self.assertGreaterEqual(largest[name], least, str(largest))


if __name__ == "__main__":
    unittest.main()
