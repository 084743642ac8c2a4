#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""calibrate cogging of feltgate host, as docs/calibration.md does it: the core turns a simulated motor slowly, and
what a hand then feels of the cogging is judged in closed loop, on another seed of the encoder and on other motions."""

import cmath
import csv
import json
import math
import os
import random
import re
import shlex
import unittest

from host_program import ROOT, ProgramTest
from testing import text_of, weekly

WHOLE = "FELTGATE_WHOLE" in os.environ  # all plants, not one
PAGE = text_of("docs/calibration.md")
SECTION = PAGE[PAGE.index("## Cogging") :]
NOMINAL_NM = 5.77 * 0.0302  # of p24: its nominal current times its torque constant
PLAIN = [(12, 0.05 * NOMINAL_NM, 0.4)]
MIXED = [(14, 6.0e-3, 1.0), (28, 2.0e-3, -2.0), (3, 0.7e-3, 0.3)]
UP_S, DOWN_S = (0.5, 7.1), (8.2, 14.6)  # of the hand below, when it turns
HAND = """title = "Judge"
about = "A hand turns the shaft up and down."
duration_s = 14.8
[core]
scene = "law"
law = "mine.law"
arm_s = 0.05
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [
  { kind = "hold", duration_s = 0.2 },
  { kind = "ramp", duration_s = 7.0, to_rad = 9.1 },
  { kind = "hold", duration_s = 0.5 },
  { kind = "ramp", duration_s = 7.0, to_rad = 0.0 },
]
"""
PLACES = [0.1 + 0.31 * n for n in range(6)]
LET_GO = HAND.split("[[hand.phase]]")[0].replace("14.8", "6.2") + "".join(
    f"""[[hand.phase]]
kind = "prescribed"
motion = [{{ kind = "minimum_jerk", duration_s = 0.4, to_rad = {at:.2f} }}, {{ kind = "hold", duration_s = 0.1 }}]
[[hand.phase]]
kind = "free"
duration_s = 0.5
"""
    for at in PLACES
)


def columns(path, *names):
    """Of a CSV, as lists of numbers."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [[float(row[name]) for row in rows] for name in names]


class Felt:
    """What the hand feels at each degree beside its mean, one way."""

    def __init__(self, path, span_s):
        bins = [[] for _ in range(360)]
        for t, angle, torque in zip(*columns(path, "time_s", "theta_rad", "hand_felt_nm")):
            if span_s[0] < t < span_s[1]:
                bins[int(math.degrees(angle)) % 360].append(torque)
        means = [sum(b) / len(b) for b in bins]
        self.nm = [m - sum(means) / 360 for m in means]

    def less(self, other):
        self.nm = [a - b for a, b in zip(self.nm, other.nm)]
        return self

    def peak(self):
        return max(map(abs, self.nm))

    def rms(self):
        return math.sqrt(sum(x * x for x in self.nm) / 360)

    def harmonic(self, n):
        return abs(sum(x * cmath.exp(-1j * n * math.radians(k + 0.5)) for k, x in enumerate(self.nm))) / 180


def told(name, ways, nominal_nm=NOMINAL_NM):
    """Prints a row of the page's table, in % of the nominal torque."""
    largest, mean = max(w.peak() for w in ways), max(w.rms() for w in ways)
    print(f"| {name} | {100 * largest / nominal_nm:.2f} | {100 * mean / nominal_nm:.2f} |", flush=True)


