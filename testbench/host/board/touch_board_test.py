#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A mesh under the pen of a board in software: the forces that the board's engine asks for, against
the sphere that the mesh stands for, and what is refused. Documentation: docs/touch.md"""

import csv
import json
import math
import signal
import subprocess
import unittest

from board_process import board_program, need_terminals
from host_program import ROOT, ProgramTest

RADIUS_M, STIFFNESS_N_M = 0.03, 300
# To and fro over the top of the ball, 3 mm deep at most; the pen is free at both ends.
HAND = """[hand]
start_m = [0.016, 0, 0.027]
[[hand.phase]]
kind = "prescribed"
x = [
  { kind = "sine", amplitude_m = 0.016, frequency_hz = 5, phase_rad = 1.5707963, duration_s = 1000 },
]
y = [{ kind = "hold", duration_s = 1000 }]
z = [{ kind = "hold", duration_s = 1000 }]
"""


class TouchBoard(ProgramTest):
    def board(self, *words):
        need_terminals()
        process = self.start_program(board_program(words), *words, stderr=subprocess.STDOUT)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process, process.stdout.readline().strip()

    def stylus(self):
        scene = (ROOT / "vectors/scenes/stylus_sphere.toml").read_text(encoding="utf-8")
        begin = scene.index("[hand]")
        end = scene.index("]\n\n", begin) + 2
        (self.folder / "over.toml").write_text(scene[:begin] + HAND + scene[end:], encoding="utf-8")
        words = ("--design", "stylus_law", "--hand", "over.toml", "--baud", "3000000")
        return self.board(*words)

    def touch(self, *words, **how):
        return self.run_program("feltgate_touch", "touch", *words, **how)

    def felt(self, port, *words, deep_m=0):
        """What a session told; a longer one where the board was too slow on a busy machine."""
        for seconds in (1, 4, 16, 48):
            at = ("--board", port, "--baud", 3000000, "--for", f"{seconds} s")
            said = self.touch("ball.glb", *at, "--json", "felt.json", *words)
            told = json.loads((self.folder / "felt.json").read_text(encoding="utf-8"))
            if told["planes"] > 40 and told["depth_m"] >= deep_m:
                return told, said
        self.fail(f"after 48 s: {told}")

    def setUp(self):
        super().setUp()
        self.touch("--make", "ball", "--faces", 20480, "-o", "ball.glb")

    def test_the_pen_feels_the_sphere(self):
        _, port = self.stylus()
        told, said = self.felt(port, "--shading", "--csv", "felt.csv", deep_m=2.8e-3)
        self.assertIn("0 frames lost on the line", said)
        self.assertEqual((told["lost_frames"], told["dropped"], told["rate_hz"]), (0, 0, 1000))
        with open(self.folder / "felt.csv", encoding="utf-8", newline="") as rows:
            felt = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(rows)]
        deep = free = 0
        for row in felt:
            pen = [row[f"pen_{axis}_m"] for axis in "xyz"]
            force = [row[f"force_{axis}_n"] for axis in "xyz"]
            far = math.hypot(*pen)
            newton = math.hypot(*force)
            if far > RADIUS_M + 1e-3:
                free += 1
                # The plane in force may be of a pose that was nearer.
                self.assertLess(newton, 0.05, row)
            elif far < RADIUS_M - 1e-3:
                deep += 1
                self.assertAlmostEqual(newton, STIFFNESS_N_M * (RADIUS_M - far), delta=0.06)
                turn = math.acos(sum(a * b for a, b in zip(pen, force, strict=True)) / far / newton)
                # 0.47 m/s over 27 mm, for as long as it takes to hear of the pose and to answer.
                self.assertLess(turn, 0.15, row)
        print(f"{len(felt)} poses, {deep} deep, {free} free, {told['overtaken']} overtaken")
        self.assertGreater(deep, 10)
        self.assertGreater(free, 5)

    def test_afterwards_the_motors_are_off_and_no_speed_is_left(self):
        _, port = self.stylus()
        names = "time_s,x_m,y_m,z_m,turn_x_rad,turn_y_rad,turn_z_rad,scale"
        rows = (names, "0,0,0,-0.1,0,0,0,1", "60,0,0,-0.04,0,0,0,1")
        (self.folder / "rises.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
        self.felt(port, "--motion", "rises.csv")
        for verb, needle in (("info", "disarmed"), ("law", "speed_z              0.00100")):
            said = self.run_program("feltgate_host", "--baud", 3000000, port, verb)
            self.assertIn(needle, said)
        self.felt(port, "--material", "none=stone")
        said = self.run_program("feltgate_host", "--baud", 3000000, port, "law")
        self.assertIn("law local_vibration", said)
        # Nothing of the law before refuses a plane of this one.
        told, _ = self.felt(port, deep_m=2e-3)
        self.assertGreater(told["force_n"], 0.3)
        said = self.run_program("feltgate_host", "--baud", 3000000, port, "law")
        self.assertIn("law local_space", said)
        self.assertIn("speed_z              0 m/s", said)

    def test_a_board_that_goes_away(self):
        board, port = self.stylus()
        words = ("touch", "ball.glb", "--board", port, "--baud", 3000000)
        touching = self.start_program("feltgate_touch", *words)
        self.addCleanup(touching.kill)
        for line in touching.stderr:
            if "pen " in line:
                break
        board.send_signal(signal.SIGKILL)
        _, said = touching.communicate(timeout=60)
        self.assertEqual(touching.returncode, 3, said)


if __name__ == "__main__":
    unittest.main()
