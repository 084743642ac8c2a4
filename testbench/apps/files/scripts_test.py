#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""demo, explore and synth under signals, with stand-ins for what they start; their output files.

A stand-in notes its number and waits. Documentation: docs/json.md
"""

import json
import os
import signal
import subprocess
import sys
import time
import unittest

from bench import ROOT, Bench
from testing import SCRIPTS, ran

import crew  # noqa: E402
import interrupts  # noqa: E402
import outputs  # noqa: E402

WAIT_S = 60
STAND_IN = """#!/bin/sh
echo $$ >"$PIDS/$$.new"; mv "$PIDS/$$.new" "$PIDS/$$"
exec sleep 60 >/dev/null 2>&1
"""
SLEEPER = """import os
import interrupts

def evaluate(point, workdir, route=False):
    interrupts.run([os.environ["FELTGATE_PROGRAM"]])
"""
# The signal comes in another thread, so it breaks off nothing in this one.
WAITS = """import signal
import sys
import threading
import time

import interrupts

def hear():
    time.sleep(0.2)
    signal.pthread_kill(threading.get_ident(), signal.SIGTERM)

interrupts.end_on_signals()
threading.Thread(target=hear, daemon=True).start()
try:
    threading.Event().wait()
except KeyboardInterrupt as error:
    sys.exit(interrupts.tell("waits", error))
