#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Commands in Python under signals, with stand-ins that note their numbers and wait; their output files.

Documentation: docs/json.md
"""

import os
import signal
import subprocess
import sys
import time
import unittest

from bench import Bench
from testing import ROOT, SCRIPTS, ran

import crew
import interrupts
import outputs

STAND_IN = 'echo $$ >"$PIDS/$$.new"; mv "$PIDS/$$.new" "$PIDS/$$"\nexec sleep 60 >/dev/null 2>&1'


class Scripts(Bench):
    def ends(self, command, *words, **more):
        """A signal ends the command and the two programs that its threads have started."""
        pids = self.path("pids")
        pids.mkdir(exist_ok=True)
        for name in ("feltgate", "bin/yosys", "bin/yosys-smtbmc", "bin/z3"):
            self.put_program(name, STAND_IN)
        kept = {k: v for k, v in os.environ.items() if not k.startswith("FELTGATE_")}
        kept |= {"FELTGATE_PROGRAM": str(self.path("feltgate")), "PIDS": str(pids)} | more
        kept["PATH"] = f"{self.path('bin')}{os.pathsep}{os.environ['PATH']}"
        for number in (signal.SIGINT, signal.SIGTERM):
            options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
            process = self.started(sys.executable, "-B", SCRIPTS / f"{command}.py", *words, env=kept, text=True, **options)
            self.until(lambda: len(list(pids.glob("[0-9]*[0-9]"))) >= 2)
            process.send_signal(number)
            err = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 128 + number, err)
            self.assertIn(f"{command}: interrupted", err.splitlines())
            self.assertNotIn("Traceback", err)
            for path in pids.iterdir():
                self.assertRaises(ProcessLookupError, os.kill, int(path.name), 0)
                path.unlink()

    def test_demo(self):
        self.path("traces").mkdir()
        self.path("root").mkdir()
        self.path("root/rtl").symlink_to(ROOT / "rtl")
        for name in ("one", "two"):
            self.put(f"root/vectors/scenes/{name}.toml", self.path("short.toml").read_text(encoding="utf-8"))
        words = ("--no-figures", "--traces", "traces", "--out", "out", "--jobs", "2")
        self.ends("demo", *words, FELTGATE_ROOT=str(self.path("root")))
        self.assertFalse(self.path("out").exists(), "an empty folder stayed")

    def test_prove(self):
        self.ends("prove", "pwm", "--jobs", "2")

    def test_what_fails_ends_the_others(self):
        both, done, began = crew.Crew(), [], time.monotonic()

        def one(words):
            status, _ = both.timed(words)
            if status == 3:
                raise OSError("three")
            return status

        with self.assertRaisesRegex(OSError, "three"):
            work = [["true"], ["sleep", "60"], ["sh", "-c", "sleep 0.2; exit 3"], ["sleep", "61"]]
            both.each(one, work, 3, lambda item, status: done.append((item[0], status)))
        self.assertLess(time.monotonic() - began, 30)
        self.assertEqual(done[0], ("true", 0))
        self.assertRaises(interrupts.Interrupted, both.start, ["true"])
        self.assertIsNone(crew.Crew().timed(["sleep", "60"], 0.3)[0])


class Outputs(Bench):
    def test_whole_files(self):
        self.path("target").write_text("old")
        self.path("target").chmod(0o640)
        self.path("link").symlink_to("target")
        outputs.write_whole(self.path("link"), "new")
        self.assertTrue(self.path("link").is_symlink())
        self.assertEqual(self.path("target").read_text(), "new")
        self.assertEqual(self.path("target").stat().st_mode & 0o777, 0o640)
        self.assertRaises(OSError, outputs.write_whole, "/dev/full", "something")
        self.assert_only("target", "link")

    def test_refused_before_the_work(self):
        for script, *words, said in (
            ("synth.py", "--json", ".", "--json .: is a folder"),
            ("synth.py", "--json", "no/x.json", "--json no/x.json: there is no folder"),
            ("synth.py", "--seeds", "a", "--seeds a: wants whole numbers"),
            ("demo.py", "-o", "/dev/null", "-o /dev/null: is no folder"),
        ):
            self.ended(ran(sys.executable, "-B", SCRIPTS / script, *words, cwd=self.folder), 2, said)
        self.assert_only()


if __name__ == "__main__":
    unittest.main()
