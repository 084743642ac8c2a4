#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The board without hardware behind its pseudo-terminal: the host's verbs with a motor that moves,
bad lines, hosts that vanish, two at once, recordings that run again, on the twin and on the RTL."""

import json
import random
import re
import signal
import subprocess
import time
import unittest

from board_process import board_program, need_terminals
from host_program import BUILD, ROOT, ProgramTest
from testing import ran, weekly

SLOPE, DEAD = 0.0302 / 0.42, 0.34 + 0.635  # of p24 at 50 kHz


class Board:
    """feltgate board in a process of its own."""

    def __init__(self, test, *words, kind=""):
        need_terminals()
        program = board_program(words, kind)
        self.process = test.start_program(program, *words, stderr=subprocess.STDOUT)
        self.port = self.process.stdout.readline().strip()

    def end(self):
        self.process.send_signal(signal.SIGINT)
        said = self.process.stdout.read()
        self.process.stdout.close()
        return self.process.wait(), said

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class BoardTest(ProgramTest):
    def host(self, port, *words, **how):
        return self.run_program("feltgate_host", "--patience", 20, port, *words, **how)

    def patient(self, port):
        """A watchdog of 1 s: what is no test of it must not fail on a busy machine."""
        self.host(port, "set", "watchdog_ticks=1000000")

    def value(self, port, name):
        self.host(port, "get", name, "--json", "v.json")
        text = (self.folder / "v.json").read_text(encoding="utf-8")
        return json.loads(text)["values"][name]["value"]


class Verbs(BoardTest):
    def test_a_session(self):
        (self.folder / "lever").symlink_to("/dev/pts/of-a-board-that-was-killed")
        with Board(self, "--hand", "swing", "--link", "lever") as board:
            self.assertRegex(board.port, r"^lever -> /dev/pts/\d+$")
            port = self.folder / "lever"
            self.assertIn("SIMULATED", self.host(port, "info"))
            said = self.run_program("feltgate_board", "--link", "lever", status=2)
            self.assertIn("is a link to what is there", said)
            self.host(port, "set", "torque_limit=0.1Nm")
            self.assertAlmostEqual(self.value(port, "torque_limit"), 0.1, places=4)
            self.patient(port)
            self.host(port, "arm", "spring_tension")
            self.assertEqual(self.value(port, "status.armed"), 1)
            self.host(port, "capture", "--trigger", "velocity>1", "--csv", "c.csv")
            self.assertEqual(len((self.folder / "c.csv").read_text().splitlines()), 1025)
            self.host(port, "record", "position", "--for", "2", "--csv", "r.csv")
            rows = (self.folder / "r.csv").read_text().splitlines()
            self.assertGreater(len({row.split(",")[1] for row in rows}), 50)
            self.host(port, "stop")
            self.assertIn("fault stop", self.host(port, "info", status=1))
            self.host(port, "clear")
            self.assertEqual(board.end()[0], 0)
            self.assertFalse(port.is_symlink())

    @weekly(3)
    def test_the_example_in_python(self):
        # The tests' own folder of programs lies within the build.
        places = [place / "venv-neighbours/bin/python3" for place in (BUILD, *BUILD.parents)]
        python = next((path for path in places if path.exists()), None)
        if python is None:
            self.skipTest("no pyserial; ./feltgate test fetches it")
        with Board(self, "--hand", "swing") as board:
            done = self.ended(ran(python, ROOT / "docs/examples/link.py", board.port))
            crc = re.search(r"CRC 0x(\w+)", self.host(board.port, "info"))[1]
            self.assertIn(f"design {crc}, 1000000 ticks/s", done.stdout)
            self.assertIn("status after set_zero: 0x", done.stdout)

    @weekly(3)
    def test_calibrate_finds_dead_zone_and_slope(self):
        noise = random.Random(5)
        volts = (1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5)
        typed = "".join(f"{SLOPE * (v - DEAD) + noise.gauss(0, 0.002):.4f}\n" for v in volts)
        with Board(self, "--hand", "locked") as board:
            self.patient(board.port)
            said = self.host(
                board.port, "calibrate", "--points", ",".join(map(str, volts)), "--json", "c.json",
                "--save", "c.csv", "--confidence", 0.99, "--write", "mine.toml", typed=typed,
            )  # fmt: skip
            self.assertIn("SIMULATED", said)
            found = json.loads((self.folder / "c.json").read_text(encoding="utf-8"))
            for name, truth in (("slope_nm_v", SLOPE), ("dead_voltage_v", DEAD)):
                with self.subTest(name):
                    self.assertTrue(found[name]["low"] < truth < found[name]["high"])
            # The observer of a blocked lever sees what is commanded.
            self.assertAlmostEqual(found["observer_slope_nm_v"]["value"], SLOPE, delta=2e-4)
            again = self.host("-", "calibrate", "--from", "c.csv", "--confidence", 0.99)
            self.assertEqual(again.splitlines()[1], said.splitlines()[said.splitlines().index(
                again.splitlines()[0]) + 1])  # fmt: skip
            # Closed loop: the design's constants are those of the plant.
            torques = (0.05, 0.1, 0.2, 0.3)
            typed = "".join(f"{t + noise.gauss(0, 0.001):.4f}\n" for t in torques)
            said = self.host(board.port, "calibrate", "--closed", "--points",
                             ",".join(map(str, torques)), typed=typed)  # fmt: skip
            self.assertIn("slope", said)
            self.assertEqual(self.value(board.port, "status.armed"), 0)
            self.assertEqual(self.value(board.port, "control.mode"), 0)

    @weekly(3)
    def test_identify_finds_the_motor(self):
        with Board(self) as board:
            said = self.host(board.port, "identify", status=2)
            self.assertIn("say so with --free", said)
            self.patient(board.port)
            self.host(
                board.port, "identify", "--free", "--resistance", 0.42, "--electrical-time",
                196e-6, "--json", "i.json", "--save", "lever",
            )  # fmt: skip
        found = json.loads((self.folder / "i.json").read_text(encoding="utf-8"))
        kt, r, j, friction = 0.0302, 0.42, 1.22e-4, 3.5e-3
        for name, truth in (
            ("j_r_over_kt_v_s2", j * r / kt),
            ("ke_plus_b_r_over_kt_v_s", kt + 1.5e-6 * r / kt),
            ("friction_and_dead_v", friction * r / kt + DEAD),
        ):
            with self.subTest(name):
                self.assertAlmostEqual(found["driven"][name]["value"] / truth, 1, delta=0.02)
        for name, truth in (
            ("ke_v_s_rad", kt),
            ("inertia_kg_m2", j),
            ("damping_nm_s_rad", 1.5e-6),
            ("friction_nm", friction),
            ("dead_voltage_v", DEAD),
        ):
            with self.subTest(name):
                self.assertAlmostEqual(found["constants"][name]["value"] / truth, 1, delta=0.02)
        files = ("--from", "lever.drive.csv", "--coast", "lever.coast.csv")
        self.assertIn("F/J", self.host("-", "identify", *files))


class ThreePhases(BoardTest):
    @weekly(3)
    def test_align_finds_pole_pairs_and_offset(self):
        offset_rad = 1.2
        plant = (ROOT / "vectors/plants/gimbal_motor.toml").read_text(encoding="utf-8")
        plant, found = re.subn(r"(?m)^offset_rad = 0\.0 ", f"offset_rad = {offset_rad} ", plant)
        self.assertEqual(found, 1)
        (self.folder / "turned.toml").write_text(plant, encoding="utf-8")
        with Board(self, "--design", "gimbal_motor", "--plant", "turned.toml") as board:
            self.patient(board.port)
            words = ("calibrate", "align", "--json", "a.json", "--save", "a.csv", "--write", "mine.toml")
            said = self.host(board.port, *words, "--voltage", 2, status=2)
            self.assertIn("is more than the 1.74 V with which the nominal current flows", said)
            # The board is a tenth as fast as the time.
            said = self.host(board.port, *words, timeout=600)
            self.assertIn("SIMULATED", said)
            self.assertIn("0.87 V turn the rotor", said)
            # The board has its words back, and its motor is off.
            self.assertAlmostEqual(self.value(board.port, "commutation_gain"), 11 / 16384, places=7)
            self.assertEqual(self.value(board.port, "voltage_setpoint"), 0)
            self.assertEqual(self.value(board.port, "status.armed"), 0)
            self.assertEqual(self.value(board.port, "control.mode"), 0)
        found = json.loads((self.folder / "a.json").read_text(encoding="utf-8"))
        self.assertEqual(found["whole_pole_pairs"], 11)
        self.assertAlmostEqual(found["changes"][1]["value"], offset_rad, delta=0.02)
        mine = (self.folder / "mine.toml").read_text(encoding="utf-8")
        written = float(re.search(r"(?m)^offset_rad = (\S+)", mine)[1])
        self.assertAlmostEqual(written, found["changes"][1]["value"], delta=1e-4)
        again = self.host("-", "--design", "gimbal_motor", "calibrate", "align", "--from", "a.csv")
        self.assertIn(again.splitlines()[0], said)


class Lines(BoardTest):
    def test_a_host_that_vanishes_leaves_no_motor_armed(self):
        with Board(self) as board:
            words = ("arm", "spring_tension", "--hold")
            holds = self.start_program("feltgate_host", board.port, *words)
            holds.stdout.readline()
            time.sleep(0.3)
            holds.kill()
            holds.communicate()
            time.sleep(0.3)
            self.assertEqual(self.value(board.port, "status.armed"), 0)
            self.assertIn("fault watchdog", self.host(board.port, "info", status=1))


class Recordings(BoardTest):
    def record(self, *words, kind="", path="day.board"):
        with Board(self, "--record", path, *words, kind=kind) as board:
            self.host(board.port, "set", "torque_limit=0.1")
            if "--rtl" not in words:  # which takes its time
                self.patient(board.port)
                self.host(board.port, "arm", "wall")
                self.host(board.port, "record", "position", "--for", "0.02", "--csv", "r.csv")
            status, said = board.end()
            self.assertEqual(status, 0, said)
            return said

    @weekly(3)
    def test_the_same_ticks_again_on_twin_and_rtl(self):
        said = self.record("--hand", "swing", "--bad-line", 0.001)
        again = self.run_program("feltgate_board", "--replay", "day.board")
        self.assertIn("identical to the recording", again)
        self.assertEqual(again.splitlines()[0], said.splitlines()[0])
        # The RTL is slow: a short session, first on it.
        self.record("--hand", "swing", "--rtl", kind="_rtl", path="rtl.board")
        again = self.run_program("feltgate_board", "--replay", "rtl.board")
        self.assertIn("identical to the recording", again)

    @weekly(3)
    def test_other_bytes_are_other_ticks(self):
        self.record()
        text = (self.folder / "day.board").read_text(encoding="utf-8")
        first = re.search(r"^(\d+) (c0\w{18,})$", text, re.M)  # a request, not "c0c0"
        (self.folder / "x.board").write_text(text.replace(first[0] + "\n", "", 1))
        said = self.run_program("feltgate_board", "--replay", "x.board", status=1)
        self.assertIn("DIFFERS from the recording", said)
        (self.folder / "x.board").write_text(text[: len(text) // 2])
        self.run_program("feltgate_board", "--replay", "x.board", status=2)

    def test_the_time_of_several_axes_begins_after_homing(self):
        need_terminals()
        words = ("--design", "pantograph_law", "--for", "0.01", "--unpaced")
        self.assertIn("simulated 0.01 s", self.run_program(board_program(words), *words))

    def test_wrong_words(self):
        for words, needle in (
            (("--hand", "wave"), "is neither free, locked, hold or swing"),
            (("--plant", "p42"), "is not in vectors/plants"),
            (("--rtl", "--for", "1"), "./feltgate board --design lever --rtl builds it"),
            (("--replay", "none.board"), "cannot be read"),
        ):
            with self.subTest(words):
                self.assertIn(needle, self.run_program("feltgate_board", *words, status=2))
        (self.folder / "there").write_text("mine")
        said = self.run_program("feltgate_board", "--link", "there", status=2)
        self.assertIn("is there and no symbolic link", said)
        self.assertEqual((self.folder / "there").read_text(), "mine")


if __name__ == "__main__":
    unittest.main()