"""


class Scripts(Bench):
    def setUp(self):
        super().setUp()
        self.pids = self.path("pids")
        self.pids.mkdir()
        presets = (ROOT / "rtl/designs/presets.txt").read_text(encoding="utf-8").splitlines()
        engines = [f"feltgate_{name}" for name in presets if name.endswith("_law")]
        for name in ("feltgate", *engines, "bin/yosys", "bin/nextpnr-ecp5"):
            self.put_program(name, STAND_IN)
        self.path("sleeper.py").write_text(SLEEPER)
        self.path("waits.py").write_text(WAITS)

    def script(self, name, *words, **more):
        kept = {k: v for k, v in os.environ.items() if not k.startswith("FELTGATE_")}
        kept |= {"FELTGATE_PROGRAM": str(self.path("feltgate")), "PIDS": str(self.pids)}
        kept |= {"FELTGATE_BUILD": str(self.path("build")), "PYTHONPATH": str(self.folder)}
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        options |= {"env": kept | more, "text": True}
        return self.started(sys.executable, "-B", SCRIPTS / name, *words, **options)

    def children(self, count):
        """Numbers of so many stand-ins, once they are under way."""
        self.until(lambda: len(list(self.pids.glob("[0-9]*[0-9]"))) >= count)
        return [int(path.name) for path in self.pids.glob("[0-9]*[0-9]")]

    def assert_gone(self, children):
        for child in children:
            self.assertRaises(ProcessLookupError, os.kill, child, 0)

    def ends(self, process, number, said, count=1):
        """A signal ends the script with all that it started; what it says in the end."""
        children = self.children(count)
        process.send_signal(number)
        err = process.communicate(timeout=WAIT_S)[1]
        self.assertEqual(process.returncode, 128 + number, err)
        self.assertIn(said, err.splitlines())
        self.assertNotIn("status -", err)
        self.assertNotIn("Traceback", err)
        self.assert_gone(self.children(count) + children)
        for path in self.pids.glob("[0-9]*[0-9]"):
            path.unlink()

    def test_demo(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number):
                words = ("--traces", str(self.pids), "--out", "out", "--jobs", "2")
                process = self.script("demo.py", *words)
                self.ends(process, number, "demo: interrupted", count=2)
                self.assertFalse(self.path("out").exists(), "an empty folder stayed")

    def test_figures(self):
        self.path("mine").mkdir()
        for folder, stays in (("new/deep", False), ("mine", True)):
            process = self.script("figures.py", "-o", folder)
            self.ends(process, signal.SIGINT, "figures: interrupted")
            self.assertEqual(self.path(folder).exists(), stays)
        self.assertFalse(self.path("new").exists())

    def test_explore(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process = self.script(
                    *("explore.py", "smoke", "-o", f"out{number}"),
                    FELTGATE_EXPLORE_POINT="sleeper",
                )
                said = "explore: interrupted; the same command goes on from here"
                self.ends(process, number, said)
                self.assertEqual(list(self.folder.rglob("*.tmp")), [])

    def test_a_signal_that_the_waiting_call_does_not_see(self):
        process = self.script(self.path("waits.py"), PYTHONPATH=str(ROOT / "scripts"))
        self.assertEqual(process.communicate(timeout=WAIT_S)[1], "waits: interrupted\n")
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)

    def test_synth(self):
        path = f"{self.path('bin')}{os.pathsep}{os.environ['PATH']}"
        process = self.script("synth.py", "--block", "mult", "--no-route", PATH=path)
        self.ends(process, signal.SIGTERM, "synth: interrupted")

    def test_programs_side_by_side(self):
        """prove, mutate, coverage, faults: what threads have started ends with the command."""
        path = f"{self.path('bin')}{os.pathsep}{os.environ['PATH']}"
        for name in (
            "bin/yosys-smtbmc",
            "bin/z3",
            "build/feltgate_faults",
            "build/testbench/wave/b/b_mutants",
            "b_cover",
        ):
            self.put_program(name, STAND_IN)
        folder = self.path("build/testbench/wave/b/b_mutants.netlist")
        folder.mkdir()
        (folder / "test.json").write_text('{"test": "b", "block": "b"}')
        (folder / "mutants.json").write_text("[]")
        self.path("build/coverage").mkdir()
        self.path("build/coverage/programs.txt").write_text(f"b b {self.path('b_cover')}\n")
        for command, words, count in (
            ("prove", ("mult", "--jobs", "2"), 2),
            ("mutate", ("--no-build",), 1),
            ("coverage", ("--no-build",), 1),
            ("faults", ("--jobs", "2"), 2),
        ):
            for number in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(command, number=number):
                    pids = str(self.path("pids"))
                    process = self.script(f"{command}.py", *words, PATH=path, TMPDIR=pids)
                    self.ends(process, number, f"{command}: interrupted", count=count)
                    self.assertEqual([p.name for p in self.pids.iterdir() if p.is_dir()], [])

    def test_a_child_that_is_interrupted_alone(self):
        """A run of the demo that somebody else ended: the demo goes on and says what happened."""
        words = ("--traces", str(self.pids), "--out", "out", "--jobs", "1", "--no-figures")
        process = self.script("demo.py", *words)
        os.kill(self.children(1)[0], signal.SIGINT)
        self.children(2)
        process.send_signal(signal.SIGINT)
        err = process.communicate(timeout=WAIT_S)[1]
        self.assertIn("did not run: interrupted", err)
        self.assertNotIn("status -", err)

    def test_how_a_program_ended(self):
        for status, text in (
            (-2, "interrupted"),
            (130, "interrupted"),
            (-15, "interrupted"),
            (143, "interrupted"),
            (-11, "killed by SIGSEGV"),
            (137, "killed by SIGKILL"),
            (2, "ended with status 2"),
        ):
            self.assertEqual(interrupts.how_it_ended(status), text)
        self.assertRaises(interrupts.Interrupted, interrupts.check, 130)
        self.assertIsNone(interrupts.check(2))


class Crew(unittest.TestCase):
    def test_status_and_time_of_each(self):
        both = crew.Crew()
        self.assertEqual(both.timed(["sh", "-c", "exit 3"])[0], 3)
        self.assertEqual(both.timed(["sh", "-c", "kill -SEGV $$"])[0], -signal.SIGSEGV)
        status, seconds = both.timed([sys.executable, "-c", "while True: pass"], 0.3)
        self.assertIsNone(status)
        self.assertGreater(seconds, 0)
        self.assertRaises(subprocess.TimeoutExpired, both.run, ["sleep", "60"], 0.1)
        self.assertEqual(both.run(["echo", "a"], **interrupts.CAPTURED).stdout, "a\n")

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


class Outputs(Bench):
    def test_whole_files(self):
        self.path("target").write_text("old")
        self.path("target").chmod(0o640)
        self.path("link").symlink_to("target")
        outputs.write_whole(self.path("link"), "new")
        outputs.write_whole(self.path("fresh"), b"bytes")
        self.assertTrue(self.path("link").is_symlink())
        self.assertEqual(self.path("target").read_text(), "new")
        self.assertEqual(self.path("target").stat().st_mode & 0o777, 0o640)
        outputs.write_whole("/dev/null", "nothing")
        self.assertRaises(OSError, outputs.write_whole, "/dev/full", "something")
        self.assert_only("target", "link", "fresh")

    def test_stdout_is_for_the_json_alone(self):
        self.path("lines").write_text(
            '{"point": "pins", "group": "glitch", "class": "detected", "peak_nm": 0, '
            '"integral_nm_s": 0}\n'
        )
        script = ROOT / "scripts/faults.py"
        command = [sys.executable, "-B", script, "--lines", self.path("lines"), "--json"]
        for name in ("-", "/dev/stdout"):
            done = ran(*command, name)
            self.assertEqual(json.loads(done.stdout)["faults"], 1)
            self.assertIn("unsafe, of all faults that a core can see: 0 of 1", done.stderr)

    def refused(self, script, *words, said):
        with self.subTest(script, words=words):
            self.ended(ran(sys.executable, "-B", SCRIPTS / script, *words, cwd=self.folder), 2, said)

    def test_refused_before_the_work(self):
        for path, said in ((".", "is a folder"), ("no/x.json", "there is no folder")):
            for script in (("synth.py",), ("explore.py", "point", "x.toml")):
                self.refused(*script, "--json", path, said=f"--json {path}: {said}")
        for script in ("demo.py", "figures.py"):
            self.refused(script, "-o", "/dev/null", said="-o /dev/null: is no folder")
        self.refused("synth.py", "--seeds", "a", said="--seeds a: wants whole numbers")
        for same in ("a.json", "./a.json"):
            words = ("--json", "a.json", "--save", same)
            self.refused("faults.py", *words, said="is also that of --json")
        self.refused("explore.py", "bogus", said="bogus is neither a verb")
        self.refused("explore.py", "detent", said="is in: ./feltgate rates detent")
        self.assert_only()


if __name__ == "__main__":
    unittest.main()
