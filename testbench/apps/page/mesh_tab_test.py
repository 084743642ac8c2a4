#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A GLB file that is dropped on the page and felt with the mouse, in Debian's Chromium; what it
says of a bad one.

mesh_tab_test.py --pictures FOLDER keeps screenshots.
Documentation: docs/page.md
"""

import base64
import itertools
import json
import math
import struct
import tempfile
from pathlib import Path

from browsing import PAGE, ActionChains, By, PageTest, main, taking
from testing import BUILD, ran

HAND_N_M, STIFFNESS_N_M, COUNT_M = 135, 206, 15.4e-6
MOST_BYTES = 2_000_000

DROP = """
const bytes = Uint8Array.from(atob(arguments[1]), (c) => c.charCodeAt(0));
const data = new DataTransfer();
data.items.add(new File([bytes], arguments[0]));
const how = { dataTransfer: data, bubbles: true, cancelable: true };
document.body.dispatchEvent(new DragEvent("drop", how));
"""
SETTLED_S = 2.5


def box_glb(right, up, near, uri=None):
    """A closed box of 12 triangles and 8 corners, in the units of its file."""
    sides = [(-right / 2, right / 2), (-up / 2, up / 2), (-near / 2, near / 2)]
    corners = b"".join(struct.pack("<3f", *at) for at in itertools.product(*sides))
    faces = (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)
    order = [n for a, b, c, d in faces for n in (a, b, c, a, c, d)]
    binary = corners + struct.pack(f"<{len(order)}H", *order)
    buffer = {"byteLength": len(binary), **({"uri": uri} if uri else {})}
    views = [
        {"buffer": 0, "byteLength": len(corners)},
        {"buffer": 0, "byteOffset": len(corners), "byteLength": 2 * len(order)},
    ]
    accessors = [
        {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5123, "count": len(order), "type": "SCALAR"},
    ]
    text = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [buffer],
        "bufferViews": views,
        "accessors": accessors,
    }
    head = json.dumps(text).encode()
    head += b" " * (-len(head) % 4)
    chunks = struct.pack("<I4s", len(head), b"JSON") + head
    if not uri:
        chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


class Mesh(PageTest):
    def drop(self, name, data):
        self.js(DROP, name, base64.b64encode(data).decode())
        said = "return document.getElementById('stylus-said').textContent"
        return self.until(f"{said}.startsWith(arguments[0]) && {said[7:]}", f"{name}: ")

    def lead(self, x_m, z_m):
        """The mouse goes there in the section, and the pen comes to rest."""
        stage = self.driver.find_element(By.CSS_SELECTOR, "#stylus-stage svg")
        at = self.js(
            "const s = arguments[0], b = s.getBoundingClientRect(), v = s.viewBox.baseVal;"
            "const k = Math.min(b.width / v.width, b.height / v.height);"
            "const p = in_section(arguments[1]);"
            "return [k * (p[0] - v.width / 2), k * (p[1] - v.height / 2)]",
            stage,
            [x_m, 0, z_m],
        )
        actions = ActionChains(self.driver, duration=50)
        actions.move_to_element_with_offset(stage, round(at[0]), round(at[1])).perform()
        begin = self.js("return feltgate.stylus.seen.time")
        self.until("return feltgate.stylus.seen.time > arguments[0]", begin + SETTLED_S)
        return self.js("return [feltgate.stylus.seen, feltgate.stylus.lead]")

    def painted(self):
        """How many pixels of the picture are of the mesh, and the sum of their brightness."""
        return self.js(
            "const { data } = feltgate.stylus.view.image; let count = 0, sum = 0;"
            "for (let n = 3; n < data.length; n += 4) if (data[n]) { ++count; sum += data[n - 3]; }"
            "return [count, sum]"
        )

    def test_a_dropped_file_is_felt(self):
        said = self.drop("box.glb", box_glb(3, 1, 3))
        for part in ("12 of 12 triangles", "scaled by 0.02 to 60 mm", "1 part, closed, genus 0"):
            self.assertIn(part, said)
        self.assertEqual(self.js("return feltgate.tab"), "stylus")
        # The box is 20 mm high: nothing above, and a spring against the hand within.
        seen, _ = self.lead(0.005, 0.03)
        self.assertLess(max(map(abs, seen["force"])), 1e-3)
        self.assertIsNone(seen["proxy"])
        seen, lead = self.lead(0.005, 0)
        depth_m = (0.01 - lead[2]) * HAND_N_M / (HAND_N_M + STIFFNESS_N_M)
        self.assertGreater(depth_m, 3e-3)
        self.assertAlmostEqual(seen["depth"], depth_m, delta=2 * COUNT_M)
        force = STIFFNESS_N_M * depth_m
        for found, wanted in zip(seen["force"], (0, 0, force), strict=True):
            self.assertAlmostEqual(found, wanted, delta=STIFFNESS_N_M * 2 * COUNT_M)
        for found, wanted in zip(seen["proxy"], (seen["pen"][0], 0, 0.01), strict=True):
            self.assertAlmostEqual(found, wanted, delta=2 * COUNT_M)
        self.assertGreater(self.painted()[0], 30_000)

    def test_its_planes_are_those_of_the_program(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

        def touch(*words):
            done = ran(BUILD / "feltgate_touch", "touch", *words, cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)

        torus, box = folder / "torus.glb", folder / "box.glb"
        touch("--make", "torus", "--faces", "400", "-o", torus)
        box.write_bytes(box_glb(3, 1, 3))
        for path in (torus, box):
            touch(path, "--json", "it.json", "--quiet")
            native = json.loads((folder / "it.json").read_text(encoding="utf-8"))
            self.js(
                "window.found = null; const bytes = Uint8Array.from(atob(arguments[1]), (c) => c.charCodeAt(0));"
                "feltgate.worker.call('planesHash', arguments[0], bytes, 0.06).then((hash) => { window.found = hash; })",
                path.name,
                base64.b64encode(path.read_bytes()).decode(),
            )
            self.assertEqual(self.until("return window.found"), native["stroke_hash"], path.name)

    def test_a_bad_file_is_refused_in_the_importers_words(self):
        self.drop("box.glb", box_glb(3, 1, 3))
        whole = box_glb(1, 1, 1)
        for name, data, needle in (
            ("cut.glb", whole[:-40], "cut off: "),
            ("empty.glb", b"", "export"),
            ("note.glb", b"a text that is no mesh at all", "no GLB file; export as binary"),
            ("two.glb", box_glb(1, 1, 1, "other.bin"), "needs the file other.bin beside it"),
            ("flat.glb", box_glb(float("nan"), 1, 1), "vertex 0 of a primitive is not finite"),
        ):
            said = self.drop(name, data)
            self.assertIn(needle, said)
            self.assertNotIn("\n", said)
        self.assertEqual(self.js("return feltgate.stylus.mesh.name"), "box.glb")

    def test_the_knob_is_felt_with_and_without_smooth_edges(self):
        self.open_tab("stylus")
        self.until("return !!feltgate.stylus")
        self.js("const w = document.getElementById('stylus-world'); w.value = 'mesh'; w.oninput()")
        said = self.driver.find_element(By.ID, "stylus-said").text
        self.assertIn("3072 of 3072 triangles", said)
        seen, _ = self.lead(0.004, 0.02)
        self.assertGreater(seen["force"][2], 0.3)
        count, facets = self.painted()
        self.driver.find_element(By.ID, "stylus-shading").click()
        smooth, _ = self.lead(0.004, 0.02)
        self.assertEqual(self.painted()[0], count)
        self.assertNotEqual(self.painted()[1], facets)
        self.assertNotEqual(smooth["normal"], seen["normal"])

    def test_an_edge_has_two_planes_when_it_is_asked_for(self):
        self.drop("box.glb", box_glb(3, 1, 3))
        seen, _ = self.lead(0.0295, 0.006)
        self.assertIsNone(seen["second"])
        self.assertAlmostEqual(seen["rate_hz"], 1e5)
        self.js("document.getElementById('stylus-edges').click()")
        seen, _ = self.lead(0.029, 0.006)
        self.assertAlmostEqual(seen["rate_hz"], 5e4)
        # The upper side and the right one, each in the other's place at the edge.
        normals = {tuple(round(part) for part in seen[n]) for n in ("normal", "second")}
        self.assertEqual(normals, {(0, 0, 1), (1, 0, 0)})
        self.assertGreater(min(seen["force"][0], seen["force"][2]), -1e-3)
        self.js("document.getElementById('stylus-edges').click()")
        seen, _ = self.lead(0.0295, 0.006)
        self.assertIsNone(seen["second"])

    def test_the_border_in_a_hollow_is_that_of_the_linear_loop(self):
        self.open_tab("stylus")
        self.until("return !!feltgate.stylus")
        for name, value in (("world", "floor"), ("stiffness", 1000), ("rate", 50), ("age", 12)):
            self.js(
                "const e = document.getElementById(arguments[0]);"
                "e.value = arguments[1]; e.dispatchEvent(new Event('input'))",
                f"stylus-{name}",
                value,
            )
        seen, _ = self.lead(0.01, -0.02)
        force, radius = seen["force"][2], seen["hollow"]
        self.assertGreater(radius, 1e-3)
        spring, age = force / (radius + force / 1000), 0.012 + 0.5 / 50 + 0.5e-5
        # At the border i w solves 0.599 s^2 + 6.453 s + 135 + spring e^(-s age) = 0.
        w = math.sqrt((HAND_N_M + spring) / 0.599)
        for _ in range(200):
            w = math.sqrt((HAND_N_M + spring * math.cos(w * age)) / 0.599)
        self.assertAlmostEqual(spring * math.sin(w * age) / (6.453 * w), 1, delta=2e-3)
        caption = self.driver.find_element(By.CSS_SELECTOR, "#stylus-stage .equation").text
        self.assertIn(f"in hollows below R = {1000 * radius:.1f} mm it would swing", caption)

    def test_the_page_is_small(self):
        size = PAGE.stat().st_size
        print(f"page: {size} bytes")
        self.assertLessEqual(size, MOST_BYTES)


if __name__ == "__main__":
    knob = (
        "document.getElementById('tab-stylus').click();"
        "const w = document.getElementById('stylus-world'); w.value = 'mesh'; w.oninput();"
        "feltgate.stylus.aim(0.008, 0, 0.01)"
    )
    smooth = "document.getElementById('stylus-shading').click()"
    main(taking({"knob": knob, "smooth": smooth}))
