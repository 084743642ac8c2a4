#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Laws by the verbs of feltgate host, on a board without hardware that has an engine, and the
session of docs/laws.md."""

import json
import re
import shlex
import socket
import subprocess
import unittest

from board_process import board_program, need_terminals
from host_program import ROOT, ProgramTest, patterns_of
from testing import weekly

PAGE = ROOT / "docs/laws.md"
PORT = "/tmp/knob"  # on the page
SPRING = """\
param stiffness = 20 mNm/rad in 0 .. 1 Nm/rad
event right(position) when position > 0.3 rad
event left(position) when position < 0.2 rad
out torque = -stiffness * position
"""


class Laws(ProgramTest):
    cache = "cache"  # where the host keeps what it loaded

    def environment(self):
        return super().environment() | {"XDG_CACHE_HOME": str(self.folder / self.cache)}

    def board(self, *words):
        need_terminals()
        board = self.start_program(board_program(words), *words, stderr=subprocess.STDOUT)
        self.port = board.stdout.readline().split(" -> ")[-1].strip()

    def host(self, *words, status=0):
        return self.run_program("feltgate_host", "--patience", 30, self.port, *words, status=status)

    def start(self, *words):
        return self.start_program("feltgate_host", "--patience", 30, self.port, *words)

    def law(self, text):
        path = self.folder / "mine.law"
        path.write_text(text, encoding="utf-8")
        return path

    def test_the_page(self):
        self.board("--design", "lever_law", "--hand", "swing")
        text = PAGE.read_text(encoding="utf-8")
        blocks = re.findall(r"```console\n(.*?)```", text, re.S)
        self.assertTrue(blocks)
        for block in blocks:
            for part in re.split(r"^\$ ", block, flags=re.M)[1:]:
                line, _, shown = part.partition("\n")
                words = shlex.split(line)
                self.assertEqual(words[:3], ["./feltgate", "host", PORT])
                refused = "feltgate host: " in shown
                said = self.host(*words[3:], status=2 if refused else 0)
                self.assertEqual(patterns_of(said.replace(str(ROOT) + "/", "")), patterns_of(shown))

    @weekly(3)
    def test_two_axes_and_their_pen(self):
        self.board("--design", "pantograph_law", "--hand", "swing")
        self.assertIn("there is no axis 2; this board has the axes 0 to 1", self.host("get", "angle.2", status=2))
        self.assertIn("at.1", self.host("info"))
        self.host("law", "pantograph")
        self.host("set", "floor=0.09m", "torque_limit.1=0.2Nm")
        said = self.host("watch", "--pen", "--arm", "law", "--for", "2", "--every", "0.002")
        shown = re.findall(r"  x (\S+) m  y (\S+) m  Fx (\S+) N  Fy (\S+) N  (\w+)", said)
        self.assertGreater(len(shown), 10)
        x, y, fx, fy = ([float(row[k]) for row in shown] for k in range(4))
        # The hand moves the pen 40 mm to the side and back, at a height of 0.1 m; the drag is 1 Ns/m.
        self.assertGreater(min(x), -0.005)
        self.assertLess(max(x), 0.045)
        self.assertLess(max(abs(each - 0.1) for each in y), 0.02)
        # The force is the drag times the speed that the positions have, over ten rows.
        every_s = 0.002
        for k in range(10, len(x)):
            speed = (x[k] - x[k - 10]) / (10 * every_s)
            self.assertAlmostEqual(sum(fx[k - 10 : k]) / 10, -speed, delta=0.05)
        self.assertIn("ARMED", {row[4] for row in shown})
        # The same words of a device that is no pantograph; and with both joints at 0 there is no pen.
        two = self.folder / "two.toml"
        two.write_text((ROOT / "rtl/designs/pantograph_law.toml").read_text(encoding="utf-8"), encoding="utf-8")
        said = self.host("--design", two, "watch", "--pen", "--for", "1", status=2)
        self.assertIn('has "pantograph" in it; the board has two, leave --pen out', said)
        self.board("--design", "pantograph_law", "--hand", "free")
        self.host("zero")
        said = self.host("watch", "--pen", "--for", "0.1", "--every", "0.05")
        self.assertRegex(said, r"  x - m  y - m  Fx - N  Fy - N  disarmed")
        said = self.host("watch", "--pen", "--teleplot", "--for", "0.1", "--every", "0.05")
        self.assertNotIn("nan", said)

    def test_load_set_and_get(self):
        self.board("--design", "lever_law", "--hand", "swing")
        self.assertIn("law none, or one that is not known here", self.host("law"))
        self.assertIn("not known here", self.host("set", "clicks=3", status=2))
        self.host("law", "detent")
        self.assertIn("law detent", self.host("law"))
        self.assertIn("law       detent", self.host("info"))
        said = self.host("set", "clicks=12", "amplitude=80mNm", "torque_limit=0.1Nm")
        self.assertIn("clicks = 12\n", said)
        self.host("get", "clicks", "law.amplitude", "torque_limit", "--json", "v.json")
        values = json.loads((self.folder / "v.json").read_text(encoding="utf-8"))["values"]
        self.assertEqual(values["clicks"], {"value": 12.0, "unit": ""})
        self.assertAlmostEqual(values["law.amplitude"]["value"], 0.08, delta=1e-4)
        self.assertIn("law.clicks", self.host("get", "--all"))

        # Nothing of it is set where one cannot be.
        said = self.host("set", "amplitude=70mNm", "clicks=201", status=2)
        self.assertIn("takes 1 to 200", said)
        twice = self.host("set", "clicks=5", "law.clicks=6", status=2)
        self.assertIn("law.clicks=6 sets what was set before it", twice)
        self.assertIn('did you mean "clicks"', self.host("set", "click=7", status=2))
        self.assertRegex(self.host("get", "clicks"), r"clicks +12 ")
        self.assertRegex(self.host("get", "law.amplitude"), r"amplitude +(0\.08|0\.079)")

        # Another computer, which did not load it.
        self.cache = "other"
        self.assertIn("give the file with --law", self.host("get", "clicks", status=2))
        self.assertRegex(self.host("get", "clicks", "--law", "detent"), r"clicks +12 ")
        refused = self.host("get", "stiffness", "--law", "spring", status=1)
        self.assertIn("does not run the law spring", refused)

    @weekly(3)
    def test_events(self):
        self.board("--design", "lever_law", "--hand", "swing")
        self.host("law", self.law(SPRING))
        self.host("set", "watchdog_ticks=20000000", "self_test_pulse=0")
        process = self.start("events", "--arm", "law", "--count", "4", "--tcp", "0")
        port = 0
        for line in process.stderr:
            if found := re.search(r"127\.0\.0\.1:(\d+)", line):
                port = int(found[1])
                break
        with socket.create_connection(("127.0.0.1", port), timeout=60) as wire:
            over_wire = wire.makefile(encoding="utf-8").read()
        shown = process.stdout.read()
        self.assertEqual(process.wait(timeout=60), 0)
        lines = [line.split(" ") for line in shown.splitlines()]
        self.assertEqual(len(lines), 4)
        for before, after in zip(lines, lines[1:]):
            self.assertLess(int(before[0]), int(after[0]))
        for _, name, value in lines:
            self.assertIn(name, ("right", "left"))
            # The first may come as the law begins, wherever the lever is then.
            self.assertEqual(float(value) > 0.25, name == "right")
        self.assertTrue(shown.endswith(over_wire))
        self.assertIn("disarmed", self.host("info"))

    @weekly(3)
    def test_a_capture_by_an_event(self):
        self.board("--design", "lever_law", "--hand", "swing")
        self.assertIn("means no event", self.host("capture", "--trigger", "event:left", status=1))
        self.host("law", self.law(SPRING))
        self.host("set", "watchdog_ticks=20000000", "self_test_pulse=0")
        unknown = self.host("capture", "--trigger", "event:lef", status=2)
        self.assertIn('no event "lef"; did you mean "left"? choose from right, left', unknown)
        self.assertIn("did not come", self.capture("fault", "--wait", "0.1", status=1))
        for trigger in ("event:left", "event"):
            path = self.folder / "rows.csv"
            said = self.capture(trigger, "--csv", path)
            self.assertIn("1024 rows, 0.001024 s from 0.000256 s before the trigger on", said)
            rows = [line.split(",") for line in path.read_text(encoding="utf-8").splitlines()]
            self.assertEqual(rows[0][:2], ["time_s", "tick"])
            tick = next(row[1] for row in rows[1:] if float(row[0]) == 0)
            # The events stay for the host; the capture is around one of them.
            shown = self.host("events", "--for", "0.5")
            told = [line.split(" ") for line in shown.splitlines() if re.match(r"\d+ ", line)]
            names = {event[0]: event[1] for event in told}
            self.assertIn(tick, names)
            self.assertTrue(trigger == "event" or names[tick] == "left")

    def capture(self, trigger, *words, status=0):
        words = ("tick", "angle", "--arm", "law", "--trigger", trigger, *words)
        return self.host("capture", *words, status=status)


if __name__ == "__main__":
    unittest.main()