class CoggingTest(ProgramTest):
    design, shipped, nominal_nm = "lever_law", "p24", NOMINAL_NM

    def host(self, *words, status=0, design=None):
        return self.run_program("feltgate_host", "-", "--design", design or self.design, "calibrate", "cogging", *words,
                                status=status)  # fmt: skip

    def plant(self, name, cogging, seed, **changed):
        text = text_of(f"vectors/plants/{self.shipped}.toml")
        changed |= {"seed": seed, "encoder_imperfect": "true"}
        for key, value in changed.items():
            text, times = re.subn(rf"^{key} = \S+", f"{key} = {value}", text, flags=re.M)
            self.assertEqual(times, 1, key)
        for n, amplitude, phase in cogging:
            text += f"\n[[cogging]]\nper_turn = {n}\namplitude_nm = {amplitude}\nphase_rad = {phase}\n"
        return self.put(name, text)

    def run_scene(self, scene, plant, csv_name, *words):
        self.run_program(f"feltgate_{self.design}", "run", scene, "--design", self.design, "--plant", plant, "--engine",
                         "twin", "--csv", csv_name, "--every", 1000, "--quiet", *words, timeout=1500)  # fmt: skip

    def slow_turn(self, plant, *words):
        """The page's scene with the law that the command writes."""
        self.put("slow_turn.toml", re.search(r"```toml\n(.*?)```", SECTION, re.S)[1])
        self.host("--slow-turn", "slow_turn.law")
        self.run_scene("slow_turn.toml", plant, "turn.csv", *words)

    def felt(self, plant, *words, scene=HAND):
        self.put("hand.toml", scene)
        self.run_scene("hand.toml", plant, "felt.csv", *words)
        return [Felt(self.folder / "felt.csv", span) for span in (UP_S, DOWN_S)]

    def judged(self, cogging, name="", **changed):
        """Both ways with a law that comes of another seed, and what was found; prints a row of the page's table."""
        self.slow_turn(self.plant("first.toml", cogging, 1, **changed))
        self.said = self.host("--from", "turn.csv", "--write", "mine.law", "--json", "c.json")
        other = self.plant("other.toml", cogging, 2, **changed)
        after = self.felt(other)
        name = name or ", ".join(f"{k} = {v}" for k, v in changed.items())
        told(name or " and ".join(str(n) for n, _, _ in cogging), after, self.nominal_nm)
        return after, json.loads((self.folder / "c.json").read_text(encoding="utf-8"))


    def the_table_alone(self, least, name):
        """Without what the voltage law leaves out near zero the same table does little."""
        law = (self.folder / "mine.law").read_text(encoding="utf-8").splitlines()
        wanted = next(k for k, line in enumerate(law) if line.startswith("let cogging_wanted"))
        self.put("blunt.law", "\n".join([*law[: wanted + 1], "out torque = cogging_wanted\n"]))
        blunt = self.felt("other.toml", scene=HAND.replace("mine.law", "blunt.law"))
        told(f"{name}, the table alone", blunt, self.nominal_nm)
        self.assertGreater(min(way.peak() for way in blunt), least * self.nominal_nm)

    def in_lock_step(self):
        """The engine's RTL takes the law as the twin does."""
        self.put("short.toml", HAND.replace("14.8", "0.2").replace("7.0", "1.0").replace("0.2 }", "0.06 }"))
        self.run_program(f"feltgate_{self.design}", "run", "short.toml", "--design", self.design, "--plant",
                         "other.toml", "--engine", "rtl,twin", "--quiet", "--json", "short.json")  # fmt: skip
        short = json.loads((self.folder / "short.json").read_text(encoding="utf-8"))["figures"]
        self.assertEqual((short["mismatches"], short["faults"]), (0, 0))
        self.assertGreater(short["tau_ref_max_nm"], 0.02 * self.nominal_nm)


