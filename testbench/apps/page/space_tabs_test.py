#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's stylus, body in space and knob in Chromium: what mouse, keys and controls do.
Documentation: docs/page.md
"""

import base64
import math
import tempfile
import unittest
from pathlib import Path

from browsing import ActionChains, Keys, TabTest
from testing import BUILD, ran

HAND_N_M = 135


class Gimbal(TabTest):
    TAB = "gimbal"

    def test_the_body_follows_the_hand_and_swings_on(self):
        picture = self.one("#gimbal-stage svg")
        picture.send_keys(Keys.ARROW_RIGHT * 2)
        seen = self.settled(2.5)
        # By 10 degrees about the picture's up.
        turned = [math.sin(math.radians(5)) * part for part in self.js("return GIMBAL_VIEW.up")]
        for name in ("hand", "handle", "body"):
            for part, wanted in zip(seen[name][1:], turned, strict=True):
                self.assertAlmostEqual(part, wanted, delta=5e-3, msg=name)
        self.assertLess(seen["twist"], 0.01)
        # A drag at once leaves the body behind, and the torque pulls the handle back to it.
        ActionChains(self.driver, duration=20).drag_and_drop_by_offset(picture, 150, 0).perform()
        most = self.js("return Math.max(...feltgate.gimbal.trace.flat().map(Math.abs))")
        self.assertGreater(most, 10)
        self.assertLessEqual(most, 100.1)
        self.turn("#gimbal-law-inertia", 0.4)
        self.settled(0.1)
        self.assertIn("15.8 rad/s", self.text("#gimbal-stage"))


COUNT_M = 15.4e-6
BYTES = "Uint8Array.from(atob(arguments[1]), (c) => c.charCodeAt(0))"
DROP = f"""
const data = new DataTransfer();
data.items.add(new File([{BYTES}], arguments[0]));
const how = {{ dataTransfer: data, bubbles: true, cancelable: true }};
document.body.dispatchEvent(new DragEvent("drop", how));
"""


class Stylus(TabTest):
    TAB, PICTURE = "stylus", "#stylus-stage svg"

    def controls(self, **controls):
        for name, value in controls.items():
            self.turn(f"#stylus-{name}", value)

    def led(self, *lead_m):
        self.js("feltgate.stylus.aim(...arguments[0])", lead_m)
        return self.settled(2.5)

    def mouse(self, x_m, z_m):
        """The mouse goes there in the section, and the pen comes to rest."""
        place = self.js("return in_section(arguments[0])", [x_m, 0, z_m])
        self.actions(self.PICTURE, place).perform()
        return self.settled(2.5)

    def test_springs_are_equal_at_rest_and_no_axis_gives_more_than_it_can(self):
        self.assertAlmostEqual(self.js("return feltgate.numbers.stylus.slides.mass_kg"), 0.045)
        self.controls(world="floor", stiffness=800, rate=0)
        depth = 0.02 * HAND_N_M / (HAND_N_M + 800)
        seen = self.led(0.01, -0.02, -0.02)
        self.assertAlmostEqual(seen["depth"], depth, delta=2 * COUNT_M)
        self.assertAlmostEqual(seen["force"][2], 800 * depth, delta=800 * 2 * COUNT_M)
        caption = self.tab("caption.textContent")
        self.assertRegex(caption, r"pen \(10\.0, −20\.0, −2\.9\) mm; F = \(.*, 2\.3\d\) N")
        self.controls(stiffness=206)
        seen = self.led(0, 0, -0.045)
        self.assertTrue(seen["limited"])
        self.assertEqual(seen["force"][2], 3.3)

    def place(self, pen_m, lead_m):
        """The pen at rest there, and its hand led on at once."""
        self.js(
            "const tab = feltgate.stylus; tab.pen.place(...arguments[0]);"
            "tab.led = arguments[1]; tab.aim(...arguments[1])",
            pen_m,
            lead_m,
        )

    def test_mouse_and_keys_lead_the_hand(self):
        self.actions(self.PICTURE, self.js("return in_section([0.02, 0, 0.03])")).perform()
        x, y, z = self.tab("lead")
        self.assertAlmostEqual(x, 0.02, delta=5e-4)
        self.assertEqual(y, 0)
        self.assertAlmostEqual(z, 0.03, delta=5e-4)
        above = self.js("return from_above([-0.03, 0.04])")
        self.actions(self.PICTURE, above).click().perform()
        before = self.tab("lead")
        self.assertAlmostEqual(before[0], -0.03, delta=2e-3)
        self.assertAlmostEqual(before[1], 0.04, delta=2e-3)
        self.assertEqual(before[2], z)
        stage = self.one(self.PICTURE)
        stage.send_keys(Keys.ARROW_RIGHT * 2 + Keys.ARROW_DOWN + Keys.PAGE_UP * 3)
        stage.send_keys(Keys.SHIFT + Keys.ARROW_DOWN)
        moved = [b - a for a, b in zip(before, self.tab("lead"), strict=True)]
        for found, wanted in zip(moved, (0.002, 0.002, -0.001), strict=True):
            self.assertAlmostEqual(found, wanted)
        # All objects are drawn and felt, from above.
        self.controls(friction=0.5)
        for world, top_m in (("floor", 0), ("sphere", 0.03), ("cube", 0.02)):
            self.controls(world=world)
            self.place((0.005, 0, top_m), (0.005, 0, top_m - 0.01))
            self.assertGreater(self.settled(1)["force"][2], 0.5, world)
            self.assertGreater(self.count("#stylus-stage .outline"), 1)
            self.assertEqual(self.count("#stylus-stage .sent.plane"), 1)

    def drop(self, name, data):
        self.js(DROP, name, base64.b64encode(data).decode())
        said = "document.getElementById('stylus-said').textContent"
        return self.until(f"return {said}.startsWith(arguments[0]) && {said}", f"{name}: ")

    def made(self, shape):
        """The path of a mesh of `feltgate touch`."""
        path = Path(self.enterContext(tempfile.TemporaryDirectory())) / f"{shape}.glb"
        self.touch("--make", shape, "--faces", "2000", "-o", path)
        return path

    def touch(self, *words):
        done = ran(BUILD / "feltgate_touch", "touch", *words)
        self.assertEqual(done.returncode, 0, done.stderr)

    def painted(self):
        """How many pixels of the picture are of the mesh, and the sum of their brightness."""
        return self.js(
            "const { data } = feltgate.stylus.view.image; let count = 0, sum = 0;"
            "for (let n = 3; n < data.length; n += 4) if (data[n]) { ++count; sum += data[n - 3]; }"
            "return [count, sum]"
        )

    def test_a_dropped_file_is_felt_and_a_bad_one_refused(self):
        self.open_tab("lever")
        ball = self.made("ball").read_bytes()
        said = self.drop("ball.glb", ball)
        for part in (" to 60 mm", "1 part, closed, genus 0"):
            self.assertIn(part, said)
        self.assertEqual(self.js("return feltgate.tab"), "stylus")
        # Nothing above it, and a spring against the hand within.
        self.assertIsNone(self.mouse(0.002, 0.045)["proxy"])
        seen = self.mouse(0.002, 0.02)
        self.assertGreater(seen["depth"], 2e-3)
        self.assertAlmostEqual(math.hypot(*seen["force"]), 206 * seen["depth"], delta=206 * 2 * COUNT_M)
        self.assertAlmostEqual(math.dist(seen["proxy"], seen["pen"]), seen["depth"], delta=2 * COUNT_M)
        self.assertAlmostEqual(math.hypot(*seen["proxy"]), 0.03, delta=5e-4)
        self.assertGreater(self.painted()[0], 30_000)
        self.assertIn("no GLB file", self.drop("note.glb", b"a text that is no mesh at all"))
        self.assertEqual(self.tab("mesh.name"), "ball.glb")

    def test_an_edge_has_two_planes_when_it_is_asked_for(self):
        self.controls(world="cube")
        for edges, rate_hz in ((False, 1e5), (True, 5e4)):
            seen = self.mouse(0.019, 0.016)
            self.assertAlmostEqual(seen["rate_hz"], rate_hz)
            normals = {tuple(round(part) for part in seen[n] or ()) for n in ("normal", "second")}
            self.assertIn((1, 0, 0), normals)
            self.assertIn((0, 0, 1) if edges else (), normals)
            self.js("document.getElementById('stylus-edges').click()")

    def test_the_knob_is_felt_with_and_without_smooth_edges(self):
        self.controls(world="mesh")
        self.assertIn("2880 of 2880 triangles", self.text("#stylus-said"))
        seen = self.mouse(0.004, 0.02)
        self.assertGreater(seen["force"][2], 0.3)
        count, facets = self.painted()
        self.click("#stylus-shading")
        smooth = self.mouse(0.004, 0.02)
        self.assertEqual(self.painted()[0], count)
        self.assertNotEqual(self.painted()[1], facets)
        self.assertNotEqual(smooth["normal"], seen["normal"])


KNOB_NM_RAD = HAND_N_M * 0.02**2
DETENT_NM_RAD = 0.012 / 0.1
FRICTION_NM = 0.65e-3
LOST_NM = 5e-4  # what dead times take beyond what the core gives back


class Knob(TabTest):
    TAB = "knob"

    def led(self, rad, seconds=1.5):
        """The state when the hand has come to rest there."""
        self.js("feltgate.knob.take(true); feltgate.knob.aim(arguments[0])", rad)
        return self.settled(seconds)

    def test_the_mouse_turns_it_from_detent_to_detent(self):
        way = [(k * 1.5 / 12) for k in range(13)]
        places = [(200 + 140 * math.sin(rad), 200 - 140 * math.cos(rad)) for rad in way]
        self.actions("#knob-face", *places, held=True).perform()
        self.assertAlmostEqual(self.tab("lead"), 1.5, delta=0.05)
        self.settled(1)
        self.assertTrue(self.tab("held"))
        ActionChains(self.driver).release().perform()
        seen = self.settled(2)
        self.assertFalse(self.tab("held"))
        self.assertGreater(seen["detent"], 0.9)
        self.assertAlmostEqual(seen["theta"], seen["detent"], delta=0.014)  # friction, dead times
        face, before = self.one("#knob-face"), self.tab("lead")
        face.send_keys(Keys.ARROW_RIGHT * 3)
        self.assertTrue(self.tab("held"))
        self.assertNotEqual(self.tab("lead"), before)
        face.send_keys(" ")
        self.assertFalse(self.tab("held"))

    def test_hand_and_detent_balance(self):
        seen = self.led(0.2)
        rest = 0.2 * KNOB_NM_RAD / (KNOB_NM_RAD + DETENT_NM_RAD)
        margin = (FRICTION_NM + LOST_NM) / (KNOB_NM_RAD + DETENT_NM_RAD) + 5e-4
        self.assertAlmostEqual(seen["theta"], rest, delta=margin)
        self.assertAlmostEqual(seen["asked"], -DETENT_NM_RAD * seen["theta"], delta=1e-4)
        self.assertAlmostEqual(seen["torque"], seen["asked"], delta=LOST_NM)

    def test_a_wrong_offset_and_a_motor_that_is_off_are_seen(self):
        for degrees in (0, 180):
            self.js("feltgate.knob.take(false)")
            self.turn("#knob-offset", degrees)
            seen = self.led(self.tab("seen.detent") + 0.15, 1)
            self.assertAlmostEqual(seen["offset"], degrees / 360, delta=1e-9)
            expected = seen["asked"] * math.cos(math.radians(degrees))
            self.assertAlmostEqual(seen["torque"], expected, delta=1.3e-3, msg=degrees)
            self.assertGreater(abs(seen["asked"]), 2e-3)
            face = self.one("#knob-face").text
            self.assertAlmostEqual(float(face.split(" N")[0]), abs(seen["torque"]) / 0.02, delta=0.02)
            self.assertEqual("self-test" in self.text("#knob-said"), degrees == 180)
            self.assertEqual(self.count("#knob-dial .believed") > 0, degrees == 180)
        self.assertIn("e = pole pairs · θ + offset = 11 ·", self.tab("caption.textContent"))
        self.click("#knob-armed")
        self.assertFalse(self.settled(0.1)["gates"])
        self.until("return document.getElementById('knob-dial').textContent.includes('motor off')")


if __name__ == "__main__":
    unittest.main()
