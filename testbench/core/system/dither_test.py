# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A dither against stiction, as docs/devices/one-lever.md has it: the push at which a lever at rest gives way, and
what a hand that holds it feels of the dither. Where the hand feels 1 mNm, stiction is what it was; the torque at which
it is not shows that the measure would see it."""

import cmath
import csv
import math
import re
import unittest

from testing import BUILD, Scratch, ran, text_of

PROGRAM = BUILD / "feltgate_lever_law"
PAGE = text_of("docs/devices/one-lever.md")
HEAD = """title = "Dither"
about = "A hand, and a law that shakes."
duration_s = 1.3
[core]
scene = "law"
law = "dither.law"
arm_s = 0.02
[hand]
[[hand.phase]]
"""
PUSH = """kind = "torque"
torque = [{ kind = "hold", duration_s = 0.2 }, { kind = "ramp", to_nm = 0.01, duration_s = 1.0 }]
"""
HOLD = """kind = "impedance"
motion = [{ kind = "hold", duration_s = 1.3 }]
"""
GIVES_WAY_RAD = 0.01
ROWS = ((250, 0), (250, 2), (500, 3.8), (1000, 10), (250, 40), (500, 40), (1000, 40))


class Dither(Scratch):
    def columns(self, hand, size, often, *names):
        scene = self.put("scene.toml", HEAD + hand)
        self.ended(ran(PROGRAM, "run", scene, "--design", "lever_law", "--engine", "twin", "--quiet", "--csv",
                       self.folder / "run.csv", "--every", 100, "--set", f"size={size}mNm", "--set", f"often={often}"))
        with open(self.folder / "run.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return [[float(row[name]) for row in rows] for name in names]

    def gives_way_nm(self, size, often):
        angles, pushes = self.columns(PUSH, size, often, "theta_rad", "hand_torque_nm")
        return next(push for angle, push in zip(angles, pushes) if abs(angle - angles[0]) > GIVES_WAY_RAD)

    def felt_nm(self, size, often):
        """Amplitude of the hand's torque at the dither's frequency, over the last second."""
        times, torques = self.columns(HOLD, size, often, "time_s", "hand_torque_nm")
        sums = [torque * cmath.exp(-2j * math.pi * often * t) for t, torque in zip(times, torques) if t > 0.3]
        return 2 * abs(sum(sums)) / len(sums)

    def test_what_a_hand_does_not_feel_does_nothing(self):
        self.put("dither.law", re.search(r"```law\n(.*?)```", PAGE, re.S)[1])
        still = None
        for often, size in ROWS:
            push, felt = self.gives_way_nm(size, often), self.felt_nm(size, often)
            still = push if size == 0 else still
            print(f"| {often} | {size} | {1e3 * felt:.2f} | {1e3 * push:.2f} |", flush=True)
            if felt <= 1e-3:
                self.assertGreater(push, 0.98 * still)
        self.assertLess(self.gives_way_nm(40, 250), 0.5 * still)


if __name__ == "__main__":
    unittest.main()