class Cogging(CoggingTest):
    @weekly(3)
    def test_5_percent_fall_to_half_a_percent(self):
        after, found = self.judged(PLAIN)
        before = self.felt("other.toml", "--set", "cogging_share=0")
        told("12, no law", before)
        for way in before:
            self.assertGreater(way.peak(), 0.0495 * NOMINAL_NM)
        for way in after:
            self.assertLess(way.peak(), 0.005 * NOMINAL_NM)
            self.assertLess(way.rms(), 0.0025 * NOMINAL_NM)
            self.assertLess(way.harmonic(12), 0.001 * NOMINAL_NM)
        self.assertEqual([h["per_turn"] for h in found["harmonics"]], [12])
        self.assertEqual(found["period"], 12)
        self.assertEqual(found["warnings"], [])
        # Friction is not taken for cogging, nor cogging for friction.
        self.assertAlmostEqual(found["friction_nm"], 3.9e-3, delta=0.4e-3)
        self.assertAlmostEqual(found["harmonics"][0]["amplitude_nm"]["value"] / PLAIN[0][1], 1, delta=0.03)
        # A core that counts from elsewhere: the recording's 0 is at -0.5 rad.
        moved = HAND.replace("[hand]", "[hand]\nstart_rad = 0.5").replace("9.1", "9.6").replace("0.0 }", "0.5 }")
        elsewhere = self.felt("other.toml", "--set", "cogging_zero=-0.5", scene=moved)
        told("12, counted from elsewhere", elsewhere)
        for way in elsewhere:
            self.assertLess(way.peak(), 0.005 * NOMINAL_NM)
        self.assertEqual(self.said.strip(), re.search(r"prints\n\n```\n(.*?)```", SECTION, re.S)[1].strip())
        self.in_lock_step()
        if WHOLE:
            self.the_rest()

    def the_rest(self):
        self.the_table_alone(0.02, "12")
        # A lever that is let go stays, and would have gone to where the cogging pulls it.
        self.put("let_go.toml", LET_GO)
        moved = {}
        for share in (0, 1):
            self.run_scene("let_go.toml", "other.toml", "go.csv", "--set", f"cogging_share={share}")
            times, angles = columns(self.folder / "go.csv", "time_s", "theta_rad")
            at = dict(zip((round(1e3 * t) for t in times), angles))
            moved[share] = [abs(at[999 + 1000 * n] - at[495 + 1000 * n]) for n in range(len(PLACES))]
        far = [1e3 * max(moved[share]) for share in (0, 1)]
        print(f"let go: moves by up to {far[0]:.0f} mrad, with the law {far[1]:.2f}", flush=True)
        self.assertGreater(max(moved[0]), 0.15)
        self.assertLess(max(moved[1]), 0.5e-3)

    def test_harmonics_are_found(self):
        after, found = self.judged(MIXED)
        before = self.felt("other.toml", "--set", "cogging_share=0")
        told("14 and 28 and 3, no law", before)
        self.assertEqual([h["per_turn"] for h in found["harmonics"]], [14, 28, 3])
        self.assertEqual(found["period"], 1)
        for way_before, way_after in zip(before, after):
            for n, amplitude, _ in MIXED:
                self.assertAlmostEqual(way_before.harmonic(n), amplitude, delta=0.02 * amplitude)
            self.assertLess(max(way_after.harmonic(n) for n in range(1, 180)), 0.002 * NOMINAL_NM)
            self.assertLess(way_after.peak(), 0.005 * NOMINAL_NM)
        # In another law: what is felt of it with cogging is what is felt without.
        self.host("--from", "turn.csv", "--write", "mine.law", "--into", "detent")
        with_it = self.felt("other.toml")
        without = self.felt(self.plant("none.toml", [], 2), "--set", "cogging_share=0")
        self.assertGreater(without[0].peak(), 0.045)
        for a, b in zip(with_it, without):
            self.assertLess(a.less(b).rms(), 0.005 * NOMINAL_NM)
        told("14 and 28 and 3, in detent", with_it)

    def test_constants_that_are_not_those_of_the_design(self):
        for most, changed in (
            (0.006, {"resistance_ohm": 0.378}),
            (0.005, {"resistance_ohm": 0.462}),
            (0.015, {"dead_voltage_v": 0.29}),
            (0.009, {"dead_voltage_v": 0.39}),
        ):
            after, _ = self.judged(PLAIN, **changed)
            self.assertLess(max(way.peak() for way in after), most * NOMINAL_NM)

    def test_a_motor_without_cogging(self):
        self.slow_turn(self.plant("none.toml", [], 1))
        self.assertIn("no cogging", self.host("--from", "turn.csv", "--json", "c.json"))
        self.assertEqual(json.loads((self.folder / "c.json").read_text(encoding="utf-8"))["harmonics"], [])
        self.assertIn("nothing to take away", self.host("--from", "turn.csv", "--write", "x.law", status=2))
        self.assertFalse((self.folder / "x.law").exists())


