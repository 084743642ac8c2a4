#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""docs/page.html in Debian's Chromium: the same bits, devices to drag, keys, faults, no error.

chromium_test.py --speed prints frames a second and the real-time factor, for an idle machine;
chromium_test.py --pictures FOLDER keeps screenshots.
Documentation: docs/page.md
"""

import os
import time

from browsing import ROOT, ActionChains, By, Keys, PageTest, main, opened
from testing import weekly

WHOLE = "FELTGATE_WHOLE" in os.environ  # every scene and law, not a share of them


class Lever(PageTest):
    def setUp(self):
        """Unfolded, the lever at rest at 0, and nobody's hand there that shows how."""
        super().setUp()
        self.js("feltgate.devices[0].take(false); place_devices()")
        self.unfold()
        self.until("return feltgate.devices[0].now.time > 0.02")

    def stage(self, n=0):
        return self.driver.find_elements(By.CSS_SELECTOR, "#stages svg")[n]

    def now(self, n=0):
        return self.js("return feltgate.devices[arguments[0]].now", n)

    def passed(self, seconds):
        """Waits for so much simulated time."""
        begin = self.now()["time"]
        self.until("return feltgate.devices[0].now.time > arguments[0]", begin + seconds)

    def drag(self, *offsets):
        """Down in the middle of the stage, and by these offsets; still held."""
        actions = ActionChains(self.driver, duration=50)
        actions.move_to_element(self.stage()).click_and_hold()
        for offset in offsets:
            actions.move_by_offset(*offset)
        actions.perform()

    def test_same_bits(self):
        self.js("window.requestAnimationFrame = () => 0")  # the lever rests, the worker computes
        self.driver.find_element(By.ID, "check").click()
        self.until("return feltgate.done")
        compared = self.js("return feltgate.compared")
        self.assertGreaterEqual(len(compared), 13)
        for one in compared:
            self.assertTrue(one["same"], one)
        scenes = [(one["design"], one["scene"]) for one in compared]
        self.assertIn(("gimbal_motor", "knob_detents"), scenes)
        self.assertIn(("planes", "knob"), scenes)
        for one in self.js("return feltgate.closed"):
            self.assertLess(one["rad"], 1e-6, one)
            self.assertLess(one["nm"], 1e-5, one)
        table = self.driver.find_element(By.ID, "hashes").get_attribute("innerHTML")
        self.assertNotIn("differs", table)

    def test_drag_into_the_wall(self):
        self.drag((0, -120), (90, 10), (90, 20), (90, 30))
        self.until("return feltgate.devices[0].lead > 0.55")
        self.passed(1.5)
        state = self.now()
        lead = self.js("return feltgate.devices[0].lead")
        self.assertLess(state["theta"], lead - 0.03)  # held back
        self.assertGreater(state["theta"], 0.49)
        self.assertLess(state["torque"], -0.05)
        ActionChains(self.driver).release().perform()
        self.passed(0.5)
        self.assertLess(self.now()["theta"], 0.52)
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

    def a_minute(self):
        """A minute at the mouse; a third of it in a usual run."""
        part = 1 if WHOLE else 3
        self.moved(24 // part, "Math.min(1.45, k / 60)")
        if self.js("return feltgate.devices[0].scene") == "wall":
            self.assertLess(self.now()["theta"], 0.6)
            self.assertLess(self.now()["torque"], -0.05)
        self.moved(18 // part, "0.75 + 0.75 * Math.sin(k / 10)")
        self.moved(18 // part, "1.4 * Math.sin(k / 13) * Math.sin(k / 47)", "k % 90 < 60")

    @weekly(4)
    def test_a_minute_at_the_mouse_brings_no_fault(self):
        radios = self.driver.find_elements(By.CSS_SELECTOR, "#scenes input:not([value=law])")
        for radio in radios if WHOLE else radios[-1:]:
            scene = radio.get_attribute("value")
            with self.subTest(scene=scene):
                radio.click()
                self.until("return feltgate.devices[0].scene === arguments[0]", scene)
                self.recover()
                self.a_minute()

    @weekly(4)
    def test_a_minute_in_a_shipped_law_brings_no_fault(self):
        self.driver.find_element(By.CSS_SELECTOR, "#scenes input[value=law]").click()
        names = self.js("return Object.keys(feltgate.numbers.laws)")
        for name in names if WHOLE else names[:1]:
            with self.subTest(law=name):
                self.choose_law(name)
                self.recover()
                if WHOLE:
                    self.a_minute()
                else:
                    self.moved(4, "Math.min(1.45, k / 60)")

    def choose_law(self, name):
        self.js(
            "const s = document.getElementById('shipped'); s.value = arguments[0]; s.oninput()",
            name,
        )
        self.until("return feltgate.law === feltgate.numbers.laws[arguments[0]]", name)
        self.until("return feltgate.devices[0].status.armed")

    def recover(self):
        """After a fault of the subtest before."""
        self.js("feltgate.devices[0].take(false); feltgate.devices[0].recover()")
        self.until("return feltgate.devices[0].status.armed")

    def test_a_fault_shows_at_the_handle_and_one_button_recovers(self):
        alarm = self.driver.find_element(By.CSS_SELECTOR, ".alarm")
        self.assertFalse(alarm.is_displayed())
        self.js("const s = document.getElementById('grip'); s.value = 3; s.oninput()")
        for broken in ("0", "1"):
            self.js("feltgate.devices[0].take(true)")
            if broken == "0":
                self.driver.find_element(By.ID, "stop").click()
            else:
                self.js("const s = document.getElementById('break'); s.value = 1; s.oninput()")
                for lead in (0.2, 0.4, 0.1, 0.5):
                    self.js("feltgate.devices[0].aim(arguments[0])", lead)
                    self.passed(0.3)
            alarm = self.driver.find_element(By.CSS_SELECTOR, ".alarm")
            self.until("return !document.querySelector('.alarm').hidden")
            self.assertIn("The motor is off", alarm.text)
            self.assertIn("motor off", self.stage().text)
            self.assertIn("faulted", self.stage().get_attribute("class"))
            colour = "return getComputedStyle(document.querySelector(arguments[0]))[arguments[1]]"
            red = self.js(colour, ".alarm", "color")
            self.assertEqual(self.js(colour, ".knob", "fill"), red)
            alarm.find_element(By.TAG_NAME, "button").click()
            self.until("return feltgate.devices[0].status && feltgate.devices[0].status.armed")
            self.passed(0.2)
            self.assertEqual(self.js("return feltgate.devices[0].status.faults"), "")
            self.assertTrue(self.js("return document.querySelector('.alarm').hidden"))
            self.assertNotEqual(self.js(colour, ".knob", "fill"), red)

    def test_keys(self):
        stage = self.stage()
        stage.send_keys(Keys.ARROW_RIGHT * 10)
        self.until("return feltgate.devices[0].held && feltgate.devices[0].lead > 0.15")
        self.until("return feltgate.devices[0].now.theta > 0.1")
        self.assertAlmostEqual(float(stage.get_attribute("aria-valuenow")), 0.2, delta=0.1)
        stage.send_keys(" ")
        self.until("return !feltgate.devices[0].held")
        stage.send_keys("s")
        self.until("return !feltgate.devices[0].status.armed")
        self.assertIn("stop", self.js("return feltgate.devices[0].status.faults"))
        stage.send_keys("s")
        stage.send_keys("c")
        self.until("return feltgate.devices[0].status.faults === ''")
        stage.send_keys("a")
        self.until("return feltgate.devices[0].status.armed")

    def test_scenes(self):
        radios = self.driver.find_elements(By.CSS_SELECTOR, "#scenes input")
        for radio in radios if WHOLE else radios[::6]:
            # Held first: a free lever gets too fast under a torque that stands.
            self.js("feltgate.devices[0].take(true)")
            radio.click()
            scene = radio.get_attribute("value")
            self.until("return feltgate.devices[0].scene === arguments[0]", scene)
            self.js("feltgate.devices[0].aim(0.3)")
            self.passed(0.2)
            equation = self.driver.find_element(By.CSS_SELECTOR, ".equation").text
            self.assertIn("τ", equation)
            self.assertNotIn("?", equation, scene)
            self.assertNotIn("NaN", self.stage().get_attribute("innerHTML"), scene)
            self.assertEqual(self.js("return feltgate.devices[0].status.faults"), "", scene)
            # Held on, it would get too hot; let go, a torque that stands would make it too fast.
            radios[0].click()
            self.until("return feltgate.devices[0].scene === 'free'")
            self.js("feltgate.devices[0].take(false)")

    def write_law(self, text):
        self.js(
            "const t = document.getElementById('law-text'); t.value = arguments[0]; t.oninput()",
            text,
        )

    def test_a_law_is_written_and_felt(self):
        self.driver.find_element(By.CSS_SELECTOR, "#scenes input[value=law]").click()
        self.until("return document.getElementById('law-table').textContent.includes('bound')")
        self.until("return feltgate.devices[0].status.armed")
        self.assertEqual(self.js("return feltgate.devices[0].info.name"), "lever_law")
        # An error is told, and the law before is still felt.
        self.write_law("# mine\nout torque = -0.2 Nm * sin(8 * postion)\n")
        self.until("return !document.getElementById('law-error').hidden")
        said = self.driver.find_element(By.ID, "law-error").text
        self.assertRegex(said, r"2:32: .*postion.*position")
        self.assertTrue(self.js("return feltgate.devices[0].status.armed"))
        # Another law, without the error: at rest against a hand the torque is the law's.
        self.write_law(
            "param strength = 0.2 Nm in 0 .. 0.4 Nm\nout torque = -strength * sin(8 * position)\n"
        )
        self.until("return document.getElementById('law-error').hidden")
        self.until("return feltgate.law.includes('strength')")
        self.until("return feltgate.devices[0].status.armed")
        off = (
            "const n = feltgate.devices[0].now;"
            "return Math.abs(n.tau_ref + arguments[0] * Math.sin(8 * n.position))"
        )
        self.js("feltgate.devices[0].take(true); feltgate.devices[0].aim(0.1)")
        self.passed(1)
        self.assertGreater(abs(self.now()["tau_ref"]), 0.05)
        self.assertLess(self.js(off, 0.2), 0.01)
        self.js("const s = document.querySelector('#sliders input'); s.value = 250; s.oninput()")
        self.passed(0.5)
        self.assertLess(self.js(off, 0.1), 0.01)
        curve = self.js("return Array.from(feltgate.devices[0].turn)")
        self.assertAlmostEqual(max(curve), 0.1, 2)
        # Back to a scene in hardware, on its own design.
        self.driver.find_element(By.CSS_SELECTOR, "#scenes input[value=wall]").click()
        self.until("return feltgate.devices[0].info.name === 'lever'")
        self.assertFalse(self.driver.find_element(By.ID, "law").is_displayed())

    def test_an_error_of_a_law_is_seen_with_its_text_and_covers_none_of_it(self):
        self.addCleanup(self.driver.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})
        self.driver.find_element(By.CSS_SELECTOR, "#scenes input[value=law]").click()
        self.write_law("# mine\nout torque = -0.2 Nm * sin(8 * postion)\n")
        self.until("return !document.getElementById('law-error').hidden")
        self.js("for (const fold of document.querySelectorAll('details')) fold.open = false")
        box = "return document.getElementById(arguments[0]).getBoundingClientRect().toJSON()"
        for width, height in ((1400, 800), (1280, 720), (390, 844)):
            size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
            self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
            self.js("window.scrollTo(0, 0); feltgate.editor.point()")
            text, said, mark = (self.js(box, name) for name in ("law-text", "law-error", "law-mark"))
            self.assertGreater(text["top"], 0)
            self.assertGreaterEqual(said["top"], text["bottom"] - 0.5)
            self.assertLess(said["bottom"], height, width)
            # Under the word, in the second of the lines of 20 px.
            self.assertLess(mark["height"], 4)
            self.assertAlmostEqual(mark["top"] - text["top"], 8 + 2 * 20 - 2, delta=2)

    def test_what_is_broken_is_told_and_shown(self):
        faults = "return feltgate.devices[0].status.faults"
        weak = "const n = feltgate.devices[0].now; return n.tau_ref < -0.3 && n.torque / n.tau_ref < 0.4"
        self.js("document.getElementById('faults').open = true")
        expect = self.driver.find_element(By.ID, "expect")
        for broken, shown in (("1", "channel"), ("2", "polarity"), ("3", "polarity"), ("4", "weak")):
            choice = "const s = document.getElementById('break'); s.value = arguments[0];"
            self.js(choice + "s.dispatchEvent(new Event('input'))", broken)
            self.assertIn("no fault" if shown == "weak" else f"fault {shown}", expect.text)
            if shown == "weak":
                self.until(weak)
            else:
                self.assertEqual(self.until(faults), shown)
                self.until("return document.getElementById('expect').innerText.includes('Now: fault')")
            self.js("recover()")
            self.until("return feltgate.devices[0].status && feltgate.devices[0].status.armed")
        self.assertEqual(expect.text, "")

    def test_shipped_laws(self):
        self.driver.find_element(By.CSS_SELECTOR, "#scenes input[value=law]").click()
        names = self.js("return Object.keys(feltgate.numbers.laws)")
        for name in names if WHOLE else names[::16]:
            self.choose_law(name)
            self.assertTrue(self.driver.find_element(By.ID, "law-error").get_property("hidden"))

    def test_a_dead_channel_is_a_fault(self):
        # Noticed in quick motion.
        self.js("const s = document.getElementById('grip'); s.value = 3; s.oninput()")
        self.js("feltgate.devices[0].take(true)")
        self.js("const s = document.getElementById('break'); s.value = 1; s.oninput()")
        for lead in (0.2, 0.4, 0.1, 0.5):
            self.js("feltgate.devices[0].aim(arguments[0])", lead)
            self.passed(0.2)
        self.until("return feltgate.devices[0].status.faults === 'channel'")
        self.assertIn("fault: channel", self.driver.find_element(By.CSS_SELECTOR, ".state").text)

    def test_verdict(self):
        self.until("return document.getElementById('verdict').textContent.includes('stable')")
        self.js(
            "const s = document.querySelector('#sliders input'); s.value = 1000; s.oninput()"
        )
        self.until("return document.getElementById('verdict').className === 'shakes'")
        said = self.driver.find_element(By.ID, "verdict").text
        self.assertRegex(said, r"border is 17\.\d Nm/rad")

    def test_side_by_side_and_own_design(self):
        self.js("const s = document.getElementById('second'); s.value = 'paper'; s.oninput()")
        self.until("return feltgate.devices.length === 2 && feltgate.devices[1].now.time > 0.1")
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, "#stages svg")), 2)
        text = (ROOT / "rtl/designs/lever.toml").read_text(encoding="utf-8")
        softer = text.replace("torque_limit_nm = 0.5", "torque_limit_nm = 0.25")
        self.js("drop('mine.toml', arguments[0])", softer)
        self.until("return feltgate.devices[1] && feltgate.devices[1].name === 'mine'")
        self.assertAlmostEqual(self.js("return feltgate.devices[1].words.torque_limit"), 0.25, 3)
        self.js("drop('mine.toml', arguments[0])", text.replace("m1 = 767", "m1 = 500"))
        said = self.driver.find_element(By.ID, "own-said").text
        self.assertIn("m1 = 500", said)
        self.js("drop('mine.toml', 'nonsense')")
        self.assertIn("mine.toml:1", self.driver.find_element(By.ID, "own-said").text)

    def test_labels_and_dark(self):
        self.assertEqual(self.driver.find_element(By.CSS_SELECTOR, ".badge").text, "simulated")
        for tab in ("pantograph", "drums", "materials"):
            self.open_tab(tab)
        unnamed = self.js(
            "return [...document.querySelectorAll('input, select, canvas, svg[tabindex], button')]"
            ".filter(e => !(e.getAttribute('aria-label') || e.textContent.trim()"
            " || (e.labels && e.labels.length && e.labels[0].textContent.trim())))"
            ".map(e => e.outerHTML)"
        )
        self.assertEqual(unnamed, [])
        colour = "return getComputedStyle(document.body).backgroundColor"
        before = self.js(colour)
        self.driver.find_element(By.ID, "theme").click()
        self.assertNotEqual(self.js(colour), before)


