#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's knob in Debian's Chromium: detents against closed forms, the legs' voltages against
the electrical angle, wrong offsets, the mouse, a narrow screen.

knob_tab_test.py --pictures FOLDER keeps screenshots, --speed prints the real-time factor.
Documentation: docs/page.md
"""

import cmath
import math
import time

from browsing import ActionChains, By, Keys, PageTest, main, opened

HAND_NM_RAD = 135 * 0.02**2
DETENT_NM_RAD = 0.012 / 0.1
FRICTION_NM = 0.65e-3
LOST_NM = 5e-4  # what dead times take beyond what the core gives back
REST_RAD = 0.014  # friction, and what the dead times take from a torque that is as small
TURN = 2 * math.pi


class Knob(PageTest):
    def setUp(self):
        super().setUp()
        self.open_tab("knob")
        self.until("return !!feltgate.knob")
        self.unfold()

    def choose(self, name, value):
        self.js(
            "const e = document.getElementById(arguments[0]);"
            "e.value = arguments[1]; e.dispatchEvent(new Event('input'))",
            f"knob-{name}",
            value,
        )

    def passed(self, seconds):
        begin = self.js("return feltgate.knob.seen.time")
        self.until("return feltgate.knob.seen.time > arguments[0]", begin + seconds)
        return self.js("return feltgate.knob.seen")

    def led(self, rad, seconds=1.5):
        """The state when the hand has come to rest there."""
        self.js("feltgate.knob.take(true); feltgate.knob.aim(arguments[0])", rad)
        return self.passed(seconds)

    def test_hand_and_detent_balance_and_the_legs_make_the_angle(self):
        for lead in (0.2, -0.15, 0.1):
            seen = self.led(lead)
            rest = lead * HAND_NM_RAD / (HAND_NM_RAD + DETENT_NM_RAD)
            margin = (FRICTION_NM + LOST_NM) / (HAND_NM_RAD + DETENT_NM_RAD) + 5e-4
            self.assertAlmostEqual(seen["theta"], rest, delta=margin)
            self.assertAlmostEqual(seen["asked"], -DETENT_NM_RAD * seen["theta"], delta=1e-4)
            self.assertAlmostEqual(seen["torque"], seen["asked"], delta=LOST_NM)
            # Eleven electrical turns in one of the shaft, to a count of 0.24 degrees.
            angle = cmath.exp(1j * TURN * seen["electrical"])
            off = cmath.phase(angle * cmath.exp(-11j * seen["theta"]))
            self.assertAlmostEqual(off, 0, delta=5e-3)
            mean = sum(seen["on"]) / 3
            legs = enumerate(seen["on"])
            vector = sum((on - mean) * cmath.exp(1j * TURN * n / 3) for n, on in legs)
            sign = -1 if seen["asked"] < 0 else 1
            off = cmath.phase(sign * vector / angle)
            self.assertAlmostEqual(off, 0, delta=math.radians(2))
            # An amplitude of the whole period is 1/sqrt(3) of the supply.
            length = abs(vector) * 2 / 3 * math.sqrt(3)
            self.assertAlmostEqual(length, abs(seen["amplitude"]) / 1000, delta=1.2e-3)
        face = self.driver.find_element(By.ID, "knob-face").text
        self.assertAlmostEqual(float(face.split(" N")[0]), abs(seen["torque"]) / 0.02, delta=0.02)
        caption = self.driver.find_element(By.CSS_SELECTOR, "#knob-stage .equation").text
        self.assertIn("e = pole pairs · θ + offset = 11 ·", caption)

    def test_the_mouse_turns_it_from_detent_to_detent(self):
        face = self.driver.find_element(By.ID, "knob-face")
        size = face.size["height"] / 400
        actions = ActionChains(self.driver, duration=60)
        actions.move_to_element_with_offset(face, 0, round(-140 * size)).click_and_hold()
        for k in range(1, 13):
            rad = k * 1.5 / 12
            x, y = 140 * size * math.sin(rad), -140 * size * math.cos(rad)
            actions.move_to_element_with_offset(face, round(x), round(y))
        actions.perform()
        lead = self.js("return feltgate.knob.lead")
        self.assertAlmostEqual(lead, 1.5, delta=0.05)
        self.passed(1)
        self.assertTrue(self.js("return feltgate.knob.held"))
        ActionChains(self.driver).release().perform()
        seen = self.passed(2)
        self.assertFalse(self.js("return feltgate.knob.held"))
        self.assertAlmostEqual(seen["detent"] / 0.5, round(seen["detent"] / 0.5), delta=0.002)
        self.assertGreater(seen["detent"], 0.9)
        self.assertAlmostEqual(seen["theta"], seen["detent"], delta=REST_RAD)
        before = self.js("return feltgate.knob.lead")
        face.send_keys(Keys.ARROW_RIGHT * 3)
        self.assertTrue(self.js("return feltgate.knob.held"))
        self.assertNotEqual(self.js("return feltgate.knob.lead"), before)
        face.send_keys(" ")
        self.assertFalse(self.js("return feltgate.knob.held"))

    def test_a_wrong_offset_is_seen(self):
        said = self.driver.find_element(By.ID, "knob-said")
        for degrees in (0, 60, 90, 180):
            self.js("feltgate.knob.take(false)")
            self.choose("offset", degrees)
            seen = self.led(self.js("return feltgate.knob.seen.detent") + 0.15, 1)
            self.assertAlmostEqual(seen["offset"], degrees / 360, delta=1e-9)
            expected = seen["asked"] * math.cos(math.radians(degrees))
            self.assertAlmostEqual(seen["torque"], expected, delta=1.3e-3, msg=degrees)
            self.assertGreater(abs(seen["asked"]), 2e-3)
            self.assertEqual("self-test" in said.text, degrees >= 90)
            shown = self.js("return document.querySelectorAll('#knob-dial .believed').length")
            self.assertEqual(shown > 0, degrees > 0)
        self.js("feltgate.knob.take(false)")
        seen = self.passed(0.6)
        self.assertGreater(abs(seen["theta"] - seen["detent"]), 0.15)  # on a crest
        self.choose("offset", 0)
        seen = self.passed(2)
        self.assertLess(abs(seen["theta"] - seen["detent"]), REST_RAD)

    def test_without_the_motor_and_on_a_narrow_screen(self):
        self.driver.find_element(By.ID, "knob-armed").click()
        seen = self.led(0.4)
        self.assertFalse(seen["gates"])
        self.assertAlmostEqual(seen["theta"], 0.4, delta=FRICTION_NM / HAND_NM_RAD + 1e-3)
        self.assertIn("motor off", self.driver.find_element(By.ID, "knob-dial").text)
        self.driver.set_window_size(390, 844)
        self.addCleanup(self.driver.set_window_size, 1400, 1300)
        wide = self.js("return [document.documentElement.scrollWidth, innerWidth]")
        self.assertLessEqual(wide[0], wide[1])
        for name in ("knob-face", "knob-dial"):
            self.assertGreater(self.driver.find_element(By.ID, name).size["width"], 250)


RIGHT = "const o = document.getElementById('knob-offset'); o.value = 0; o.oninput();"
VIEWS = {
    "knob": "feltgate.knob.take(true); feltgate.knob.aim(0.2)",
    "knob_wrong": "const e = document.getElementById('knob-offset'); e.value = 180; e.oninput();"
    "feltgate.knob.take(false)",
}


def pictures(folder):
    """Held beside a detent, and with the offset wrong by half a turn; wide, and narrow and dark."""
    driver = opened()
    driver.execute_script("document.getElementById('tab-knob').click()")
    for width, height in ((1280, 1000), (390, 1500)):
        driver.set_window_size(width, height)
        for name, script in VIEWS.items():
            driver.execute_script(RIGHT + script)
            time.sleep(3)
            driver.save_screenshot(str(folder / f"{name}_{width}.png"))
        driver.execute_script("document.getElementById('theme').click()")
        print(width, driver.find_element(By.ID, "speed").text)
    driver.quit()


def measure():
    driver = opened()
    driver.execute_script("document.getElementById('tab-knob').click(); feltgate.knob.take(true)")
    for k in range(20):
        driver.execute_script("feltgate.knob.aim(arguments[0])", k % 4)
        time.sleep(0.5)
    frames = driver.execute_script("return feltgate.frames")
    gaps = sorted(b - a for a, b in zip(frames, frames[1:], strict=False))
    speed = driver.execute_script("return feltgate.speed")
    rate = 1000 / gaps[len(gaps) // 2]
    print(f"knob: median {rate:.0f} frames a second, {speed:.1f} times real time")
    driver.quit()


if __name__ == "__main__":
    main(pictures, measure)
