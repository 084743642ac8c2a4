#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's tabs of levers and pens in Chromium: what mouse, keys and controls do, and that the
figures shown are those of closed forms.

Documentation: docs/page.md
"""

import csv
import io
import math
import unittest
from urllib.parse import unquote

from browsing import Keys, TabTest

HAND_N_M = 135
HAND_NM_RAD = HAND_N_M * 0.1**2  # at a lever
COUNT_RAD = 2 * math.pi / 4096


class Pantograph(TabTest):
    TAB, STATE = "pantograph", "stage.seen"
    PICTURE, SHOWN = "#pen-stage svg", "#pen-stage .outline"

    def mode(self, name):
        self.click(f"#pen-modes input[value={name}]")

    def drawn(self, outlines):
        self.until(f"return document.querySelectorAll('{self.SHOWN}').length === {outlines}")

    def assert_held(self, face_m, sign, stiffness):
        """The force of a face at x against the hand: K d = 135 N/m (lead - d), to a count."""
        lead = sign * (face_m - self.tab("stage.lead[0]"))
        depth = lead * HAND_N_M / (HAND_N_M + stiffness)
        self.assertGreater(lead, 0.004)
        seen = self.settled(1.5)
        self.assertAlmostEqual(sign * (face_m - seen["x"]), depth, delta=160e-6)
        for part, wanted in (("x", sign * stiffness * depth), ("y", 0)):
            self.assertAlmostEqual(seen[f"force_{part}"], wanted, delta=stiffness * 160e-6)

    def test_the_pen_goes_into_a_square(self):
        self.assertFalse(self.one("#lever").is_displayed())
        self.js("feltgate.pantograph.stage.place(0.05, 0.12)")
        places = [self.js("return to_stage(arguments[0], 0.12)", x) for x in (0.05, 0.04, 0.02)]
        self.actions(self.PICTURE, *places).perform()
        for stiffness in (50, 200):
            self.turn("#pen-stiffness", stiffness)
            self.assert_held(0.03, 1, stiffness)
        self.assertRegex(self.text("#pen-stage .equation"), r"F = 0\.[78]\d N .* 76\.9 kHz")
        self.drawn(1)
        self.click("#pen-outline")
        self.drawn(0)
        before = self.tab("stage.lead")
        self.one(self.PICTURE).send_keys(Keys.ARROW_LEFT * 3 + Keys.ARROW_UP)
        moved = [b - a for a, b in zip(before, self.tab("stage.lead"))]
        self.assertAlmostEqual(moved[0], -0.003)
        self.assertAlmostEqual(moved[1], 0.001)
        # The lever goes on where it was.
        self.open_tab("lever")
        self.passed("feltgate.devices[0].now", 0.1)

    def test_training_squares(self):
        self.mode("training")
        # Drawn with the next frame.
        self.until("return document.querySelectorAll('#pen-stage .label').length === 8")
        for sign, y, stiffness in ((-1, 0.142, 50), (1, 0.142, 50), (-1, 0.088, 30), (1, 0.088, 30)):
            self.js("feltgate.pantograph.stage.place(...arguments[0])", [sign * 0.07, y])
            self.settled(0.1)
            self.js("feltgate.pantograph.stage.aim(...arguments[0])", [sign * 0.042, y])
            self.assert_held(sign * 0.05, sign, stiffness)

    def guess(self, name):
        for button in self.all("#game-names button"):
            if button.text == name:
                button.click()

    def test_a_guess_is_counted_and_exported(self):
        self.js("localStorage.clear()")
        self.mode("game")
        shapes = self.tab("game.names")
        self.assertEqual(len(shapes), 7)
        self.settled(0.1)
        self.drawn(0)
        first = self.tab("game.shape")
        self.js("feltgate.pantograph.stage.aim(0.02, 0.1)")
        self.guess(first)
        self.drawn(1)
        self.assertIn("Right", self.text("#game-said"))
        for button in ("#cue-stiffness", "#cue-damping", "#game-next"):
            self.click(button)
        second = self.tab("game.shape")
        self.assertNotEqual(second, first)
        self.drawn(0)
        # Something else in between does not change what is hidden.
        for mode in ("training", "game"):
            self.mode(mode)
            self.settled(0.1)
        self.assertEqual(self.tab("stage.loaded.name"), second)
        self.drawn(0)
        wrong = next(name for name in shapes if name != second)
        self.guess(wrong)
        self.guess(second)  # too late
        rows = self.one("#game-shares").text.splitlines()
        for row in ("none 1 100.0 %", "both 1 0.0 %", "all of yours 2 50.0 %"):
            self.assertTrue(any(line.startswith(row) for line in rows), (row, rows))
        cell = (
            "return document.getElementById('game-confusion')"
            ".rows[arguments[0] + 1].cells[arguments[1] + 1].textContent"
        )
        self.assertEqual(self.js(cell, shapes.index(second), shapes.index(wrong)), "1")
        self.assertEqual(self.js(cell, shapes.index(first), shapes.index(first)), "1")
        _, _, text = self.one("#game-export").get_attribute("href").partition(",")
        rows = list(csv.DictReader(io.StringIO(unquote(text))))
        found = [[r[name] for name in ("shape", "guess", "right", "stiffness_cue")] for r in rows]
        self.assertEqual(
            found, [[first, first, "true", "false"], [second, wrong, "false", "true"]]
        )
        # Kept, until they are forgotten; without a place to keep them it says so and goes on.
        self.setUp()
        self.mode("game")
        self.assertEqual(self.tab("game.guesses.length"), 2)
        self.click("#game-forget")
        self.assertEqual(self.tab("game.guesses.length"), 0)
        self.js("Storage.prototype.setItem = () => { throw new Error('full'); }")
        self.guess(wrong)
        self.assertEqual(self.tab("game.guesses.length"), 1)
        self.assertIn("keeps nothing", self.text("#game-kept"))


class Materials(TabTest):
    TAB = "materials"

    def test_a_hand_rests_in_two_materials(self):
        self.one("#materials-stages svg").send_keys(Keys.ARROW_RIGHT)
        self.assertAlmostEqual(self.tab("lead"), 0.02)
        for names in (("stone", "fabric"), ("water", "stone")):
            for n, name in enumerate(names):
                self.turn(f"#material-{n}", name)
            self.js("feltgate.materials.aim(0.55)")
            self.until("return feltgate.materials.stages.every(s => s.seen.time > 2.5)")
            for n in (0, 1):
                self.assert_rests(n)

    def assert_rests(self, n):
        """Hand, 1.35 Nm/rad, push, and what friction and vibration may add, to a count."""
        values, depth, trace = self.js(
            "const s = feltgate.materials.stages[arguments[0]];"
            "return [s.values, s.seen.theta - FACE_RAD, s.trace.slice(-300)]",
            n,
        )
        stiffness = HAND_NM_RAD + 4 * values["hardness"]
        vibration = values.get("vibration", 0)
        most_nm = values.get("load", 0) * values.get("static", 0) + vibration
        rest, margin = HAND_NM_RAD * 0.15 / stiffness, most_nm / stiffness + 0.0016
        self.assertAlmostEqual(depth, rest, delta=margin, msg=values)
        tremble = max(trace) - min(trace)
        if vibration:
            self.assertGreater(tremble, 1.5 * vibration)
        else:
            self.assertLess(tremble, 0.01)


class Coupled(TabTest):
    TAB = "coupled"

    def at_rest(self, lead):
        self.js("feltgate.coupled.aim(arguments[0])", lead)
        return self.settled(2.5)

    def test_a_spring_is_felt_through_the_law(self):
        self.assertEqual(self.tab("met"), "spring")
        k, coupling = 1, 4
        for share in (0, 1):
            self.turn("#coupled-law-share", share)
            self.assertEqual(self.tab("values.share"), share)
            seen = self.at_rest(0.5)
            felt = k * coupling / (coupling + (1 - share) * k)
            theta = HAND_NM_RAD * 0.5 / (HAND_NM_RAD + felt)
            for angle, wanted in zip(seen["theta"], (theta, felt / k * theta)):
                self.assertAlmostEqual(angle, wanted, delta=3 * COUNT_RAD, msg=share)
            self.assertAlmostEqual(seen["met"], -k * seen["theta"][1], delta=1e-9, msg=share)
            self.assertIn(f"{felt:.2f} Nm/rad of k = 1.00", self.text("#coupled-stages .equation"))
        # From the other side, and with nothing in the way.
        self.turn("#coupled-met", "nothing")
        self.all("#coupled-stages svg")[1].send_keys(Keys.ARROW_LEFT)
        self.assertEqual(self.tab("held"), 1)
        self.assertEqual(self.tab("values.share"), 0)
        seen = self.at_rest(-0.2)
        for angle in seen["theta"]:
            self.assertAlmostEqual(angle, -0.2, delta=2 * COUNT_RAD)
        self.assertEqual(seen["met"], 0)
        # The observer wants the hand on the first lever.
        self.turn("#coupled-law-share", 0.8)
        self.assertEqual(self.tab("held"), 0)


class Drums(TabTest):
    TAB = "drums"

    def test_drums_are_hit_and_heard(self):
        self.click("#drums-sound")
        self.until("return feltgate.drums.audio.state === 'running'")
        for drum, across in ((1, -0.36), (2, 0.06), (3, 0.3)):
            self.js("feltgate.drums.aim(arguments[0], 0.3)", across)
            self.settled(1.5)  # at rest
            hits = self.tab("hits.length")
            self.one("#drums-stage svg").send_keys(" ")
            self.until("return feltgate.drums.hits.length > arguments[0]", hits)
            hit = self.tab(f"hits[{hits}]")
            self.assertEqual(hit["drum"], drum)
            self.assertAlmostEqual(hit["place"], abs(across - 0.3 * (drum - 2)) / 0.12, delta=0.01)
            # At 0.3 m, in a hand that swings with 15 rad/s over 0.6 rad.
            self.assertGreater(hit["speed"], 0.3)
            self.assertLess(hit["speed"], 0.3 * 0.6 * 15.6)
        self.assertEqual(self.tab("played"), self.tab("hits.length"))
        self.assertIn("drum 3", self.one("#drums-hits").text.splitlines()[0])
        # Loudness goes with the speed, the sustain with the distance from the middle.
        peak = "return Math.max(...drum_samples(2, arguments[0], 0, 44100))"
        self.assertAlmostEqual(self.js(peak, 3) / self.js(peak, 1), 3, places=4)
        length = "return drum_samples(2, 1, arguments[0], 44100).length / 44100"
        self.assertAlmostEqual(self.js(length, 0) - self.js(length, 0.5), 0.2, places=3)
        self.click("#drums-sound")
        self.until("return feltgate.drums.audio.state === 'suspended'")


PERIOD_S = 1 / 196
# Late in a stroke but the first, where the bow's speed is even, with one slip a period.
EVEN = (
    "const s = feltgate.string, far = s.seen.hand * Math.sign(s.seen.speed);"
    "if (s.seen.time < (s.begun ?? 0) + 0.9 || !s.judged.helmholtz) return null;"
    "if (far < 0.5 || far > 0.8) return null;"
    "const ways = [];"
    "for (s.phase = 0; s.phase < 1; s.phase += 0.02) ways.push(s.shape([0, 0.5, 1]));"
    "const widest = [0, 1, 2].map(n => Math.max(...ways.map(w => Math.abs(w[n]))));"
    "return {judged: s.judged, seen: s.seen, widest,"
    "speed: s.quick, caption: s.caption.textContent}"
)


class BowedString(TabTest):
    TAB = "string"

    def let_it_go(self):
        """The bow by itself; the first stroke is its 0.5 s from now on, however late that is."""
        self.click("#string-alone")
        self.js("feltgate.string.begun = feltgate.string.seen.time")

    def test_a_bow_by_itself_has_one_slip_a_period(self):
        self.let_it_go()
        even = self.until(EVEN)
        # docs/devices/strings-and-drums.md: 1.8 N, 5.175 to 5.325 ms; a run is 25 us.
        judged = even["judged"]
        self.assertGreater(judged["least"], 5.14e-3)
        self.assertLess(judged["most"], 5.34e-3)
        self.assertAlmostEqual(judged["mean"] / PERIOD_S, 1.02, delta=0.02)
        self.assertAlmostEqual(judged["count"], 0.25 / judged["mean"], delta=2)
        self.assertRegex(even["caption"], r"Helmholtz.*19[0-4]\.\d Hz.*\n.* 40 kHz")
        self.assertAlmostEqual(even["speed"], 0.2, delta=0.02)
        # The string drawn from it: at rest at nut and bridge, widest v T / 8 place in the middle
        # when the corner is there.
        widest = even["widest"]
        self.assertLess(widest[0], 1e-9)
        self.assertLess(widest[2], 1e-9)
        self.assertAlmostEqual(widest[1], 2 * PERIOD_S / 8, delta=0.3e-3)
        # The hand is ahead by the friction; the turn's swing is not all over.
        self.turn("#string-force", 2.2)
        self.settled(0.7)
        seen = self.until(EVEN)["seen"]
        behind = seen["hand"] - seen["theta"]
        self.assertAlmostEqual(HAND_NM_RAD * behind, -seen["mean_torque"], delta=0.02)
        self.assertGreater(abs(seen["mean_torque"]), 0.1 * 0.3 * 2.2 * 0.9)
        self.assertLess(abs(seen["mean_torque"]), 0.1 * 0.8 * 2.2)

    def test_too_much_force_and_too_low_a_rate(self):
        low, high = self.js("return schelleng(0.2, 0.1)")
        self.assertAlmostEqual(low, 0.35**2 * 0.2 / (2 * 20 * 0.01 * 0.5))
        self.assertAlmostEqual(high, 2 * 0.35 * 0.2 / (0.1 * 0.5))
        self.let_it_go()
        self.until(EVEN)
        self.turn("#string-force", 3.8)
        rough = "const j = feltgate.string.judged; return j.count > 3 && !j.helmholtz && j"
        self.settled(0.5)
        self.until(f"{rough} && j.most > 1.2 * {PERIOD_S}")
        self.assertIn("not one slip", self.tab("caption.textContent"))
        self.turn("#string-force", 2)
        self.turn("#string-rate", 1)
        self.until(f"{rough} && j.mean > 1.3 * {PERIOD_S}")

    def test_mouse_and_keys(self):
        self.settled(0.2)
        self.assertEqual(self.js("return Math.max(...feltgate.string.trace.map(Math.abs))"), 0)
        self.assertEqual(self.tab("slips.length"), 0)
        (x, y), arm = self.js("return [BOWING.lever, BOWING.arm]")
        for angle in (0.5, -0.5):
            place = (x + arm * math.sin(angle), y - arm * math.cos(angle))
            self.actions("#string-stage svg", place).perform()
            self.assertAlmostEqual(self.tab("lead"), angle, delta=0.02)
        self.until("return feltgate.string.slips.length > 3")
        stage = self.one("#string-stage svg")
        stage.send_keys(Keys.ARROW_RIGHT * 2 + Keys.ARROW_UP * 3)
        self.assertAlmostEqual(self.tab("lead"), -0.4, delta=0.02)
        self.assertAlmostEqual(self.tab("force"), 2.1)
        stage.send_keys(" ")
        self.assertTrue(self.tab("alone"))
        self.until(EVEN)
        stage.send_keys(" ")
        self.assertFalse(self.tab("alone"))
        self.settled(1.5)
        self.assertEqual(self.tab("slips.length"), 0)

    def test_it_is_heard_without_joints_and_soon(self):
        self.let_it_go()
        self.click("#string-sound")
        self.until("return feltgate.string.sound && feltgate.string.sound.played > 40000")
        for _ in range(20):
            waits = self.js("const s = feltgate.string.sound; return s.next - s.audio.currentTime")
            self.assertLess(waits, 0.2)
        # In three parts or in one: the same samples, on straight lines between the values.
        parts, whole, rate = self.js(
            "const sine = Float32Array.from({length: 900}, (_, i) => Math.sin(i / 30)),"
            "cut = [[0, 100], [100, 533], [533, 900]],"
            "join = (a) => [].concat(...a.map(b => [...b]));"
            "const one = new StringSound(), two = new StringSound(), rate = one.audio.sampleRate;"
            "const out = [join(cut.map(c => one.resampled(sine.subarray(...c), 40000))),"
            "[...two.resampled(sine, 40000)], rate];"
            "one.audio.close(); two.audio.close(); return out"
        )
        self.assertLessEqual(abs(len(parts) - len(whole)), 1)
        self.assertAlmostEqual(len(whole), 900 * rate / 40000, delta=2)
        for k, (one, other) in enumerate(zip(parts, whole, strict=False)):
            self.assertAlmostEqual(one, other, places=5)
            at = max(0, k * 40000 / rate - 1)
            if at:
                self.assertAlmostEqual(one, math.sin(at / 30) / 2.5, delta=2e-4)
        self.click("#string-sound")
        self.until("return feltgate.string.sound.audio.state === 'suspended'")


if __name__ == "__main__":
    unittest.main()
