# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the Python package gives a user: columns, hands, plants, recordings, errors, Ctrl-C."""

import filecmp
import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
from testing import ROOT, Scratch, ran

import feltgate

SCENE = "torque_step_cord"


class Columns(unittest.TestCase):
    def test_one_engine_has_the_columns_of_the_base(self):
        result = feltgate.run(SCENE, engine="float", every=1000)
        self.assertIs(result["float"].velocity_rad_s, result.velocity_rad_s)
        with self.assertRaisesRegex(AttributeError, "no column"):
            result.velocity

    def test_what_the_first_page_prints(self):
        """The error beside a bound is that of the ticks for which it holds; the rest is told."""
        page = (ROOT / "README.md").read_text(encoding="utf-8")
        code = re.search(r"^## In Python\n.*?^```python\n(.*?)^```", page, re.M | re.S)[1]
        with tempfile.TemporaryDirectory() as folder:
            done = ran(sys.executable, "-c", code, cwd=folder, check=True)
            self.assertTrue(list(Path(folder).glob("*.png")))
        self.assertLessEqual(len(code.splitlines()), 12)
        proven, outside = done.stdout.splitlines()
        error, bound = re.fullmatch(r"(\S+) Nm, proven: (\S+)", proven).groups()
        self.assertGreater(float(error), 0)
        self.assertLessEqual(float(error), float(bound))
        worse, ticks = re.match(r"(\S+) Nm in the (\d+) ticks of a ramp", outside).groups()
        self.assertGreater(float(worse), float(bound))  # its first force ramps
        self.assertGreater(int(ticks), 0)

    def test_what_was_felt_and_the_bounds(self):
        result = feltgate.run("wall")
        self.assertEqual(result.broken, [])
        self.assertTrue(all(e.kept for e in result.felt.expectations))
        self.assertAlmostEqual(result.felt.asked_nm.value, -0.4, delta=0.01)
        self.assertIn("gates_closed", result.felt.limits)
        for name, error in result["twin"].errors.items():
            self.assertLessEqual(error.max, result.bounds[name], name)
            self.assertGreater(error.max, 0, name)
        self.assertIsNone(feltgate.run(SCENE, engine="twin").bounds)

    def test_bounds_of_a_design(self):
        small = feltgate.bounds("lever", "spring_tension", velocity_rad_s=1.0)
        self.assertLess(small["torque_nm"], feltgate.bounds("lever")["torque_nm"])
        self.assertLess(small["velocity_rad_s"], feltgate.bounds("paper")["velocity_rad_s"] * 100)


class Hands(Scratch):
    time_s = np.linspace(0, 0.1, 201)

    def test_motion(self):
        angle_rad = 0.3 * np.sin(2 * np.pi * 5 * self.time_s) ** 2  # at rest at both ends
        result = feltgate.run("spring_tension", engine="twin", hand=(self.time_s, angle_rad))
        self.assertAlmostEqual(result.simulated_s, 0.1)
        expected = np.interp(result.time_s, self.time_s, angle_rad)
        np.testing.assert_allclose(result.theta_rad, expected, atol=2e-4)

    def test_a_function_of_the_time(self):
        def motion(time_s):
            return 0.3 * np.sin(2 * np.pi * 5 * time_s)
        result = feltgate.run("spring_tension", engine="twin", hand=motion, duration_s=0.1)
        self.assertAlmostEqual(result.simulated_s, 0.1)
        self.assertAlmostEqual(result.theta_rad.max(), 0.3, places=3)

    def test_a_jump_of_the_speed_is_a_warning(self):
        path = self.put("jump.toml", 'title = "t"\nabout = "a"\nduration_s = 0.02\n'
                        '[core]\nscene = "free"\n[[hand.phase]]\nkind = "prescribed"\n'
                        'motion = [{ kind = "ramp", duration_s = 0.02, to_rad = 0.02 }]\n')
        with self.assertWarnsRegex(UserWarning, r"jump.toml:8: the hand's speed jumps by 1 "):
            feltgate.run(path, engine="twin")

    def test_impedance_yields(self):
        angle_rad = np.linspace(0, 0.5, self.time_s.size)
        stiff = feltgate.Hand.impedance(self.time_s, angle_rad, stiffness_n_m=2000.0)
        soft = feltgate.Hand.impedance(self.time_s, angle_rad, stiffness_n_m=20.0)
        ends = [feltgate.run("spring_tension", engine="twin", hand=h).theta_rad[-1]
                for h in (stiff, soft)]
        self.assertGreater(ends[0], ends[1] + 0.01)


