#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Programs are started without a shell: names of folders and files are names, whatever is in them.

Documentation: docs/json.md
"""

import json
import os
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


if __name__ == "__main__":
    unittest.main()