class Knob(CoggingTest):
    """A motor with three phases, whose dead times take more than its cogging; its sensor has no noise but its steps."""

    design, shipped, nominal_nm = "knob_law", "gimbal_motor", 0.6 * 0.0585
    slots = [(24, 0.05 * nominal_nm, 0.4)]

    def left(self, ways, largest, rms):
        for way in ways:
            self.assertLess(way.peak(), largest * self.nominal_nm)
            self.assertLess(way.rms(), rms * self.nominal_nm)

    def test_5_percent_fall_to_half_a_percent(self):
        after, found = self.judged(self.slots)
        self.left(after, 0.005, 0.0025)
        before = self.felt("other.toml", "--set", "cogging_share=0")
        told("24, no law", before, self.nominal_nm)
        for way in before:
            self.assertGreater(way.peak(), 0.049 * self.nominal_nm)
        self.assertEqual(found["harmonics"][0]["per_turn"], 24)
        self.assertAlmostEqual(found["harmonics"][0]["amplitude_nm"]["value"] / self.slots[0][1], 1, delta=0.01)
        self.assertAlmostEqual(found["friction_nm"], 0.53e-3, delta=0.1e-3)
        self.assertEqual(found["warnings"], [])
        self.in_lock_step()
        self.the_table_alone(0.02, "24")

    def test_harmonics_of_slots_and_magnets(self):
        after, found = self.judged([(24, 1.2e-3, 1.0), (48, 0.4e-3, -2.0), (22, 0.15e-3, 0.3)])
        told("24 and 48 and 22, no law", self.felt("other.toml", "--set", "cogging_share=0"), self.nominal_nm)
        self.assertEqual([h["per_turn"] for h in found["harmonics"]][:3], [24, 48, 22])
        self.left(after, 0.005, 0.0025)

    def test_a_magnet_that_is_off_its_axis(self):
        error = "0.0\nabsolute_error_mrad = [10.0, 0.0, 0.0, 5.0]"
        self.left(self.judged(self.slots, "the magnet", line_jitter_counts_rms=error)[0], 0.01, 0.005)

    def test_a_warm_winding(self):
        self.left(self.judged(self.slots, resistance_ohm=3.19)[0], 0.01, 0.005)


if not WHOLE:  # these take two minutes of the core's twin
    del Cogging.test_harmonics_are_found, Cogging.test_constants_that_are_not_those_of_the_design
    del Cogging.test_a_motor_without_cogging


def turn(path, *, up=7.6, down=7.6, rad_s=0.5, every_s=2e-3, cogging=(), noise_nm=0, rough=(), seed=1, armed=True,
         kept=()):  # fmt: skip
    """A recording that no core made: the load of an observer without inertia, friction of 4 mNm."""
    random.seed(seed)
    rows, t = ["time_s,position_rad,tau_hat_nm"], 0.0
    for length, sign in ((up, 1), (down, -1)):
        for n in range(round(length / rad_s / every_s)):
            gone = n * every_s * rad_s
            angle = gone if sign > 0 else up - gone
            load = sign * 4e-3 - sum(a * math.sin(k * angle + q) for k, a, q in cogging)
            load += sign * sum(a * math.sin(k * angle + q) for k, a, q in rough)
            load += random.gauss(0, noise_nm) if noise_nm else 0
            rows.append(f"{t:.6f},{round(angle / 1.534e-3) * 1.534e-3:.7f},{load if armed else 0:.6g}")
            t += every_s
    for line in kept:
        del rows[line]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")