class Parts(unittest.TestCase):
    def test_plant(self):
        plant = feltgate.Plant("p24", set={"lever.inertia_kg_m2": 5e-4})
        self.assertEqual(plant.parameters["lever.inertia_kg_m2"], 5e-4)
        heavy, light = (p.run(np.full(4000, 0.1)) for p in (plant, feltgate.Plant("p24")))
        self.assertAlmostEqual(heavy.time_s[-1], 0.002)
        self.assertGreater(light.omega_rad_s[-1], 2 * heavy.omega_rad_s[-1])
        self.assertEqual(heavy.counts[-1], plant.counts)
        slow = feltgate.run(SCENE, engine="twin", plant=plant)
        self.assertNotEqual(slow.theta_rad.max(),
                            feltgate.run(SCENE, engine="twin").theta_rad.max())

    def test_a_recording_warns(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "log.csv"
            rows = "".join(f"{5 * n},{(65530 + n) % 65536}\n" for n in range(20))
            path.write_text("time,count\n" + rows)
            with self.assertWarnsRegex(UserWarning, "--wrap 65536"):
                feltgate.Recording(path, time_unit="ms")
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                for wrap in (True, 65536, "65536"):
                    recording = feltgate.Recording(path, time_unit="ms", wrap=wrap)
                    self.assertEqual((len(recording), recording.counts[-1]), (19, 19))
                    self.assertAlmostEqual(recording.length_s, 0.095)

    def test_counts_of_your_own(self):
        counts = np.repeat(np.arange(50), 20)
        result = feltgate.replay(counts, engine="twin,double", scene="spring_tension", every=1)
        self.assertEqual(round(result.position_rad.max() / (2 * np.pi / 4096)), 49)
        self.assertEqual(result.reference, "double")
        self.assertNotIn("theta_rad", result)

    def test_chain_arithmetics(self):
        counts = np.arange(30_000) // 10
        exact = feltgate.Chain("lever", "quad").run(counts, "damper")
        errors = {}
        for arithmetic in ("fixed", "float", "double"):
            chain = feltgate.Chain("lever", arithmetic)
            out = chain.run(counts, "damper")
            errors[arithmetic] = np.abs(out.velocity_rad_s - exact.velocity_rad_s).max()
            chain.reset()
            again = chain.run(counts, "damper")
            np.testing.assert_array_equal(out.tau_ref_nm, again.tau_ref_nm)
        self.assertLess(errors["double"], 1e-9)
        self.assertLess(errors["double"], errors["float"])
        self.assertLess(errors["fixed"], feltgate.bounds("lever")["velocity_rad_s"])

    def test_a_fault_and_a_stop(self):
        twin = feltgate.Twin().arm("setpoint").set(setpoint_torque=0.1)
        self.assertEqual(twin.run(np.zeros(50)).armed[-1], 1)
        self.assertEqual(twin.stop().run(np.zeros(5)).armed[-1], 0)
        self.assertNotEqual(twin.tick(0)["faults"], 0)
        twin.stop(False).clear_faults().run(np.zeros(5))
        after = twin.arm("setpoint").run(np.zeros(50))
        self.assertEqual((after.faults[-1], after.armed[-1]), (0, 1))


class Installed(unittest.TestCase):
    def test_data(self):
        names = feltgate.scenes(), feltgate.plants(), feltgate.designs()
        data = Path(feltgate.__file__).parent / "data"
        os.environ.pop("FELTGATE_ROOT")
        try:
            self.assertEqual(feltgate.root(), data)
            self.assertEqual((feltgate.scenes(), feltgate.plants(), feltgate.designs()), names)
            self.assertGreater(feltgate.run(SCENE, engine="twin").ticks, 1000)
        finally:
            os.environ["FELTGATE_ROOT"] = str(ROOT)
        for path in data.rglob("*.toml"):
            if path.stem == "narrow":  # made by the build
                continue
            self.assertTrue(filecmp.cmp(path, ROOT / path.relative_to(data), shallow=False), path)
        self.assertEqual(names[2], sorted(["narrow", *(path.stem for path in ROOT.glob("rtl/designs/*.toml"))]))


class Refused(unittest.TestCase):
    CASES = (
        ('not in vectors/scenes; did you mean "membrane"', lambda: feltgate.run("membran")),
        ('"levr" is not in rtl/designs; did you mean "lever"', lambda: feltgate.run(SCENE, "levr")),
        ('"flaot" is unknown; did you mean "float"',
         lambda: feltgate.run(SCENE, engine=["twin", "flaot"])),
        ("every is 0", lambda: feltgate.run(SCENE, every=0)),
        ("duration_s is -1", lambda: feltgate.run(SCENE, duration_s=-1, every=1)),
        ('did you mean "tension_stiffness"',
         lambda: feltgate.run(SCENE, set={"tension_stifness": 1})),
        ("does not fit its register", lambda: feltgate.Twin().set(tension_stiffness=1e9)),
        ('p25" is not in vectors/plants', lambda: feltgate.run(SCENE, plant="p25")),
        ("p24.toml:18: .*out of range",
         lambda: feltgate.Plant("p24", set={"lever.inertia_kg_m2": -1})),
        (r"angle_rad\[1\] is nan", lambda: feltgate.run(SCENE, hand=([0, 1], [0, float("nan")]))),
        (r"time_s\[1\] = 0 s is not after", lambda: feltgate.run(SCENE, hand=([0, 0], [0, 1]))),
        ("2 values and angle_rad has 3", lambda: feltgate.run(SCENE, hand=([0, 1], [0, 1, 2]))),
        ("neither a feltgate.Hand", lambda: feltgate.run(SCENE, hand="left")),
        ("at most 25 counts in a tick", lambda: feltgate.Twin().run([0, 100])),
        ("choose fixed, float, double or quad", lambda: feltgate.Chain("lever", "half")),
        (r"duty\[0\] is 2", lambda: feltgate.Plant().run([2.0])),
        ("velocity_rad_s is nan", lambda: feltgate.bounds(velocity_rad_s=float("nan"))),
        ("alone has nothing to be compared with",
         lambda: feltgate.replay([0, 1, 2], engine="double")),
    )

    def test_every_message_names_the_mend(self):
        for message, call in self.CASES:
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                call()


class Long(unittest.TestCase):
    def test_ctrl_c(self):
        code = ("import feltgate, sys\n"
                "tell = lambda done: print(done, flush=True)\n"
                "feltgate.run('membrane', engine='twin', hand=feltgate.Hand.free(),"
                " duration_s=3000, every=10**6, progress=tell)\n")
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as run:
            run.stdout.readline()
            run.send_signal(signal.SIGINT)
            _, errors = run.communicate(timeout=60)
        self.assertIn("KeyboardInterrupt", errors)


if __name__ == "__main__":
    unittest.main()
