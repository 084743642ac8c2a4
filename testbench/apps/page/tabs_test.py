#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's tabs of levers and pens in Chromium: what mouse, keys and controls do. That the devices
act as closed forms say is in page.loop, and of their laws in law. Documentation: docs/page.md
"""

import csv
import io
import unittest
from urllib.parse import unquote

from browsing import Keys, TabTest


class Pantograph(TabTest):
    TAB, STATE = "pantograph", "stage.seen"
    PICTURE, SHOWN = "#pen-stage svg", "#pen-stage .outline"

    def mode(self, name):
        self.click(f"#pen-modes input[value={name}]")

    def drawn(self, outlines):
        self.until(f"return document.querySelectorAll('{self.SHOWN}').length === {outlines}")

    def place(self, x, y):
        self.js("feltgate.pantograph.stage.place(...arguments)", x, y)
        return self.settled(0.1)

    def test_the_pen_goes_into_a_square(self):
        self.assertFalse(self.one("#lever").is_displayed())
        self.place(0.05, 0.12)
        places = [self.js("return to_stage(arguments[0], 0.12)", x) for x in (0.05, 0.04, 0.02)]
        self.actions(self.PICTURE, *places).perform()
        self.turn("#pen-stiffness", 200)
        seen = self.settled(1.5)
        self.assertAlmostEqual(seen["force_x"], 200 * (0.03 - seen["x"]), delta=200 * 160e-6)
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
        self.drawn(4)
        self.assertEqual(self.count("#pen-stage .label"), 8)
        for y, stiffness in ((0.142, 50), (0.088, 30)):
            self.place(0.07, y)
            self.js("feltgate.pantograph.stage.aim(0.042, arguments[0])", y)
            seen = self.settled(1.5)
            depth = 0.05 - seen["x"]
            self.assertAlmostEqual(seen["force_x"], stiffness * depth, delta=stiffness * 160e-6)

    def guess(self, name):
        self.js("[...document.querySelectorAll('#game-names button')].find(b => b.textContent === arguments[0]).click()", name)

    def test_a_guess_is_counted_and_exported(self):
        self.js("localStorage.clear()")
        self.mode("game")
        shapes = self.tab("game.names")
        self.assertEqual(len(shapes), 7)
        self.drawn(0)
        first = self.tab("game.shape")
        self.guess(first)
        self.drawn(1)
        self.assertIn("Right", self.text("#game-said"))
        for button in ("#cue-stiffness", "#cue-damping", "#game-next"):
            self.click(button)
        second = self.tab("game.shape")
        self.assertNotEqual(second, first)
        # Something else in between does not change what is hidden.
        self.mode("training")
        self.drawn(4)
        self.mode("game")
        self.assertEqual(self.tab("stage.loaded.name"), second)
        self.drawn(0)
        wrong = next(name for name in shapes if name != second)
        self.guess(wrong)
        self.guess(second)  # too late
        rows = self.one("#game-shares").text
        for row in ("none 1 100.0 %", "both 1 0.0 %", "all of yours 2 50.0 %"):
            self.assertIn(row, rows)
        cells = "return document.getElementById('game-confusion').rows[arguments[0]].innerText.split('\\t')"
        row = self.js(cells, 1 + shapes.index(second))
        self.assertEqual((row[0], row[1 + shapes.index(wrong)]), (second, "1"))
        _, _, text = self.one("#game-export").get_attribute("href").partition(",")
        rows = list(csv.DictReader(io.StringIO(unquote(text))))
        found = [[r[name] for name in ("shape", "guess", "right", "stiffness_cue")] for r in rows]
        self.assertEqual(found, [[first, first, "true", "false"], [second, wrong, "false", "true"]])
        # Kept, until they are forgotten.
        self.setUp()
        self.assertEqual(self.tab("game.guesses.length"), 2)
        self.click("#game-forget")
        self.assertEqual(self.tab("game.guesses.length"), 0)


class Materials(TabTest):
    TAB = "materials"

    def test_a_hand_rests_in_two_materials(self):
        self.one("#materials-stages svg").send_keys(Keys.ARROW_RIGHT)
        self.assertAlmostEqual(self.tab("lead"), 0.02)
        self.turn("#material-0", "water")
        self.turn("#material-1", "stone")
        self.js("feltgate.materials.aim(0.55)")
        water, stone = self.until(
            "const all = feltgate.materials.stages.map((stage) => stage.seen);"
            "return all.every((seen) => seen.time > 2.5) && all"
        )
        self.assertAlmostEqual(water["theta"], 0.55, delta=0.03)
        self.assertAlmostEqual(stone["theta"], 0.4 + 1.35 * 0.15 / (1.35 + 4), delta=0.02)
        self.assertIn("hardness 1", self.text("#materials-stages figure:last-child"))


class Coupled(TabTest):
    TAB = "coupled"

    def at_rest(self, lead):
        self.js("feltgate.coupled.aim(arguments[0])", lead)
        return self.settled(2.5)

    def test_a_spring_is_felt_through_the_law(self):
        self.turn("#coupled-law-share", 1)
        seen = self.at_rest(0.5)
        self.assertAlmostEqual(seen["torque"][0], -seen["theta"][1], delta=5e-3)  # 1 Nm/rad
        self.assertAlmostEqual(seen["met"], -seen["theta"][1])
        self.assertIn("1.00 Nm/rad of k = 1.00", self.text("#coupled-stages .equation"))
        # From the other side, with nothing in the way, and without the observer.
        self.turn("#coupled-met", "nothing")
        self.all("#coupled-stages svg")[1].send_keys(Keys.ARROW_LEFT)
        self.assertEqual((self.tab("held"), self.tab("values.share")), (1, 0))
        seen = self.at_rest(-0.2)
        self.assertAlmostEqual(seen["theta"][0], -0.2, delta=3e-3)
        self.assertEqual(seen["met"], 0)
        # The observer wants the hand on the first lever.
        self.turn("#coupled-law-share", 0.8)
        self.assertEqual(self.tab("held"), 0)


class Drums(TabTest):
    TAB = "drums"

    def test_drums_are_hit_and_heard(self):
        self.click("#drums-sound")
        self.until("return feltgate.drums.audio.state === 'running'")
        for drum, across in ((1, -0.36), (3, 0.3)):
            self.js("feltgate.drums.aim(arguments[0], 0.3)", across)
            self.settled(1.5)  # at rest
            hits = self.tab("hits.length")
            self.one("#drums-stage svg").send_keys(" ")
            self.until("return feltgate.drums.hits.length > arguments[0]", hits)
            hit = self.tab(f"hits[{hits}]")
            self.assertEqual(hit["drum"], drum)
            self.assertAlmostEqual(hit["place"], abs(across - 0.3 * (drum - 2)) / 0.12, delta=0.01)
            self.assertGreater(hit["speed"], 0.3)
        self.assertEqual(self.tab("played"), self.tab("hits.length"))
        self.assertIn("drum 3", self.one("#drums-hits").text.splitlines()[0])
        # Loudness goes with the speed, the sustain with the distance from the middle.
        soft, rim = self.js("return [drum_envelope(1, 0), drum_envelope(3, 0.5)]")
        self.assertAlmostEqual(rim[1][1] / soft[1][1], 3)
        self.assertAlmostEqual(soft[-1][0] - rim[-1][0], 0.2)
        self.click("#drums-sound")
        self.until("return feltgate.drums.audio.state === 'suspended'")


PERIOD_S = 1 / 196
# Late in a stroke but the first, where the bow's speed is even, with one slip a period.
EVEN = (
    "const s = feltgate.string, far = s.seen.hand * Math.sign(s.seen.speed);"
    "if (s.seen.time < s.begun + 0.9 || !s.judged.helmholtz) return null;"
    "if (far < 0.5 || far > 0.8) return null;"
    "const ways = [];"
    "for (s.phase = 0; s.phase < 1; s.phase += 0.02) ways.push(s.shape([0, 0.5, 1]));"
    "const widest = [0, 1, 2].map(n => Math.max(...ways.map(w => Math.abs(w[n]))));"
    "return {judged: s.judged, widest, speed: s.quick, caption: s.caption.textContent}"
)


class BowedString(TabTest):
    TAB = "string"

    def test_a_bow_by_itself_has_one_slip_a_period(self):
        self.click("#string-alone")
        # The first stroke is its 0.5 s from now on, however late that is.
        self.js("feltgate.string.begun = feltgate.string.seen.time")
        even = self.until(EVEN)
        # Of a bow of even speed 5.175 to 5.325 ms; a run is 25 us.
        judged = even["judged"]
        self.assertGreater(judged["least"], 5.14e-3)
        self.assertLess(judged["most"], 5.34e-3)
        self.assertAlmostEqual(judged["mean"] / PERIOD_S, 1.02, delta=0.02)
        self.assertAlmostEqual(judged["count"], 0.25 / judged["mean"], delta=2)
        self.assertRegex(even["caption"], r"Helmholtz.*19[0-4]\.\d Hz.*\n.* 40 kHz")
        self.assertAlmostEqual(even["speed"], 0.2, delta=0.02)
        # The string drawn from it: at rest at nut and bridge, widest v T / 8 place in the middle
        # when the corner is there.
        bridge, middle, nut = even["widest"]
        self.assertLess(max(bridge, nut), 1e-9)
        self.assertAlmostEqual(middle, 2 * PERIOD_S / 8, delta=0.3e-3)
        # Beyond Schelleng's upper limit, and at a host's rate, there is another motion.
        low, high = self.js("return schelleng(0.2, 0.1)")
        self.assertAlmostEqual(low, 0.35**2 * 0.2 / (2 * 20 * 0.01 * 0.5))
        self.assertAlmostEqual(high, 2 * 0.35 * 0.2 / (0.1 * 0.5))
        rough = "const j = feltgate.string.judged; return j.count > 3 && !j.helmholtz && j"
        self.turn("#string-force", 3.8)
        self.settled(0.5)
        self.until(f"{rough} && j.most > 1.2 * {PERIOD_S}")
        self.assertIn("not one slip", self.tab("caption.textContent"))
        self.turn("#string-force", 2)
        self.turn("#string-rate", 1)
        self.until(f"{rough} && j.mean > 1.3 * {PERIOD_S}")

    def test_mouse_and_keys(self):
        self.settled(0.2)
        self.assertEqual(self.js("return Math.max(...feltgate.string.trace.map(Math.abs))"), 0)
        (x, y), arm = self.js("return [BOWING.lever, BOWING.arm]")
        for across in (0.5, -0.5):
            self.actions("#string-stage svg", (x + arm * across, y - arm)).perform()
        self.until("return feltgate.string.slips.length > 3")
        lead = self.tab("lead")
        self.assertAlmostEqual(lead, -0.464, delta=0.02)
        stage = self.one("#string-stage svg")
        stage.send_keys(Keys.ARROW_RIGHT * 2 + Keys.ARROW_UP * 3)
        self.assertAlmostEqual(self.tab("lead"), lead + 0.1)
        self.assertAlmostEqual(self.tab("force"), 2.1)
        for alone in (True, False):
            stage.send_keys(" ")
            self.assertEqual(self.tab("alone"), alone)

    def test_it_is_heard_without_joints_and_soon(self):
        self.click("#string-alone")
        self.click("#string-sound")
        self.until("return feltgate.string.sound && feltgate.string.sound.played > 40000")
        waits = self.js("const s = feltgate.string.sound; return s.next - s.audio.currentTime")
        self.assertLess(waits, 0.2)
        self.click("#string-sound")
        self.until("return feltgate.string.sound.audio.state === 'suspended'")


if __name__ == "__main__":
    unittest.main()