class Recordings(CoggingTest):
    def found(self, *words, **recorded):
        turn(self.folder / "r.csv", **recorded)
        self.host("--from", "r.csv", "--json", "c.json", *words, design="paper")
        return json.loads((self.folder / "c.json").read_text(encoding="utf-8"))

    def test_noise_is_no_cogging(self):
        for seed in range(8):
            self.assertEqual(self.found(noise_nm=8e-3, seed=seed, every_s=5e-3)["harmonics"], [])

    def test_intervals_hold_what_was_put_in(self):
        inside = 0
        for seed in range(12):
            truth = 2e-3 + 1e-4 * seed
            found = self.found(cogging=[(7 + seed, truth, seed)], noise_nm=4e-3, seed=seed, every_s=5e-3)
            self.assertEqual([h["per_turn"] for h in found["harmonics"]], [7 + seed])
            h = found["harmonics"][0]
            inside += h["amplitude_nm"]["low"] < truth < h["amplitude_nm"]["high"]
            phase = math.atan2(h["cosine_nm"], h["sine_nm"])
            self.assertLess(abs(cmath.exp(1j * phase) - cmath.exp(1j * seed)), 0.2)
        self.assertGreaterEqual(inside, 9)  # of 95 %: fewer once in a thousand

    def test_friction_that_depends_on_the_angle_is_no_cogging(self):
        found = self.found(cogging=[(12, 8e-3, 0.4)], rough=[(9, 3e-3, 1)])
        self.assertEqual([h["per_turn"] for h in found["harmonics"]], [12])
        self.assertEqual(found["warnings"], [])
        found = self.found(cogging=[(12, 4e-3, 0.4)], rough=[(12, 3e-3, 1)])
        self.assertAlmostEqual(found["harmonics"][0]["amplitude_nm"]["value"], 4e-3, delta=0.1e-3)
        self.assertIn("the friction depends on the angle", found["warnings"][0])

    def test_recordings_that_do_not_say_it(self):
        cogging = [(12, 8e-3, 0.4)]
        for recorded, *said in (
            ({"up": 5.0, "down": 5.0}, r"r\.csv:\d+: 0\.78 of a turn up is too short; turn by a whole turn"),
            ({"down": 4.0}, r"r\.csv:\d+: 0\.62 of a turn down is too short"),
            ({"down": 0}, r"r\.csv:7601: the shaft turns one way only, never down; turn it down too"),
            ({"rad_s": 2, "cogging": [(24, 8e-3, 0)]}, r"r\.csv:\d+: 2 rad/s up is too fast for a cogging of 24"),
            ({"rad_s": 5, "every_s": 1e-3}, r"r\.csv:\d+: 5 rad/s up is too fast; turn at 0\.5 rad/s"),
            ({"every_s": 0.06}, r"r\.csv:\d+: 2\d\d rows per turn up are too few samples; record at least 256"),
            ({"armed": False}, r"r\.csv:\d+: the observed torque is 0 all the way up; arm the motor"),
            ({"kept": (slice(3000, 3200),)}, r"r\.csv:3001: the position jumps, rows are missing; record"),
            ({"kept": (slice(20, None),)}, r"r\.csv:1: 19 rows; record at least 64"),
        ):
            with self.subTest(recorded):
                turn(self.folder / "r.csv", **({"cogging": cogging} | recorded))
                self.assertRegex(self.host("--from", "r.csv", "--json", "c.json", status=2, design="paper"), *said)
                self.assertFalse((self.folder / "c.json").exists())

    def test_a_slow_turn_of_three_phases(self):
        self.host("--slow-turn", "slow.law", design="knob_law")
        law = (self.folder / "slow.law").read_text(encoding="utf-8")
        for part in ("0.164 Nm/rad", "-0.01 Nm, 0.01 Nm)", "periodic on [0, 1 turn / 66]", "* cogging_command\n"):
            self.assertIn(part, law)

    def test_words_that_do_not_go_together(self):
        turn(self.folder / "r.csv", cogging=[(12, 8e-3, 0.4)])
        text = (self.folder / "r.csv").read_text(encoding="utf-8").splitlines()
        self.put("full.csv", "\n".join([text[0] + ",tau_ref_nm", *(row + ",0.02" for row in text[1:])]) + "\n")
        self.put("two.law", "out torque = 0 Nm\nout torque[1] = 0 Nm\n")
        self.put("bad.law", "out torque = 1 rad * position\n")
        self.host("--from", "full.csv", "--write", "mine.law")
        before = sorted(f.name for f in self.folder.iterdir())
        full = ("--from", "full.csv", "--write", "m.law", "--into")
        for design, words, said in (
            ("lever_law", (), "needs --slow-turn FILE"),
            ("lever_law", ("--slow-turn", "a.law", "--from", "r.csv"), "needs --slow-turn FILE"),
            ("lever_law", ("--from", "r.csv", "--into", "detent"), "give both"),
            ("lever_law", ("--from", "r.csv"), "r.csv:1: no column of the torque reference"),
            ("lever_law", ("--from", "none.csv"), "none.csv:0: cannot be read"),
            ("paper", ("--from", "r.csv", "--write", "m.law"), "design paper has no engine for a law"),
            ("paper", ("--slow-turn", "m.law"), "design paper has no engine for a law"),
            ("lever_law", ("--from", "r.csv", "--write", "m.law", "--into", "no.law"), "no.law: cannot be read"),
            ("lever_law", (*full, "two.law"), "two.law:1: it has 2 torques"),
            ("lever_law", (*full, "mine.law"), "mine.law:1: it names a cogging already"),
            ("lever_law", (*full, "bad.law"), "bad.law:1:20: torque is in Nm, not in a number"),
        ):
            with self.subTest(words):
                self.assertIn(said, self.host(*words, status=2, design=design))
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), before)


if __name__ == "__main__":
    unittest.main()
