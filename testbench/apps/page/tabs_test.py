#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's pantograph, its guessing game, its drums, materials and two levers, in Chromium.

tabs_test.py --pictures FOLDER keeps screenshots.
Documentation: docs/page.md
"""

import csv
import io
import math
from urllib.parse import unquote

from browsing import ActionChains, By, Keys, PageTest, main, taking


class Pantograph(PageTest):
    def open_pantograph(self, mode="try"):
        self.open_tab("pantograph")
        self.until("return !!feltgate.pantograph")
        self.unfold()
        self.driver.find_element(By.CSS_SELECTOR, f"#pen-modes input[value={mode}]").click()

    def pen(self):
        return self.js("return feltgate.pantograph.stage.seen")

    def settled(self, seconds=1.5):
        """The pen's state when the hand's swinging, e^(-5.8 t), is over."""
        begin = self.pen()["time"]
        self.until("return feltgate.pantograph.stage.seen.time > arguments[0]", begin + seconds)
        return self.pen()

    def point(self, *places):
        """The mouse goes to these places, m, as the stage draws them."""
        stage = self.driver.find_element(By.CSS_SELECTOR, "#pen-stage svg")
        actions = ActionChains(self.driver, duration=50)
        for place in places:
            at = self.js(
                "const b = arguments[0].getBoundingClientRect(),"
                "size = Math.min(b.width / STAGE.width, b.height / STAGE.height);"
                "const [x, y] = to_stage(...arguments[1]);"
                "return [(x - STAGE.width / 2) * size, (y - STAGE.height / 2) * size]",
                stage,
                place,
            )
            actions.move_to_element_with_offset(stage, round(at[0]), round(at[1]))
        actions.perform()

    def assert_held(self, face_m, sign, stiffness):
        """The force of a face at x against the hand: K d = 135 N/m (lead - d), to a count."""
        lead = sign * (face_m - self.js("return feltgate.pantograph.stage.lead[0]"))
        depth = lead * 135 / (135 + stiffness)
        self.assertGreater(lead, 0.004)
        seen = self.settled()
        count_n = stiffness * 160e-6
        self.assertAlmostEqual(sign * (face_m - seen["x"]), depth, delta=160e-6)
        self.assertAlmostEqual(sign * seen["force_x"], stiffness * depth, delta=count_n)
        self.assertAlmostEqual(seen["force_y"], 0, delta=count_n)

    def test_the_pen_goes_into_a_square(self):
        self.open_pantograph()
        self.assertFalse(self.driver.find_element(By.ID, "lever").is_displayed())
        self.js("feltgate.pantograph.stage.place(0.05, 0.12)")
        self.point((0.05, 0.12), (0.04, 0.12), (0.02, 0.12))
        self.assert_held(0.03, 1, 50)
        self.js("const s = document.getElementById('pen-stiffness'); s.value = 200; s.oninput()")
        self.assert_held(0.03, 1, 200)
        caption = self.driver.find_element(By.CSS_SELECTOR, "#pen-stage .equation").text
        self.assertRegex(caption, r"F = 0\.[78]\d N .* 76\.9 kHz")
        outlines = "return document.querySelectorAll('#pen-stage .outline').length"
        self.assertEqual(self.js(outlines), 1)
        self.driver.find_element(By.ID, "pen-outline").click()
        self.until("return document.querySelectorAll('#pen-stage .outline').length === 0")
        stage = self.driver.find_element(By.CSS_SELECTOR, "#pen-stage svg")
        before = self.js("return feltgate.pantograph.stage.lead")
        stage.send_keys(Keys.ARROW_LEFT * 3 + Keys.ARROW_UP)
        after = self.js("return feltgate.pantograph.stage.lead")
        self.assertAlmostEqual(after[0] - before[0], -0.003)
        self.assertAlmostEqual(after[1] - before[1], 0.001)
        # The lever goes on where it was.
        self.open_tab("lever")
        begin = self.js("return feltgate.devices[0].now.time")
        self.until("return feltgate.devices[0].now.time > arguments[0]", begin + 0.1)

    def test_training_squares(self):
        self.open_pantograph("training")
        # Drawn with the next frame.
        labels = self.until(
            "const all = [...document.querySelectorAll('#pen-stage .label')]"
            ".map(t => t.textContent);"
            "return all.length === 8 && all"
        )
        self.assertEqual(labels.count("high stiffness"), 2)
        self.assertEqual(labels.count("low damping"), 2)
        places = ((-1, 0.142, 50), (1, 0.142, 50), (-1, 0.088, 30), (1, 0.088, 30))
        for sign, y, stiffness in places:
            self.js("feltgate.pantograph.stage.place(...arguments[0])", [sign * 0.07, y])
            self.settled(0.1)
            self.js("feltgate.pantograph.stage.aim(...arguments[0])", [sign * 0.042, y])
            self.assert_held(sign * 0.05, sign, stiffness)

    def guess(self, name):
        for button in self.driver.find_elements(By.CSS_SELECTOR, "#game-names button"):
            if button.text == name:
                button.click()

    def test_a_guess_is_counted_and_exported(self):
        self.js("localStorage.clear()")
        self.open_pantograph("game")
        shapes = self.js("return feltgate.pantograph.game.names")
        self.assertEqual(len(shapes), 7)
        shown = "return document.querySelectorAll('#pen-stage .outline').length"
        self.settled(0.1)
        self.until(f"{shown} === 0")
        first = self.js("return feltgate.pantograph.game.shape")
        self.js("feltgate.pantograph.stage.aim(0.02, 0.1)")
        self.guess(first)
        self.until(f"{shown} === 1")
        self.assertIn("Right", self.driver.find_element(By.ID, "game-said").text)
        for cue in ("cue-stiffness", "cue-damping"):
            self.driver.find_element(By.ID, cue).click()
        self.driver.find_element(By.ID, "game-next").click()
        second = self.js("return feltgate.pantograph.game.shape")
        self.until(f"{shown} === 0")
        # Something else in between does not change what is hidden.
        for mode in ("training", "game"):
            self.driver.find_element(By.CSS_SELECTOR, f"#pen-modes input[value={mode}]").click()
            self.settled(0.1)
        self.assertEqual(self.js("return feltgate.pantograph.stage.loaded.name"), second)
        self.until(f"{shown} === 0")
        self.assertNotEqual(second, first)
        wrong = next(name for name in shapes if name != second)
        self.guess(wrong)
        self.guess(second)  # too late
        shares = self.driver.find_element(By.ID, "game-shares").text
        self.assertIn("none 1 100.0 %", shares)
        self.assertIn("both 1 0.0 %", shares)
        self.assertIn("all of yours 2 50.0 %", shares)
        self.assertIn("people at the device 70 74.3 %", shares)
        self.assertIn("chance 14.3 %", shares)
        cell = (
            "return document.getElementById('game-confusion')"
            ".rows[arguments[0] + 1].cells[arguments[1] + 1].textContent"
        )
        self.assertEqual(self.js(cell, shapes.index(second), shapes.index(wrong)), "1")
        self.assertEqual(self.js(cell, shapes.index(first), shapes.index(first)), "1")
        link = self.driver.find_element(By.ID, "game-export").get_attribute("href")
        kind, _, text = link.partition(",")
        self.assertEqual(kind, "data:text/csv;charset=utf-8")
        rows = list(csv.DictReader(io.StringIO(unquote(text))))
        self.assertEqual([r["shape"] for r in rows], [first, second])
        self.assertEqual([r["right"] for r in rows], ["true", "false"])
        self.assertEqual(rows[1]["guess"], wrong)
        self.assertEqual([r["stiffness_cue"] for r in rows], ["false", "true"])
        # Kept, until they are forgotten; without a place to keep them it says so and goes on.
        self.setUp()
        self.open_pantograph("game")
        kept = "return feltgate.pantograph.game.guesses.length"
        self.assertEqual(self.js(kept), 2)
        self.driver.find_element(By.ID, "game-forget").click()
        self.assertEqual(self.js(kept), 0)
        self.js("Storage.prototype.setItem = () => { throw new Error('full'); }")
        self.guess(wrong)
        self.assertEqual(self.js(kept), 1)
        self.assertIn("keeps nothing", self.driver.find_element(By.ID, "game-kept").text)


class Materials(PageTest):
    def test_a_hand_rests_in_two_materials(self):
        self.open_tab("materials")
        self.until("return !!feltgate.materials")
        self.unfold()
        stage = self.driver.find_element(By.CSS_SELECTOR, "#materials-stages svg")
        stage.send_keys(Keys.ARROW_RIGHT)
        self.assertAlmostEqual(self.js("return feltgate.materials.lead"), 0.02)
        for left, right in (("stone", "fabric"), ("water", "stone")):
            for n, name in enumerate((left, right)):
                self.js(
                    "const s = document.getElementById(arguments[0]);"
                    "s.value = arguments[1]; s.oninput()",
                    f"material-{n}",
                    name,
                )
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
        stiffness = 1.35 + 4 * values["hardness"]
        vibration = values.get("vibration", 0)
        most_nm = values.get("load", 0) * values.get("static", 0) + vibration
        self.assertGreater(depth, (1.35 * 0.15 - most_nm) / stiffness - 0.0016, values)
        self.assertLess(depth, (1.35 * 0.15 + most_nm) / stiffness + 0.0016, values)
        tremble = max(trace) - min(trace)
        if vibration:
            self.assertGreater(tremble, 1.5 * vibration)
        else:
            self.assertLess(tremble, 0.01)


class Coupled(PageTest):
    def at_rest(self, lead):
        """Means over a second, when the hand's swinging is over."""
        self.js("feltgate.coupled.aim(arguments[0])", lead)
        begin = self.js("return feltgate.coupled.seen.time")
        self.until("return feltgate.coupled.seen.time > arguments[0]", begin + 2.5)
        return self.js("return feltgate.coupled.seen")

    def choose(self, place, value):
        self.js(
            "const e = document.querySelector(arguments[0]);"
            "e.value = arguments[1]; e.dispatchEvent(new Event('input'))",
            place,
            value,
        )

    def test_a_spring_is_felt_through_the_law(self):
        self.open_tab("coupled")
        self.until("return !!feltgate.coupled")
        self.unfold()
        self.assertEqual(self.js("return feltgate.coupled.met"), "spring")
        count, hand, k, coupling = 2 * math.pi / 4096, 1.35, 1, 4
        for n, share in enumerate((0, 1)):
            self.choose("#coupled-law label:nth-of-type(3) input", share)
            self.assertEqual(self.js("return feltgate.coupled.values.share"), share)
            seen = self.at_rest(0.5)
            felt = k * coupling / (coupling + (1 - share) * k)
            theta = hand * 0.5 / (hand + felt)
            self.assertAlmostEqual(seen["theta"][0], theta, delta=3 * count, msg=n)
            self.assertAlmostEqual(seen["theta"][1], felt / k * theta, delta=3 * count, msg=n)
            self.assertAlmostEqual(seen["met"], -k * seen["theta"][1], delta=1e-9, msg=n)
            told = self.driver.find_element(By.CSS_SELECTOR, "#coupled-stages figure").text
            self.assertIn(f"{felt:.2f} Nm/rad of k = 1.00", told)
        # From the other side, and with nothing in the way.
        self.choose("#coupled-met", "nothing")
        second = self.driver.find_elements(By.CSS_SELECTOR, "#coupled-stages svg")[1]
        second.send_keys(Keys.ARROW_LEFT)
        self.assertEqual(self.js("return feltgate.coupled.held"), 1)
        self.assertEqual(self.js("return feltgate.coupled.values.share"), 0)
        seen = self.at_rest(-0.2)
        for angle in seen["theta"]:
            self.assertAlmostEqual(angle, -0.2, delta=2 * count)
        self.assertEqual(seen["met"], 0)
        # The observer wants the hand on the first lever.
        self.choose("#coupled-law label:nth-of-type(3) input", 0.8)
        self.assertEqual(self.js("return feltgate.coupled.held"), 0)