def measure():
    """Frames a second and real-time factor while a lever is led to and fro in a wall."""
    driver = opened()
    driver.execute_script("feltgate.devices[0].take(true)")
    for k in range(60):
        driver.execute_script("feltgate.devices[0].aim(arguments[0])", 0.7 if k % 2 else 0.3)
        time.sleep(0.2)
    frames = driver.execute_script("return feltgate.frames")
    gaps = sorted(b - a for a, b in zip(frames, frames[1:], strict=False))
    speed = driver.execute_script("return feltgate.speed")
    print(f"median {1000 / gaps[len(gaps) // 2]:.0f} frames a second, {speed:.1f} times real time")
    for tab in ("pantograph", "drums", "materials"):
        driver.execute_script("document.getElementById(arguments[0]).click()", f"tab-{tab}")
        time.sleep(5)
        speed = driver.execute_script("return feltgate.speed")
        print(f"{tab}: {speed:.1f} times real time")
    driver.quit()


def pictures(folder):
    """Screenshots of the wall under a hand, of the membrane, and of two designs in the dark."""
    driver = opened()
    views = {
        "wall": "",
        "membrane": "document.querySelector('input[value=membrane]').click();",
        "charges": "document.querySelector('input[value=charge_attract]').click();",
        "spring": "document.querySelector('input[value=spring_tension]').click();",
        "law": "document.getElementById('second').value = '';"
        "document.querySelector('input[value=law]').click();",
        "law_error": "const t = document.getElementById('law-text');"
        "t.value = t.value.replace('* position', '* postion'); t.oninput();"
        "document.getElementById('theme').click();",
        "law_back": "document.getElementById('theme').click();"
        "document.querySelector('input[value=wall]').click();",
        "two": "const s = document.getElementById('second'); s.value = 'paper'; s.oninput();"
        "document.getElementById('theme').click(); document.getElementById('check').click();",
    }
    for name, script in views.items():
        driver.execute_script(script + "for (const d of feltgate.devices) d.take(true)")
        for k in range(40):
            lead = 0.65 * min(1, k / 20)
            driver.execute_script("for (const d of feltgate.devices) d.aim(arguments[0])", lead)
            time.sleep(0.05)
        time.sleep(4)
        if "law" in name:
            driver.find_element(By.ID, "law").location_once_scrolled_into_view  # noqa: B018
        driver.save_screenshot(str(folder / f"{name}.png"))
    driver.quit()


if __name__ == "__main__":
    main(pictures, measure)
