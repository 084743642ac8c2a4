# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The numbers of the Python package are those of the program, bit by bit."""

import csv
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from testing import BUILD, ROOT, Scratch

import feltgate

PROGRAM = BUILD / "feltgate"
# The program prints the plant's values with nine digits, the core's whole.
ROUNDED = ("theta_rad", "omega_rad_s", "motor_torque_nm", "hand_torque_nm", "hand_felt_nm")
ENGINES = "twin,float,double,quad"


def printed(*words):
    """Columns of the CSV that the program writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "rows.csv"
        subprocess.run([PROGRAM, *words, "--quiet", "--csv", path], check=True)
        with open(path, encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    return {name: [row[name] for row in rows] for name in rows[0]}


class Bits(Scratch):
    def same(self, result, columns):
        table = result.table()
        self.assertEqual(list(table), list(columns))
        for name, texts in columns.items():
            values = table[name]
            if name in ROUNDED:
                values = [float(f"{value:.9g}") for value in values]
            self.assertEqual(len(values), len(texts), name)
            np.testing.assert_array_equal(values, [float(text) for text in texts], name)

    def test_a_scene_in_every_arithmetic(self):
        columns = printed("run", "torque_step_cord", "--engine", ENGINES, "--every", "7")
        result = feltgate.run("torque_step_cord", engine=ENGINES, every=7)
        self.same(result, columns)
        self.assertGreater(np.max(np.abs(result["twin"].torque_nm)), 0.01)
        self.assertTrue(np.any(result["twin"].velocity_rad_s != result["quad"].velocity_rad_s))

    def test_another_design_and_a_parameter(self):
        columns = printed("run", "torque_step_cord", "--engine", "twin", "--design", "paper",
                          "--set", "voltage_gain=0.9", "--every", "50")
        self.same(feltgate.run("torque_step_cord", "paper", "twin", every=50,
                               set={"voltage_gain": 0.9}), columns)

    def test_a_hand_as_an_array_is_a_scene_with_a_trace(self):
        time_s = np.linspace(0, 0.2, 101)
        angle_rad = 0.5 * np.sin(2 * np.pi * time_s / 0.4) ** 2
        rows = "".join(f"{t!r},{a!r}\n" for t, a in zip(time_s.tolist(), angle_rad.tolist()))
        self.put("own.csv", "time_s,theta_rad\n" + rows)
        scene = self.put("own.toml", 'title = "own"\nabout = "own"\nduration_s = 0.2\n'
                                     '[core]\nscene = "spring_tension"\narm_s = 0.05\n'
                                     '[[hand.phase]]\nkind = "trace"\nfile = "own.csv"\n')
        columns = printed("run", scene, "--engine", "twin", "--every", "20")
        result = feltgate.run("spring_tension", engine="twin", every=20, hand=(time_s, angle_rad))
        self.same(result, columns)
        self.assertLess(result.tau_ref_nm.min(), -0.1)

    def test_a_recording(self):
        path = ROOT / "vectors/traces/damper.vec"
        columns = printed("replay", path, "--scene", "damper", "--engine", ENGINES,
                          "--every", "500")
        for recording in (path, feltgate.Recording(path)):
            self.same(feltgate.replay(recording, engine=ENGINES, scene="damper", every=500),
                      columns)

    def test_twin_and_chain_agree_in_every_tick(self):
        rng = np.random.default_rng(1)
        counts = np.cumsum(rng.integers(-1, 2, 20_000))
        twin = feltgate.Twin("lever")
        first = twin.run(counts[:1000])
        stiffness = 0.3 * feltgate.count_rad()
        twin.set(tension_stiffness=stiffness, self_test_pulse=0)
        out = twin.arm("spring_tension").run(counts[1000:])
        np.testing.assert_array_equal(out.position[1:], counts[1000:-1])
        position = np.concatenate((first.position, out.position))
        armed = np.concatenate((first.armed, out.armed)).astype(bool)
        start = int(np.argmax(armed))
        self.assertTrue(1000 < start < 1010 and armed[start:].all())
        chain = feltgate.Chain("lever", "fixed").set(tension_stiffness=stiffness)
        before = chain.run(position[:start], "free", armed=False)
        after = chain.run(position[start:], "spring_tension")
        for name in before:
            of_twin = np.concatenate((first[name], out[name]))
            of_chain = np.concatenate((before[name], after[name]))
            np.testing.assert_array_equal(of_twin, of_chain, name)


if __name__ == "__main__":
    unittest.main()