class Gimbal(PageTest):
    def test_the_body_follows_the_hand_and_swings_on(self):
        self.open_tab("gimbal")
        self.until("return !!feltgate.gimbal")
        picture = self.driver.find_element(By.CSS_SELECTOR, "#gimbal-stage svg")
        for key in (Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_UP, Keys.PAGE_UP):
            picture.send_keys(key)
        begin = self.js("return feltgate.gimbal.seen.time")
        self.until("return feltgate.gimbal.seen.time > arguments[0]", begin + 2.5)
        seen = self.js("return feltgate.gimbal.seen")
        # The rotations one after the other, about the picture's up, right and line of sight.
        axes = self.js("return [GIMBAL_VIEW.up, GIMBAL_VIEW.right, GIMBAL_VIEW.out]")
        wanted = (1, 0, 0, 0)
        for axis, degrees in ((0, 5), (0, 5), (1, -5), (2, 5)):
            wanted = times(about(axes[axis], math.radians(degrees)), wanted)
        for name in ("hand", "handle", "body"):
            same = abs(sum(a * b for a, b in zip(seen[name], wanted)))
            self.assertGreater(same, 1 - 2e-5, name)  # within 0.7 degrees
        self.assertLess(seen["twist"], 0.01)
        # A drag at once leaves the body behind, and the torque pulls the handle back to it.
        ActionChains(self.driver, duration=20).drag_and_drop_by_offset(picture, 150, 0).perform()
        most = self.js("return Math.max(...feltgate.gimbal.trace.flat().map(Math.abs))")
        self.assertGreater(most, 10)
        self.assertLessEqual(most, 100.1)
        self.assertIn("31.6 rad/s", self.driver.find_element(By.ID, "gimbal-stage").text)
        self.js(
            "const e = document.getElementById('gimbal-law-inertia');"
            "e.value = 0.4; e.dispatchEvent(new Event('input'))"
        )
        self.until(
            "return document.getElementById('gimbal-stage').textContent.includes('15.8 rad/s')"
        )


