#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Every verb of feltgate host on a pseudo-terminal: a board in software, with and without noise,
and the session of docs/host.md."""

import csv
import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time
import unittest

from board_process import BoardProcess
from host_program import BUILD, ROOT, ProgramTest, patterns_of
from testing import ran

PAGE = ROOT / "docs/host.md"
# The picture needs Debian's matplotlib.
PYTHON = "/usr/bin/python3" if os.access("/usr/bin/python3", os.X_OK) else sys.executable
BANNER = "*** SIMULATED: no board, no motor; these values come from a model ***\n"


class VerbTest(ProgramTest):
    def command(self, port, *words):
        return [str(BUILD / "feltgate_host"), port, *map(str, words)]

    def environment(self):
        return super().environment() | {"FELTGATE_PYTHON": PYTHON}

    def start(self, port, *words, **more):
        return self.start_program("feltgate_host", port, *words, **more)

    def host(self, port, *words, status=0):
        return self.run_program("feltgate_host", port, *words, status=status)

    def path(self, name):
        return self.folder / name


class Session(VerbTest):
    def test_the_page(self):
        blocks = re.findall(r"```console\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
        self.assertGreater(len(blocks), 4)
        lines = 0
        with BoardProcess() as board:
            for block in blocks:
                for part in re.split(r"^\$ ", block, flags=re.M)[1:]:
                    line, _, shown = part.partition("\n")
                    words = shlex.split(line)
                    self.assertEqual(words[:3], ["./feltgate", "host", "/dev/ttyUSB0"])
                    with self.subTest(line):
                        done = ran(
                            *self.command(board.port, *words[3:]),
                            env=self.environment(),
                            cwd=self.folder,
                            timeout=60,
                        )
                        said = done.stderr + done.stdout
                        said = said.replace(board.port, "/dev/ttyUSB0")
                        if "waiting for" not in said:  # the trigger came before the first look
                            shown = re.sub(r"waiting for .*\n", "", shown)
                        self.assertEqual(patterns_of(said), patterns_of(shown))
                    lines += 1
        self.assertGreater(lines, 8)


class Verbs(VerbTest):
    def test_info_is_json_too_and_a_fault_is_exit_code_1(self):
        with BoardProcess() as board:
            self.host(board.port, "info", "--json", self.path("info.json"))
            found = json.loads(self.path("info.json").read_text(encoding="utf-8"))
            self.assertEqual(found["schema"], "feltgate-host-info/1")
            self.assertEqual((found["design"], found["simulated"]), ("lever", True))
            board.order("fault 2")
            said = self.host(board.port, "info", status=1)
            self.assertIn("fault speed (the first): |w| above the limit", said)

    def test_another_design(self):
        with BoardProcess() as board:
            board.order("crc 7")
            self.assertIn("design    unknown", self.host(board.port, "info"))
            said = self.host(board.port, "get", "angle", status=2)
            self.assertIn("give its file: --design FILE", said)
            said = self.host(board.port, "--design", "lever", "get", "angle", status=2)
            self.assertIn("the board's 0x00000007", said)
        with BoardProcess() as board:
            said = self.host(board.port, "get", "angle", "--design", "paper", status=2)
            self.assertIn("which is lever: leave --design out", said)

    def test_values(self):
        with BoardProcess() as board:
            said = self.host(board.port, "get", "--all", "--json", self.path("all.json"))
            for name in (
                "torque_limit",
                "velocity",
                "status.refused",
                "control.filter",
                "frames_bad",
            ):
                self.assertRegex(said, rf"(?m)^{name} ")
            found = json.loads(self.path("all.json").read_text(encoding="utf-8"))
            self.assertEqual(found["values"]["torque_limit"], {"value": 0.5, "unit": "Nm"})
            said = self.host(board.port, "set", "hold_time=1s", "ramp_step=2Nm/s")
            self.assertIn("hold_time = 977 1024 ticks", said)
            before = board.order("word 0x18")
            self.host(board.port, "set", "torque_limit=0.2", "torque_limit=99", status=2)
            self.assertEqual(board.order("word 0x18"), before)
            self.host(board.port, "arm", "wall")
            said = self.host(board.port, "set", "voltage_gain=0.3", "torque_limit=0.2", status=1)
            self.assertIn("voltage_gain: refused, stays 0.41999", said)
            self.assertIn("torque_limit = 0.19999", said)
            self.host(board.port, "disarm")
            self.host(board.port, "scene", "membrane")
            self.assertIn("scene membrane", self.host(board.port, "info"))
            self.host(board.port, "zero")
            self.assertIn("is not built", self.host(board.port, "scene", "nowhere", status=2))

    def test_holding_kicks_and_every_way_out_disarms(self):
        for end in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with BoardProcess() as board, self.subTest(end):
                held = self.start(board.port, "arm", "wall", "--hold")
                self.assertEqual(held.stdout.readline(), BANNER)
                self.assertIn("armed", held.stdout.readline())
                time.sleep(0.3)
                self.assertEqual(board.order("armed?"), "1")
                self.assertGreater(int(board.order("kicks?")), 8)
                held.send_signal(end)
                out, err = held.communicate(timeout=10)
                self.assertEqual((held.returncode, out, err), (0, "disarmed\n", ""))
                self.assertEqual(board.order("armed?"), "0")

    def test_a_fault_ends_a_hold(self):
        with BoardProcess() as board:
            held = self.start(board.port, "arm", "wall", "--hold")
            held.stdout.readline(), held.stdout.readline()
            board.order("fault 2")
            _, err = held.communicate(timeout=10)
            self.assertEqual(held.returncode, 1)
            self.assertIn("the motor is off\n  fault speed (the first)", err)

    def test_watch_adopts_what_the_host_armed(self):
        with BoardProcess() as board:
            self.host(board.port, "arm", "wall")
            kicks = int(board.order("kicks?"))
            self.host(board.port, "watch", "--for", 0.3)
            self.assertGreater(int(board.order("kicks?")), kicks + 4)
            self.assertEqual(board.order("armed?"), "0")
            self.assertEqual(board.order("word 0x1011"), "0")  # the stream is off again

    def test_watch_disarms_when_its_reader_goes(self):
        with BoardProcess() as board:
            watched = self.start(board.port, "watch", "--arm", "wall", "--for", 30, "--every", 0.01)
            watched.stdout.readline(), watched.stdout.readline()
            self.assertEqual(board.order("armed?"), "1")
            watched.stdout.close()
            watched.wait(10)
            watched.stderr.close()
            self.assertEqual(board.order("armed?"), "0")

    def test_calibrate_keeps_its_readings_when_the_motor_goes_off(self):
        with BoardProcess() as board:
            words = ("calibrate", "--closed", "--points", "0.05,0.1", "--save", "kept.csv")
            process = self.start(board.port, *words, stdin=subprocess.PIPE)
            process.stdin.write("0.049\n")
            process.stdin.flush()
            said = ""
            while "2/2" not in said:
                said += process.stdout.read(1)
            board.order("fault 2")
            _, err = process.communicate(timeout=20)
            self.assertEqual(process.returncode, 1, err)
            self.assertIn("1 readings are in kept.csv", err)
            rows = (self.folder / "kept.csv").read_text(encoding="utf-8").splitlines()
            self.assertEqual(len(rows), 2)
            self.assertTrue(rows[1].startswith("0.05,0.049,"))

    def test_capture_csv_picture_and_vector(self):
        with BoardProcess() as board:
            self.host(
                board.port, "capture", "angle", "velocity", "--trigger", "angle<-5deg",
                "--span", 0.1, "--csv", "c.csv", "--picture", "c.svg", "--vector", "c.vec",
                "--arm", "wall",
            )  # fmt: skip
            with open(self.path("c.csv"), encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(list(rows[0]), ["time_s", "angle_rad", "velocity_rad_s", "position"])
            self.assertEqual(len(rows), 1024)
            self.assertEqual(float(rows[256]["time_s"]), 0)
            self.assertGreater(float(rows[200]["angle_rad"]), -0.0873)
            self.assertLess(float(rows[256]["angle_rad"]), -0.086)
            self.assertIn("SIMULATED", self.path("c.svg").read_text(encoding="utf-8"))
            vector = self.path("c.vec").read_text(encoding="utf-8").splitlines()
            head = "feltgate-vector 1 design=lever clock_hz=50000000"
            self.assertTrue(vector[0].startswith(head))
            self.assertEqual(board.order("armed?"), "0")
            self.host(
                board.port, "capture", "angle", "tau_ref", "--csv", "xy.csv",
                "--picture", "xy.png", "--xy", "angle,tau_ref",
            )  # fmt: skip
            self.assertEqual(self.path("xy.png").read_bytes()[1:4], b"PNG")
            running = self.start(
                board.port, "capture", "angle", "--arm", "wall", "--trigger", "fault:speed",
                "--csv", "f.csv",
            )  # fmt: skip
            while "waiting" not in running.stderr.readline():
                pass
            board.order("fault 2")
            _, err = running.communicate(timeout=20)
            self.assertEqual(running.returncode, 1)
            self.assertIn("the motor went off meanwhile\n  fault speed (the first)", err)
            self.assertTrue(self.path("f.csv").exists())
            self.host(board.port, "clear")
            said = self.host(
                board.port, "capture", "--trigger", "velocity>900", "--wait", 0.3, "--csv", "n.csv",
                status=1,
            )  # fmt: skip
            self.assertIn("did not come within 0.3 s; nothing is written", said)
            self.assertFalse(self.path("n.csv").exists())


class Trouble(VerbTest):
    def test_silence(self):
        with BoardProcess() as board:
            board.order("silent")
            said = self.host(board.port, "--patience", 0.5, "info", status=3)
            self.assertIn("no answer for 0.5 s", said)
            board.order("loud")
            self.host(board.port, "info")

    def test_the_cable_is_pulled(self):
        capture = ("capture", "--trigger", "velocity>99")
        for verb in (("arm", "wall", "--hold"), ("watch",), capture):
            with BoardProcess() as board, self.subTest(verb[0]):
                running = self.start(board.port, "--patience", 0.5, *verb)
                time.sleep(0.6)
                board.order("unplug")
                _, err = running.communicate(timeout=20)
                self.assertEqual(running.returncode, 3, err)
                self.assertRegex(err, "the port went away|no answer")

    def test_two_hosts_on_one_port(self):
        with BoardProcess() as board:
            first = self.start(board.port, "watch", "--for", 5)
            self.assertEqual(first.stdout.readline(), BANNER)
            said = self.host(board.port, "info", status=2)
            self.assertIn(f"is in use by feltgate_host (pid {first.pid})", said)
            first.send_signal(signal.SIGINT)
            first.communicate(timeout=10)
            self.assertEqual(first.returncode, 0)
            self.host(board.port, "info")


if __name__ == "__main__":
    unittest.main()
