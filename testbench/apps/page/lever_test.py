#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's lever in Chromium: the same bits, dragging, keys, scenes, laws, faults, the border of
stability. Documentation: docs/page.md
"""

import math
import os
import unittest

from browsing import ARMED, BOX, NOW, ActionChains, Keys, LeverTest
from testing import weekly

WHOLE = "FELTGATE_WHOLE" in os.environ  # every scene, not one of them
FAULTS = "return feltgate.devices[0].status.faults"
LEAST, MOST = 0.5, 60  # Nm/rad, of the slider of the stiffness


class Lever(LeverTest):
    def setUp(self):
        """Unfolded, the lever at rest at 0, and nobody's hand there that shows how."""
        super().setUp()
        self.js("feltgate.devices[0].take(false); place_devices()")
        self.unfold()
        self.until(f"return {NOW}.time > 0.02")

    def test_same_bits(self):
        self.js("window.requestAnimationFrame = () => 0")  # the lever rests, the worker computes
        self.click("#check")
        self.until("return feltgate.done")
        compared = self.js("return feltgate.compared")
        self.assertGreaterEqual(len(compared), 12)
        for one in compared:
            self.assertTrue(one["same"], one)
        scenes = [(one["design"], one["scene"]) for one in compared]
        self.assertIn(("planes of a stroke", "knob"), scenes)
        self.assertEqual(self.count("#hashes .same"), len(compared))

    def test_drag_into_the_wall(self):
        actions = self.actions("#stages svg", (250, 164)).click_and_hold()
        for offset in ((0, -120), (90, 10), (90, 20), (90, 30)):
            actions.move_by_offset(*offset)
        actions.perform()
        self.until("return feltgate.devices[0].lead > 0.55")
        state = self.passed(NOW, 1.5)
        lead = self.js("return feltgate.devices[0].lead")
        self.assertLess(state["theta"], lead - 0.03)  # held back
        self.assertGreater(state["theta"], 0.49)
        self.assertLess(state["torque"], -0.05)
        ActionChains(self.driver).release().perform()
        self.assertLess(self.passed(NOW, 0.5)["theta"], 0.52)
        self.assertFalse(self.js("return feltgate.devices[0].held"))

    def moved(self, seconds, lead, held="true"):
        """Frames of a mouse at `lead`, a formula of k, without waiting for the screen."""
        for begin in range(0, 60 * seconds, 240):
            faults = self.js(
                f"const d = feltgate.devices[0];"
                f"for (let k = {begin}; k < {begin + 240}; ++k) {{"
                f"  if (d.held !== ({held})) d.take({held});"
                f"  d.aim({lead}); d.advance(16667);"
                f"}} return d.status.faults"
            )
            self.assertEqual(faults, "", f"{lead} after {begin / 60} s")

    @weekly(4)
    def test_a_minute_at_the_mouse_brings_no_fault(self):
        """A third of it in a usual run."""
        scenes, part = self.js("return Object.keys(SCENES).filter(name => name !== 'law')"), 1 if WHOLE else 3
        for scene in scenes if WHOLE else scenes[-1:]:
            with self.subTest(scene=scene):
                self.choose(scene)
                self.js("feltgate.devices[0].take(false); feltgate.devices[0].recover()")
                self.until(ARMED)
                self.moved(24 // part, "Math.min(1.45, k / 60)")
                if scene == "wall":
                    self.assertLess(self.now()["theta"], 0.6)
                    self.assertLess(self.now()["torque"], -0.05)
                self.moved(18 // part, "0.75 + 0.75 * Math.sin(k / 10)")
                self.moved(18 // part, "1.4 * Math.sin(k / 13) * Math.sin(k / 47)", "k % 90 < 60")

    def test_a_fault_shows_at_the_handle_and_one_button_recovers(self):
        self.assertFalse(self.one(".alarm").is_displayed())
        colour = "return getComputedStyle(document.querySelector(arguments[0]))[arguments[1]]"
        self.hold()
        self.click("#stop")
        self.until("return !document.querySelector('.alarm').hidden")
        self.assertIn("fault: stop", self.text(".state"))
        self.assertIn("The motor is off", self.one(".alarm").text)
        self.assertIn("faulted", self.one("#stages svg").get_attribute("class"))
        red = self.js(colour, ".alarm", "color")
        self.assertEqual(self.js(colour, ".knob", "fill"), red)
        self.click(".alarm button")
        self.until(ARMED)
        self.passed(NOW, 0.2)
        self.assertEqual(self.js(FAULTS), "")
        self.assertFalse(self.one(".alarm").is_displayed())
        self.assertNotEqual(self.js(colour, ".knob", "fill"), red)

    def test_keys(self):
        stage = self.one("#stages svg")
        stage.send_keys(Keys.ARROW_RIGHT * 10)
        self.until("return feltgate.devices[0].held && feltgate.devices[0].lead > 0.15")
        self.until(f"return {NOW}.theta > 0.1")
        self.assertAlmostEqual(float(stage.get_attribute("aria-valuenow")), 0.2, delta=0.1)
        stage.send_keys(" ")
        self.until("return !feltgate.devices[0].held")
        stage.send_keys("s")
        self.until("return !feltgate.devices[0].status.armed")
        self.assertIn("stop", self.js(FAULTS))
        stage.send_keys("s")
        stage.send_keys("c")
        self.until("return feltgate.devices[0].status.faults === ''")
        stage.send_keys("a")
        self.until(ARMED)

    def test_every_scene_is_drawn(self):
        for scene in self.js("return Object.keys(SCENES)"):
            self.choose(scene)
            self.passed(NOW, 0.02)
            equation = self.text(".equation")
            self.assertIn("τ", equation)
            self.assertNotIn("?", equation, scene)
            self.assertNotIn("NaN", self.one("#stages svg").get_attribute("innerHTML"), scene)

    def test_a_law_is_written_and_felt(self):
        self.choose("law")
        self.until("return document.getElementById('law-table').textContent.includes('bound')")
        self.until(ARMED)
        self.assertEqual(self.js("return feltgate.devices[0].info.name"), "lever_law")
        # An error is told below the text, and a mark is under its word; the law before is felt.
        self.turn("#law-text", "# mine\nout torque = -0.2 Nm * sin(8 * postion)\n")
        self.until("return !document.getElementById('law-error').hidden")
        self.assertRegex(self.text("#law-error"), r"2:32: .*postion.*position")
        self.assertTrue(self.js(ARMED))
        text, said, mark = (self.js(BOX, f"#law-{what}") for what in ("text", "error", "mark"))
        self.assertGreaterEqual(said["top"], text["bottom"] - 0.5)
        self.assertLess(mark["height"], 4)
        self.assertAlmostEqual(mark["top"] - text["top"], 8 + 2 * 20 - 2, delta=2)
        # Another law, without the error: at rest against a hand the torque is the law's.
        text = "param strength = 0.2 Nm in 0 .. 0.4 Nm\nout torque = -strength * sin(8 * position)\n"
        self.turn("#law-text", text)
        self.until("return document.getElementById('law-error').hidden")
        self.until("return feltgate.law.includes('strength')")
        self.until(ARMED)
        self.hold(0.1)
        for seconds, strength in ((1, 0.2), (0.5, 0.1)):
            now = self.passed(NOW, seconds)
            self.assertGreater(abs(now["tau_ref"]), 0.025)
            asked = -strength * math.sin(8 * now["position"])
            self.assertAlmostEqual(now["tau_ref"], asked, delta=0.01)
            self.turn("#sliders input", 250)
        curve = self.js("return Array.from(feltgate.devices[0].turn)")
        self.assertAlmostEqual(max(curve), 0.1, 2)
        # Back to a scene in hardware, on its own design.
        self.choose("wall")
        self.until("return feltgate.devices[0].info.name === 'lever'")
        self.assertFalse(self.one("#law").is_displayed())

    def test_what_is_broken_is_told_and_shown(self):
        weak = f"const n = {NOW}; return n.tau_ref < -0.3 && n.torque / n.tau_ref < 0.4"
        for broken, shown in enumerate(("channel", "polarity", "polarity", "weak"), 1):
            self.turn("#break", broken)
            self.assertIn("no fault" if shown == "weak" else f"fault {shown}", self.text("#expect"))
            if shown == "weak":
                self.until(weak)
            else:
                self.assertEqual(self.until(FAULTS), shown)
                self.until("return document.getElementById('expect').innerText.includes('Now: fault')")
            self.js("recover()")
            self.until(ARMED)
        self.assertEqual(self.text("#expect"), "")

    def test_side_by_side(self):
        self.turn("#second", "paper")
        self.until("return feltgate.devices.length === 2 && feltgate.devices[1].now.time > 0.1")
        self.assertEqual(self.count("#stages svg"), 2)


class Border(LeverTest):
    def setUp(self):
        super().setUp()
        self.unfold()
        self.turn("#plant", "linear")

    def test_beyond_it_the_wall_is_said_to_shake(self):
        verdict = "const v = document.getElementById('verdict'); return !feltgate.asking &&"
        for ticks, stable, shakes in ((1000, 5, 6.5), (1, 15, 20)):
            self.turn("#sliders select", ticks)
            for stiffness, said in ((stable, ""), (shakes, "shakes")):
                at = 1000 * math.log(stiffness / LEAST) / math.log(MOST / LEAST)
                self.turn("#sliders input[aria-label^='stiffness']", at)
                self.until(f"{verdict} v.textContent && v.className === arguments[0]", said)
        self.assertRegex(self.text("#verdict"), r"border is 17\.\d Nm/rad")
        border = self.js("return feltgate.shown_borders[0].stiffness_nm_rad")
        mark, track = self.js(BOX, ".track i"), self.js(BOX, ".track input")
        share = (mark["left"] - track["left"] - 8) / (track["width"] - 16)
        wanted = math.log(border / LEAST) / math.log(MOST / LEAST)
        self.assertAlmostEqual(share, wanted, delta=1.5 / (track["width"] - 16))
        self.turn("#second", "paper")
        self.until("return document.querySelectorAll('.track i').length === 2")
        self.choose("free")
        self.assertEqual(self.count(".track i"), 0)


if __name__ == "__main__":
    unittest.main()
