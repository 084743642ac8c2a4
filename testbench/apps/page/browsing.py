# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""docs/page.html in Debian's Chromium, for the tests of its tabs. Documentation: docs/page.md"""

import os
import shutil
import time
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FELTGATE_ROOT", Path(__file__).resolve().parents[3]))
PAGE = Path(os.environ.get("FELTGATE_PAGE", ROOT / "docs/page.html"))  # a trial's, by hand
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys  # noqa: F401
except ImportError:
    webdriver = ActionChains = By = Keys = None
DRIVER = shutil.which("chromedriver")
ARGUMENTS = "--headless=new --no-sandbox --disable-dev-shm-usage --window-size=1400,1300".split()
PATIENCE_S = 400  # of whole minutes on a machine that does other things too
NOW = "feltgate.devices[0].now"
ARMED = "return feltgate.devices[0].status && feltgate.devices[0].status.armed"
BOX = "return document.querySelector(arguments[0]).getBoundingClientRect().toJSON()"
READY = "return !!(window.feltgate && feltgate.ready && feltgate.frames.length > 3)"


def browser():
    options = Options()
    for word in ARGUMENTS:
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(DRIVER), options=options)


@unittest.skipUnless(webdriver and DRIVER or os.environ.get("CI"), "no selenium or chromedriver")
class PageTest(unittest.TestCase):
    """A page that is ready before each test, and a console without a message after it."""

    @classmethod
    def setUpClass(cls):
        cls.driver = browser()
        cls.addClassCleanup(cls.driver.quit)

    def setUp(self):
        self.driver.get(PAGE.as_uri())
        self.until(READY)

    def tearDown(self):
        errors = [entry["message"] for entry in self.driver.get_log("browser")]
        self.assertEqual(errors, [])
        self.assertEqual(self.js("return feltgate.errors"), [])

    def unfold(self):
        """Everything that the first screen hides."""
        self.js("for (const fold of document.querySelectorAll('details')) fold.open = true")

    def open_tab(self, name):
        self.js("document.getElementById('devices').open = true")
        self.click(f"#tab-{name}")
        self.until(f"return feltgate.tab === '{name}'")
        self.unfold()

    def js(self, script, *words):
        return self.driver.execute_script(script, *words)

    def until(self, script, *words):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            found = self.js(script, *words)
            if found:
                return found
            time.sleep(0.1)
        self.fail(f"never true in {PATIENCE_S} s: {script}")

    def passed(self, state, seconds):
        """The state, an object with a time, when so much simulated time has passed."""
        begin = self.js(f"return {state}.time")
        return self.until(f"const s = {state}; return s.time > arguments[0] && s", begin + seconds)

    def all(self, css):
        return self.driver.find_elements(By.CSS_SELECTOR, css)

    def one(self, css):
        return self.driver.find_element(By.CSS_SELECTOR, css)

    def click(self, css):
        self.one(css).click()

    def text(self, css):
        return self.js("return document.querySelector(arguments[0]).textContent", css)

    def count(self, css):
        return self.js("return document.querySelectorAll(arguments[0]).length", css)

    def turn(self, css, value):
        """A control to a value, as a hand would."""
        self.js(
            "const e = document.querySelector(arguments[0]); e.value = arguments[1];"
            "for (const kind of ['input', 'change']) e.dispatchEvent(new Event(kind))",
            css,
            value,
        )

    def actions(self, picture, *places, held=False):
        """The mouse goes to these places, in the units of the picture's view box; `held`: from the
        first on with its button down."""
        stage = self.one(picture)
        actions = ActionChains(self.driver, duration=50)
        for number, place in enumerate(places):
            x, y = self.js(
                "const [svg, [x, y]] = arguments, b = svg.getBoundingClientRect(), v = svg.viewBox.baseVal;"
                "const size = Math.min(b.width / v.width, b.height / v.height);"
                "return [(x - v.x - v.width / 2) * size, (y - v.y - v.height / 2) * size]",
                stage,
                place,
            )
            actions.move_to_element_with_offset(stage, round(x), round(y))
            if held and number == 0:
                actions.click_and_hold()
        return actions

    def screen(self, width, height, mobile=False):
        """The size of the screen, until the test ends."""
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        self.addCleanup(self.driver.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})


class LeverTest(PageTest):
    """Of the tab of the lever, which is open at first."""

    def hold(self, lead=None):
        self.js("feltgate.devices[0].take(true)")
        if lead is not None:
            self.js("feltgate.devices[0].aim(arguments[0])", lead)

    def choose(self, scene):
        self.js(f"document.querySelector('#scenes input[value={scene}]').click()")
        self.until("return feltgate.devices[0].scene === arguments[0]", scene)

    def now(self):
        return self.js(f"return {NOW}")


class TabTest(PageTest):
    """Of another tab, which is opened before each test."""

    TAB = ""  # its name
    STATE = "seen"  # of its device

    def setUp(self):
        super().setUp()
        self.open_tab(self.TAB)

    def tab(self, what):
        return self.js(f"return feltgate.{self.TAB}.{what}")

    def settled(self, seconds):
        """The state when the hand's swinging is over."""
        return self.passed(f"feltgate.{self.TAB}.{self.STATE}", seconds)
