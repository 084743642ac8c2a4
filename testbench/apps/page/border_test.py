#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The border of stability on the page's slider, beside the numbers of `feltgate stability`.

Documentation: docs/page.md
"""

import json
import math
import os
import tempfile
from pathlib import Path

from browsing import ROOT, By, PageTest, main, opened
from testing import BUILD, ran

LEAST, MOST = 0.5, 60  # Nm/rad, of the slider
TICKS = {1_000_000: 1, 1000: 1000, 490: 2040, 144: 6940}  # of the page's rates, by Hz
DAMPINGS = (0, 0.002, 0.005, 0.02)


def of_the_command():
    """The rows of the command: rate, damping and border by eigenvalues."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "stability.json"
        words = "stability lever --no-bits --no-experiments --rate".split()
        lists = [",".join(map(str, TICKS)), "--damping", ",".join(map(str, DAMPINGS))]
        environment = {**os.environ, "FELTGATE_ROOT": str(ROOT)}
        done = ran(BUILD / "feltgate", *words, *lists, "--json", file, env=environment)
        if done.returncode:
            raise AssertionError(done.stderr)
        return json.loads(file.read_text(encoding="utf-8"))["borders"]


class Border(PageTest):
    def setUp(self):
        super().setUp()
        self.unfold()
        self.js("const s = document.getElementById('plant'); s.value = 'linear'; s.oninput()")

    def slide(self, name, value):
        """Sets a slider of the wall to a value of its parameter, as a drag would."""
        self.js(
            "const s = SCENES.wall.sliders.find((s) => s.name === arguments[0]), v = arguments[1];"
            "const at = s.log ? Math.log(v / s.low) / Math.log(s.high / s.low)"
            "  : (v - s.low) / (s.high - s.low);"
            "const e = document.querySelector(`#sliders input[aria-label^='${s.label}']`);"
            "e.value = 1000 * at; e.oninput()",
            name,
            value,
        )

    def rate(self, ticks):
        self.js(
            "const s = document.querySelector('#sliders select');"
            "s.value = arguments[0]; s.oninput()",
            ticks,
        )

    def shown(self):
        """The border on the slider, Nm/rad, when it is the newest one."""
        one = "feltgate.shown_borders.length === 1"
        borders = self.until(f"return !feltgate.asking && {one} && feltgate.shown_borders")
        return borders[0]["stiffness_nm_rad"]

    def mark(self):
        """Where the mark begins on the slider's way, px, and how long that is."""
        return self.js(
            "const i = document.querySelector('.track i').getBoundingClientRect(),"
            "t = document.querySelector('.track input').getBoundingClientRect();"
            "return [i.left - t.left - 8, t.width - 16]"
        )

    def test_it_is_where_the_command_has_it(self):
        rows = of_the_command()
        self.assertEqual(len(rows), len(TICKS) * len(DAMPINGS))
        for row in rows:
            self.assertIn(row["scene_ticks"], TICKS.values())
            self.rate(row["scene_ticks"])
            self.slide("wall_damping", row["damping_nm_s_rad"])
            expected = row["eigenvalues_nm_rad"] or 0
            found = self.shown()
            self.assertAlmostEqual(found, expected, delta=1e-6 + 1e-3 * expected, msg=row)
            share = math.log(max(expected, LEAST) / LEAST) / math.log(MOST / LEAST)
            left, way = self.mark()
            self.assertAlmostEqual(left, share * way, delta=1.5, msg=row)

    def test_beyond_it_the_wall_is_said_to_shake(self):
        for ticks, stable, shakes in ((1000, 5, 6.5), (1, 15, 20)):
            self.rate(ticks)
            for stiffness, said in ((stable, ""), (shakes, "shakes")):
                self.slide("wall_stiffness", stiffness)
                self.until(
                    "return !feltgate.asking &&"
                    "document.getElementById('verdict').className === arguments[0]",
                    said,
                )
        self.js("const s = document.getElementById('second'); s.value = 'paper'; s.oninput()")
        self.until("return document.querySelectorAll('.track i').length === 2")
        self.driver.find_element(By.CSS_SELECTOR, "#scenes input[value=free]").click()
        self.assertEqual(self.js("return document.querySelectorAll('.track i').length"), 0)


def pictures(folder):
    """The slider with its mark, on two widths."""
    driver = opened()
    for width in (1280, 390):
        driver.set_window_size(width, 1000)
        driver.execute_script("document.getElementById('sliders').scrollIntoView()")
        driver.save_screenshot(str(folder / f"border_{width}.png"))
    driver.quit()


if __name__ == "__main__":
    main(pictures)
