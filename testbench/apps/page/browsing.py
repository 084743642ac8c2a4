# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""docs/page.html in Debian's Chromium, for the tests of its tabs. Documentation: docs/page.md"""

import os
import shutil
import sys
import time
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FELTGATE_ROOT", Path(__file__).resolve().parents[3]))
PAGE = Path(os.environ.get("FELTGATE_PAGE", ROOT / "docs/page.html"))  # a trial's, by hand
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains  # noqa: F401
    from selenium.webdriver.common.by import By  # noqa: F401
    from selenium.webdriver.common.keys import Keys  # noqa: F401
except ImportError:
    webdriver = ActionChains = By = Keys = None
DRIVER = shutil.which("chromedriver")
ARGUMENTS = "--headless=new --no-sandbox --disable-dev-shm-usage --window-size=1400,1300".split()
UNFOLD = "for (const fold of document.querySelectorAll('details')) fold.open = true"
PATIENCE_S = 400  # of whole minutes on a machine that does other things too


def opened():
    """A browser with the page in it, ready and unfolded; for pictures and measurements."""
    driver = browser()
    driver.get(PAGE.as_uri())
    while not driver.execute_script("return !!(window.feltgate && feltgate.ready)"):
        time.sleep(0.1)
    driver.execute_script(UNFOLD)
    return driver


def browser():
    options = Options()
    for word in ARGUMENTS:
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(DRIVER), options=options)


def taking(views):
    """A pictures(folder) of {name: script after which the page shows it}."""

    def pictures(folder):
        driver = opened()
        for name, script in views.items():
            driver.execute_script(script)
            time.sleep(4)
            driver.save_screenshot(str(folder / f"{name}.png"))
        driver.quit()

    return pictures


def main(pictures, speed=None):
    """What the words after the test's name ask for: --pictures FOLDER, --speed, or the tests."""
    if "--pictures" in sys.argv:
        pictures(Path(sys.argv[sys.argv.index("--pictures") + 1]))
    elif speed and "--speed" in sys.argv:
        speed()
    else:
        unittest.main()


@unittest.skipUnless(webdriver and DRIVER or os.environ.get("CI"), "no selenium or chromedriver")
class PageTest(unittest.TestCase):
    """A page that is ready before each test, and a console without a message after it."""

    @classmethod
    def setUpClass(cls):
        cls.driver = browser()
        cls.addClassCleanup(cls.driver.quit)

    def setUp(self):
        self.driver.get(PAGE.as_uri())
        self.until("return !!(window.feltgate && feltgate.ready && feltgate.frames.length > 3)")

    def tearDown(self):
        errors = [entry["message"] for entry in self.driver.get_log("browser")]
        self.assertEqual(errors, [])
        self.assertEqual(self.js("return feltgate.errors"), [])

    def unfold(self):
        """Everything that the first screen hides."""
        self.js(UNFOLD)

    def open_tab(self, name):
        self.js("document.getElementById('devices').open = true")
        self.driver.find_element(By.ID, f"tab-{name}").click()

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
