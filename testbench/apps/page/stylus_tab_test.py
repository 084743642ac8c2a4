#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's stylus in Debian's Chromium: at rest on plane and sphere, and stroking the sphere.

stylus_tab_test.py --pictures FOLDER keeps screenshots.
Documentation: docs/page.md
"""

import math
import time

from browsing import ActionChains, By, Keys, PageTest, main, opened

HAND_N_M = 135
COUNT_M = 15.4e-6

# Leads the hand around the sphere at 22 mm, `rad_s`, by the tab's own frames; keeps what is seen.
STROKE = """
const [rad_s, seconds] = arguments, tab = feltgate.stylus, begin = tab.seen.time;
const frame = tab.frame.bind(tab);
tab.rows = [];
tab.frame = (passed) => {
  const t = tab.seen.time - begin + passed;
  if (t > seconds) { tab.frame = frame; tab.stroked = true; return; }
  tab.aim(0.022 * Math.sin(rad_s * t), 0, 0.022 * Math.cos(rad_s * t));
  frame(passed);
  tab.rows.push(tab.seen);
};
tab.stroked = false;
"""


class Stylus(PageTest):
    def open(self, **controls):
        self.open_tab("stylus")
        self.until("return !!feltgate.stylus")
        self.unfold()
        for name, value in controls.items():
            self.turn(name, value)

    def turn(self, name, value):
        self.js(
            "const e = document.getElementById(arguments[0]);"
            "e.value = arguments[1]; e.dispatchEvent(new Event('input'))",
            f"stylus-{name}",
            value,
        )

    def place(self, pen_m, lead_m):
        """The pen at rest there, and its hand led on at once."""
        self.js(
            "const tab = feltgate.stylus; tab.pen.place(...arguments[0]);"
            "tab.led = arguments[1]; tab.aim(...arguments[1])",
            pen_m,
            lead_m,
        )

    def settled(self, seconds=2.5):
        """The state when the hand's swinging, e^(-5.4 t), is over."""
        begin = self.js("return feltgate.stylus.seen.time")
        self.until("return feltgate.stylus.seen.time > arguments[0]", begin + seconds)
        return self.js("return feltgate.stylus.seen")

    def assert_rests(self, lead_m, stiffness, direction):
        """Hand against wall: K d = 135 N/m (lead - d), to a count along each axis."""
        seen = self.settled()
        depth = lead_m * HAND_N_M / (HAND_N_M + stiffness)
        self.assertAlmostEqual(seen["depth"], depth, delta=1.8 * COUNT_M)
        for part, along in zip(seen["force"], direction, strict=True):
            expected = stiffness * depth * along
            self.assertAlmostEqual(part, expected, delta=1.8 * stiffness * COUNT_M + 1e-3)

    def test_at_rest_the_springs_of_hand_and_plane_are_equal(self):
        self.open(world="floor", stiffness=206, rate=50, age=2)
        slides = self.js("return feltgate.numbers.stylus.slides")
        self.assertAlmostEqual(slides["mass_kg"], 0.045)
        self.js("feltgate.stylus.aim(0.01, -0.02, -0.03)")
        self.assert_rests(0.03, 206, (0, 0, 1))
        self.turn("stiffness", 800)
        self.turn("rate", 0)
        self.js("feltgate.stylus.aim(0.01, -0.02, -0.02)")
        self.assert_rests(0.02, 800, (0, 0, 1))
        caption = self.driver.find_element(By.CSS_SELECTOR, "#stylus-stage .equation").text
        self.assertRegex(caption, r"pen \(10\.0, −20\.0, −2\.9\) mm; F = \(.*, 2\.3\d\) N")
        # 16 mm of 206 N/m are 3.3 N, and no axis gives more.
        self.turn("stiffness", 206)
        self.js("feltgate.stylus.aim(0, 0, -0.045)")
        seen = self.settled()
        self.assertTrue(seen["limited"])
        self.assertEqual(seen["force"][2], 3.3)
        self.assertAlmostEqual(seen["depth"], 0.045 - 3.3 / HAND_N_M, delta=2e-6)

    def test_a_sphere_pushes_along_its_normal(self):
        self.open(world="sphere", stiffness=300, rate=1000, age=1)
        # To the middle from 10 mm deep at 40 degrees, away from the section.
        across, up = math.sin(math.radians(40)), math.cos(math.radians(40))
        direction = (across * 0.6, across * 0.8, up)
        self.place([0.03 * d for d in direction], [0.02 * d for d in direction])
        self.assert_rests(0.01, 300, direction)
        y = self.js("return Number(document.getElementById('stylus-y').value)")
        self.assertAlmostEqual(y, 20 * direction[1], places=2)

    def test_the_normal_lags_by_the_age_of_its_pose(self):
        self.open(world="sphere", stiffness=300, age=2)
        for rate_hz, oldest_s in ((1000, 0.003), (50, 0.022)):
            self.turn("rate", rate_hz)
            self.js("feltgate.stylus.aim(0, 0, 0.022)")
            self.settled(1)
            self.js(STROKE, 5, 2.5)
            self.until("return feltgate.stylus.stroked")
            rows = [r for r in self.js("return feltgate.stylus.rows") if r["point"]]
            rows = rows[len(rows) // 2 :]
            self.assertGreater(len(rows), 5)
            for row in rows:
                pen, speed = row["pen"], row["speed"]
                turn = (pen[2] * speed[0] - pen[0] * speed[2]) / (pen[0] ** 2 + pen[2] ** 2)
                self.assertGreaterEqual(row["age"], 0.002)
                self.assertLessEqual(row["age"], oldest_s + 1.1e-5)
                # Counts: half a mrad along each axis; the speed is not quite even.
                self.assertAlmostEqual(row["tilt"], abs(turn) * row["age"], delta=3e-3)
            self.assertGreater(max(r["age"] for r in rows), 0.6 * oldest_s)
            self.assertGreater(max(r["tilt"] for r in rows), 0.5 * 5 * oldest_s)

    def test_mouse_and_keys_lead_the_hand(self):
        self.open()
        stage = self.driver.find_element(By.CSS_SELECTOR, "#stylus-stage svg")
        place = (
            "const b = arguments[0].getBoundingClientRect(), p = arguments[1],"
            "size = Math.min(b.width / STYLUS_CUT.width, b.height / STYLUS_CUT.height);"
            "return [(p[0] - STYLUS_CUT.width / 2) * size, (p[1] - STYLUS_CUT.height / 2) * size]"
        )
        lead = "return feltgate.stylus.lead"

        def move(script, press=False):
            at = self.js(place, stage, self.js(f"return {script}"))
            actions = ActionChains(self.driver, duration=50)
            actions.move_to_element_with_offset(stage, round(at[0]), round(at[1]))
            if press:
                actions.click()
            actions.perform()

        move("in_section([0.02, 0, 0.03])")
        x, y, z = self.js(lead)
        self.assertAlmostEqual(x, 0.02, delta=5e-4)
        self.assertEqual(y, 0)
        self.assertAlmostEqual(z, 0.03, delta=5e-4)
        move("from_above([-0.03, 0.04])", press=True)
        after = self.js(lead)
        self.assertAlmostEqual(after[0], -0.03, delta=2e-3)
        self.assertAlmostEqual(after[1], 0.04, delta=2e-3)
        self.assertEqual(after[2], z)
        before = after
        stage.send_keys(Keys.ARROW_RIGHT * 2 + Keys.ARROW_DOWN + Keys.PAGE_UP * 3)
        stage.send_keys(Keys.SHIFT + Keys.ARROW_DOWN)
        moved = [b - a for a, b in zip(before, self.js(lead), strict=True)]
        for found, wanted in zip(moved, (0.002, 0.002, -0.001), strict=True):
            self.assertAlmostEqual(found, wanted)
        # All objects are drawn and felt, from above.
        for world, top_m in (("floor", 0), ("sphere", 0.03), ("cube", 0.02)):
            self.turn("world", world)
            self.turn("friction", 0.5)
            self.place((0.005, 0, top_m), (0.005, 0, top_m - 0.01))
            seen = self.settled(1)
            self.assertGreater(seen["force"][2], 0.5, (world, seen))
            self.assertGreater(
                self.js("return document.querySelectorAll('#stylus-stage .outline').length"), 1
            )
            self.assertEqual(
                self.js("return document.querySelectorAll('#stylus-stage .sent.plane').length"), 1
            )


def pictures(folder):
    """The sphere stroked at 50 Hz, the edge of the cube, and the plane pressed with 3.3 N."""
    driver = opened()
    driver.execute_script("document.getElementById('tab-stylus').click()")
    set_to = (
        "for (const [name, value] of Object.entries(arguments[0])) {"
        "const e = document.getElementById(`stylus-${name}`); e.value = value; e.oninput(); }"
    )
    views = {
        "sphere": ({"world": "sphere", "rate": 50, "age": 2, "stiffness": 300}, STROKE),
        "cube": ({"world": "cube", "rate": 1000}, "feltgate.stylus.aim(0.01, 0.012, 0.005)"),
        "plane": ({"world": "floor", "stiffness": 206}, "feltgate.stylus.aim(-0.01, 0, -0.04)"),
    }
    for name, (controls, script) in views.items():
        driver.execute_script(set_to, controls)
        driver.execute_script("feltgate.stylus.aim(0, 0, 0.022)")
        time.sleep(1)
        driver.execute_script(script, 5, 3.1)
        time.sleep(3 if name == "sphere" else 4)
        driver.save_screenshot(str(folder / f"stylus_{name}.png"))
        driver.execute_script("document.getElementById('theme').click()")
        time.sleep(0.5)
        driver.save_screenshot(str(folder / f"stylus_{name}_other.png"))
        print(name, driver.find_element(By.ID, "speed").text)
        driver.execute_script("document.getElementById('theme').click()")
    driver.quit()


if __name__ == "__main__":
    main(pictures)
