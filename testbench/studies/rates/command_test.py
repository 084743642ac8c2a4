# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate rates as a user calls it: table, JSON and picture of a short scene; what is wrong
is told in a line, with exit code 2, and nothing is written."""

import json
import os
import sys
import unittest

from testing import BUILD, ROOT, Scratch, ran

from exploration.design_text import design_text

BUDGET = json.loads((ROOT / "docs/verification/areas.json").read_text(encoding="utf-8"))
ENGINE = f'engine {BUDGET["figures"]["lever"]["axes_engine"]["lut4_equivalents"]} LUT4 eq'
PROGRAM, OF_DEVICE = BUILD / "feltgate_lever_law", BUILD / "feltgate_two_levers_law"
SCENE = """title = "Short"
about = "A wall for some milliseconds."
duration_s = 0.03
[core]
scene = "wall"
arm_s = 0.001
[parameters]
wall_contact = 5
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [{ kind = "ramp", duration_s = 0.03, to_rad = 0.05 }]
"""
LEVERS = """title = "Short levers"
about = "Two levers parted for some milliseconds."
duration_s = 0.03
device = "two_levers"
[core]
scene = "law"
law = "coupled_levers"
arm_s = 0.001
[hand]
[[hand.phase]]
kind = "prescribed"
motion = [{ kind = "ramp", duration_s = 0.03, to_rad = 0.05 }]
[[expect]]
figure = "faults"
high = 0
[[expect]]
figure = "theta_rad.0.end"
high = 0.01
"""
SOFT = SCENE.replace("wall_contact = 5", "wall_contact = 0.005\nwall_stiffness = 0.001534\nwall_damping = 0")
NO_TORQUE = SCENE.replace('"wall"', '"free"').replace("[parameters]\nwall_contact = 5\n", "")


class Rates(Scratch):
    def setUp(self):
        super().setUp()
        self.put("short.toml", SCENE)
        self.put("levers.toml", LEVERS)
        self.put("lawless.toml", LEVERS.replace('law = "coupled_levers"\n', ""))
        self.put("free.toml", NO_TORQUE)

    def call(self, *words, program=PROGRAM):
        environment = {**os.environ, "FELTGATE_PYTHON": sys.executable}
        return ran(program, "rates", *words, cwd=self.folder, env=environment)

    def test_everything_is_written(self):
        done = self.call(
            *("short.toml", "--rate", "1000,10000", "--json", "a.json", "-o", "a.svg"),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("1 kHz", "10 kHz", "1 MHz", "block", "48 of 50000", "48 of 50", ENGINE):
            self.assertIn(word, done.stdout)
        data = json.loads((self.folder / "a.json").read_text(encoding="utf-8"))
        self.assertEqual(data["schema"], "feltgate-rates/1")
        (scene,) = data["scenes"]
        self.assertEqual([r["rate_hz"] for r in scene["rates"]], [1e3, 1e4, 1e6, 1e6])
        for rate in scene["rates"]:
            self.assertGreater(rate["ticks_compared"], 20_000)
            self.assertGreater(rate["error_rms_nm"], 1e-4)
        self.assertEqual([r["by"] for r in scene["rates"]], ["engine", "engine", "engine", "block"])
        svg = (self.folder / "a.svg").read_text(encoding="utf-8")
        self.assertIn("torque error, mNm", svg)
        self.assertIn("border / scene", svg)

    def design(self, name, **changes):
        return self.put(name, design_text(ROOT, {"base": "lever", "set": changes}))

    def told(self, *words):
        done = self.call(*words, "--quiet", "--json", "a.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / "a.json").read_text(encoding="utf-8"))["scenes"][0]

    def test_designs_beside_have_the_bits_velocity_and_margin(self):
        """A design's estimate in double against the bits of `lever` with its cut-off in a register."""
        quick = self.design("quick.toml", **{"velocity.cutoff_rad_s": 950})
        slow = self.design("slow.toml", **{"clock.tick_hz": 500_000, "velocity.m1": 384, "velocity.gain": "exact"})
        own = self.put("own.toml", SCENE.replace("wall_contact = 5", "wall_contact = 5\nvelocity_a1 = 9.495489e-4"))
        # A tick longer than a PWM period: a margin, and that of a wall that is sampled 100 times as rarely.
        rare = self.design("rare.toml", **{"clock.tick_hz": 10_000, "velocity.m1": 8, "velocity.gain": "exact"})
        scene = self.told("short.toml", "--rate", "1000,1000000", "--beside", f"lever,{quick},{slow},{rare}")
        in_a_register = self.told(own, "--rate", "1000,1000000")
        lever, other, half, tenth = scene["beside"]
        self.assertTrue(0.6 * lever["margins"][-1] < tenth["margins"][-1] < lever["margins"][-1])
        for found, whole in ((lever, scene), (other, in_a_register)):
            for key in ("counts_alone_rms_nm", "counts_alone_max_nm"):
                self.assertAlmostEqual(found[key] / whole[key], 1, delta=1e-3)
            for ours, row in zip(found["margins"], whole["rates"], strict=True):
                self.assertAlmostEqual(ours / row["margin"], 1, delta=2e-3)
        self.assertGreater(other["margins"][-1], 1.1 * lever["margins"][-1])
        # Half the ticks, the same window: the same loop but for half a microsecond; no law at 1 MHz.
        self.assertAlmostEqual(half["counts_alone_rms_nm"] / lever["counts_alone_rms_nm"], 1, delta=0.01)
        self.assertIsNone(half["margins"][1])
        self.assertAlmostEqual(half["margins"][0] / lever["margins"][0], 1, delta=0.01)

    def test_a_scenes_own_cut_off_is_in_the_margin_of_its_states(self):
        damped = "let slow = lowpass(position, 100 Hz)\nout torque = -(2 mNm s/rad) * velocity - (1 Nm/rad) * slow\n"
        self.put("damped.law", damped)
        law = SCENE.replace('"wall"', '"law"\nlaw = "damped.law"').replace("wall_contact = 5", "velocity_a1 = 9.495489e-4")
        with_own = self.put("with.toml", law)
        without = self.put("without.toml", law.replace("[parameters]\nvelocity_a1 = 9.495489e-4\n", ""))
        quick = self.design("quick.toml", **{"velocity.cutoff_rad_s": 950})
        plain = self.told(without, "--rate", "10000", "--beside", quick)
        own = self.told(with_own, "--rate", "10000")
        for row, ours, lever in zip(own["rates"], plain["beside"][0]["margins"], plain["rates"], strict=True):
            self.assertEqual(row["border_of"], "torque")
            self.assertAlmostEqual(row["margin"] / ours, 1, delta=0.02)
            self.assertGreater(abs(row["margin"] / lever["margin"] - 1), 0.05)

    def test_a_device_has_its_axes_and_what_is_kept(self):
        done = self.call(
            *("levers.toml", "--rate", "144,10000", "--json", "a.json", "-o", "a.svg"),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("device two_levers, 2 axes", "144 Hz", "10 kHz", "1 of 2", "at its steepest"):
            self.assertIn(word, done.stdout)
        self.assertIn("not kept at 144 Hz: theta_rad.0.end = 0.04", done.stdout)
        (scene,) = json.loads((self.folder / "a.json").read_text(encoding="utf-8"))["scenes"]
        self.assertEqual((scene["device"], scene["axes"]), ("two_levers", 2))
        self.assertNotIn("plant", scene)
        self.assertEqual([round(r["rate_hz"]) for r in scene["rates"][:2]], [144, 10_000])
        for rate in scene["rates"]:
            self.assertEqual(len(rate["axes"]), 2)
            of_axes = [axis["error_max_nm"] for axis in rate["axes"]]
            self.assertEqual(max(of_axes), rate["error_max_nm"])
            self.assertGreater(min(of_axes), 0)
            self.assertEqual((rate["expected"], len(rate["broken"])), (2, 1))
            # Against each other the levers feel twice the law's stiffness.
            self.assertEqual(rate["border_of"], "stiffness")
            whole = rate["margin"] * scene["stiffness_nm_rad"]
            self.assertAlmostEqual(rate["border"], whole, delta=1e-3 * whole)
        margins = [rate["margin"] for rate in scene["rates"]]
        self.assertEqual(margins, sorted(margins))
        slow, fast = scene["rates"][0], scene["rates"][-1]
        self.assertGreater(slow["error_rms_nm"], 3 * fast["error_rms_nm"])
        svg = (self.folder / "a.svg").read_text(encoding="utf-8")
        for word in ("torque error, mNm", "border / scene", "swing, mNm"):
            self.assertIn(word, svg)

    def test_stability_of_a_scene_is_the_same_by_eigenvalues_and_bits(self):
        self.put("soft.toml", SOFT)
        environment = {**os.environ, "FELTGATE_PYTHON": sys.executable}
        done = ran(PROGRAM, "stability", "soft.toml", "--json", "a.json", cwd=self.folder, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        for word in ("factor on the torque", "alone", "law wall at 1 MHz"):
            self.assertIn(word, done.stdout)
        (scene,) = json.loads((self.folder / "a.json").read_text(encoding="utf-8"))["scenes"]
        (gain,) = scene["gains"]
        # A wall without damping in its law: docs/speed-for-accuracy.md has 6.1 Nm/rad where that is 1 mNms/rad.
        self.assertTrue(5 < gain["linear"] < 8, gain)
        self.assertLess(abs(gain["bits"] / gain["linear"] - 1), 0.05, gain)
        self.assertTrue(gain["large"])
        done = ran(PROGRAM, "stability", "soft.toml", "--no-bits", cwd=self.folder, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)

    def test_rtl_and_twin_are_equal_at_every_rate(self):
        self.put("short.toml", SCENE.replace("duration_s = 0.03\n[core]", "duration_s = 0.015\n[core]"))
        done = self.ended(self.call("short.toml", "--rate", "144,10000", "--lock-step", "--json", "-"))
        (scene,) = json.loads(done.stdout)["scenes"]
        # 6940 ticks are beyond the engine's divider, so two of its runs make an update.
        self.assertEqual([r.get("runs") for r in scene["rates"]], [2, 1, 1, None])
        for row in scene["rates"]:
            self.assertEqual(row["mismatches"], 0)
            self.assertGreater(row["clocks_compared"], 700_000)

    def test_rtl_and_twin_of_a_device_are_equal(self):
        short = LEVERS.replace("duration_s = 0.03\n", "duration_s = 0.015\n", 1)
        (self.folder / "levers.toml").write_text(short, encoding="utf-8")
        done = self.call(
            *("levers.toml", "--rate", "144", "--lock-step", "--json", "-"), program=OF_DEVICE
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        (scene,) = json.loads(done.stdout)["scenes"]
        self.assertEqual([r["runs"] for r in scene["rates"]], [2, 1])
        for row in scene["rates"]:
            self.assertEqual((row["mismatches"], row["clocks_compared"]), (0, 750_000))

    def test_bad_input_is_told_in_a_line(self):
        for words, told in (
            (("nosuch",), "nosuch"),
            (("levers.toml", "--plant", "linear"), "levers.toml names a device; leave it out"),
            (("lawless.toml",), "lawless.toml:6: a device of several axes needs a law"),
            (("levers.toml", "--lock-step"), "of two_levers_law is not in this program"),
            (("free.toml",), "free.toml:5: the scene renders no torque law"),
            (("short.toml", "--rate", "nan"), "--rate"),
            (("short.toml", "-o", "none/a.svg"), "none"),
            (("short.toml", "--json", "short.toml"), "short.toml"),
        ):
            with self.subTest(words=words):
                done = self.ended(self.call(*words), 2, told)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
