#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Programs are started without a shell: names of folders and files are names, whatever is in them. A signal leaves no
part, no partial waveform, no empty folder, no child; the exit code says so.

Documentation: docs/json.md
"""

import json
import os
import signal
import subprocess
import unittest

from bench import Bench

NAMES = ("John's run", "x';touch pwned;'", '"', "$(touch pwned)", "a\nb", "-rf", "`id`", "ü", "*")


class Names(Bench):
    def test_scenes_files_and_folders(self):
        text = self.path("short.toml").read_text()
        for name in NAMES:
            with self.subTest(name):
                self.path(f"{name}.toml").write_text(text)
                words = ("--quiet", f"--json={name}.json", f"--report={name}")
                done = self.run_it(*words, scene=f"./{name}.toml")
                self.assertEqual(done.returncode, 0, done.err)
                self.assertEqual(json.loads(self.path(f"{name}.json").read_text())["scene"], name)
                self.assertTrue((self.path(name) / "report.html").is_file())
                self.assertIn(f"{name}/report.html", done.out)
        self.assertFalse(self.path("pwned").exists())

    def test_a_name_that_is_no_text(self):
        """Latin-1 in a scene's name: the run is done, the JSON has U+FFFD in the byte's place."""
        name = os.fsencode(self.folder) + b"/caf\xe9"
        os.rename(self.path("short.toml"), name + b".toml")
        scene = os.fsdecode(name + b".toml")
        done = self.run_it("--json", "a.json", "--report", os.fsdecode(name), scene=scene)
        self.assertEqual(done.returncode, 0, done.err)
        self.assertEqual(json.loads(self.path("a.json").read_text())["scene"], "caf\ufffd")
        self.assertTrue(os.path.isfile(name + b"/report.html"))

    def test_a_python_that_is_not_there(self):
        env = os.environ | {"FELTGATE_PYTHON": str(self.path("no/python"))}
        done = self.run_it("--quiet", "--report", "out", env=env)
        self.assert_refused(done, "no/python: cannot be started: No such file")
        for command in ("demo", "figures", "explore", "synth"):
            done = self.finished(command, env=env)
            self.assert_refused(done, "no/python: cannot be started: No such file")


WAIT_S = 60


class Signals(Bench):
    def begin(self, *words, parts):
        """The program with so many parts on the disk."""
        process = self.start(*words, stdin=subprocess.DEVNULL)
        self.until(lambda: len(list(self.folder.rglob("*.part"))) == parts)
        return process

    def test_each_signal_in_a_run(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number):
                process = self.begin(
                    *("run", "long.toml", "--engine", "twin", "--report", "new/deep"),
                    *("--csv", "a.csv", "--record", "a.vec"),
                    parts=3,
                )
                process.send_signal(number)
                self.assertEqual(process.wait(WAIT_S), 128 + number)
                self.assertIn(b"feltgate: interrupted", process.stderr.read())
                self.assert_only()

    def test_a_waveform_under_way(self):
        process = self.begin("run", "long.toml", "--engine", "rtl", "--fst", "a.fst", parts=1)
        self.until(lambda: list(self.folder.glob("*.hier")))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(WAIT_S), 130)
        self.assert_only()

    def test_what_was_there_stays(self):
        self.path("out").mkdir()
        self.path("a.json").write_text("old")
        process = self.begin(
            *("run", "long.toml", "--engine", "twin", "--report", "out", "--json", "a.json"),
            parts=2,
        )
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(WAIT_S), 143)
        self.assertEqual(self.path("a.json").read_text(), "old")
        self.assert_only("out", "a.json")
        self.assertEqual(list(self.path("out").iterdir()), [])

    def test_a_reader_that_goes_away(self):
        process = self.begin(
            *("run", "long.toml", "--engine", "twin", "--csv", "-", "--json", "a.json"), parts=1
        )
        process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.wait(WAIT_S), 128 + signal.SIGPIPE)
        self.assert_only()

    def test_the_program_that_draws_is_ended_too(self):
        """A stand-in for Python notes its number and waits; it must not outlive the run."""
        noting = "echo $$ >pid.new; mv pid.new pid\nexec sleep 30 >/dev/null 2>&1"
        python = self.put_program("python", noting)
        env = os.environ | {"FELTGATE_PYTHON": str(python)}
        process = self.start(
            *("run", "short.toml", "--engine", "twin", "--report", "out"), env=env
        )
        self.until(self.path("pid").exists)
        child = int(self.path("pid").read_text())
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(WAIT_S), 130)
        self.assertRaises(ProcessLookupError, os.kill, child, 0)


if __name__ == "__main__":
    unittest.main()