def about(axis, rad):
    return (math.cos(rad / 2), *(math.sin(rad / 2) * part for part in axis))


def times(a, b):
    """First b, then a, written out."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def fastest_m_s():
    """Of the tip, in a hand that wants to be 0.6 rad lower at once; later is slower."""
    damping, stiffness, mass = 6.45, 135, 0.554
    a = damping / mass / 2
    w = math.sqrt(stiffness / mass - a * a)
    times = [k * 1e-4 for k in range(2000)]
    left = [math.exp(-a * t) * (math.cos(w * t) - a / w * math.sin(w * t)) for t in times]
    return 0.3 * 0.6 * max((p - q) / 1e-4 for p, q in zip(left, left[1:], strict=False))


class Drums(PageTest):
    def test_drums_are_hit_and_heard(self):
        self.open_tab("drums")
        self.until("return !!feltgate.drums")
        self.unfold()
        self.driver.find_element(By.ID, "drums-sound").click()
        self.until("return feltgate.drums.audio.state === 'running'")
        stage = self.driver.find_element(By.CSS_SELECTOR, "#drums-stage svg")
        for drum, across in ((1, -0.36), (2, 0.06), (3, 0.3)):
            self.js("feltgate.drums.aim(arguments[0], 0.3)", across)
            begin = self.js("return feltgate.drums.seen.time")
            self.until("return feltgate.drums.seen.time > arguments[0]", begin + 1.5)  # at rest
            hits = self.js("return feltgate.drums.hits.length")
            stage.send_keys(" ")
            self.until("return feltgate.drums.hits.length > arguments[0]", hits)
            hit = self.js("return feltgate.drums.hits[arguments[0]]", hits)
            self.assertEqual(hit["drum"], drum)
            self.assertAlmostEqual(hit["place"], abs(across - 0.3 * (drum - 2)) / 0.12, delta=0.01)
            self.assertGreater(hit["speed"], 0.3)
            self.assertLess(hit["speed"], 1.01 * fastest_m_s())
        self.assertEqual(
            self.js("return feltgate.drums.played"), self.js("return feltgate.drums.hits.length")
        )
        said = self.driver.find_element(By.ID, "drums-hits").text
        self.assertIn("drum 3", said.splitlines()[0])
        # Loudness goes with the speed, the sustain with the distance from the middle.
        peak = "return Math.max(...drum_samples(2, arguments[0], 0, 44100))"
        self.assertAlmostEqual(self.js(peak, 3) / self.js(peak, 1), 3, places=4)
        length = "return drum_samples(2, 1, arguments[0], 44100).length / 44100"
        self.assertAlmostEqual(self.js(length, 0) - self.js(length, 0.5), 0.2, places=3)
        self.driver.find_element(By.ID, "drums-sound").click()
        self.until("return feltgate.drums.audio.state === 'suspended'")


# A square pressed, the training screen, and a round of the game in the dark; drums.
VIEWS = {
    "pen": "document.getElementById('tab-pantograph').click();"
    "feltgate.pantograph.stage.place(0.05, 0.12); feltgate.pantograph.stage.aim(0.02, 0.125)",
    "pen_training": "document.querySelector('#pen-modes input[value=training]').click();"
    "feltgate.pantograph.stage.place(0.07, 0.1); feltgate.pantograph.stage.aim(0.03, 0.1)",
    "pen_game": "document.querySelector('#pen-modes input[value=game]').click();"
    "document.getElementById('theme').click();"
    "feltgate.pantograph.stage.aim(0.01, 0.105)",
    "pen_guessed": "document.querySelector('#game-names button').click()",
    "drums": "document.getElementById('theme').click();"
    "document.getElementById('tab-drums').click(); feltgate.drums.aim(0.05, -0.2)",
    "materials": "document.getElementById('tab-materials').click();"
    "feltgate.materials.aim(0.55)",
    "coupled": "document.getElementById('tab-coupled').click(); feltgate.coupled.aim(0.5)",
}


if __name__ == "__main__":
    main(taking(VIEWS))
