# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What these tests share: the built program in a scratch folder, with a scene of milliseconds."""

import os
import subprocess
import sys
from pathlib import Path

from testing import ROOT, Scratch

PROGRAM = str(Path(os.environ.get("FELTGATE_BUILD", ROOT / "build")) / "feltgate")
os.environ["FELTGATE_PYTHON"] = sys.executable
SCENE = """title = "A lever at rest"
about = "For tests of the program around the run."
duration_s = {seconds}

[core]
scene = "wall"

[hand]
start_rad = 0.0
"""


class Bench(Scratch):
    """A scratch folder that is the working folder, with short.toml (2 ms) and long.toml."""

    def setUp(self):
        super().setUp()
        self.put("short.toml", SCENE.format(seconds=0.002))
        self.put("long.toml", SCENE.format(seconds=10_000.0))
        self.given = {"short.toml", "long.toml"}

    def path(self, name):
        return self.folder / name

    def words(self, *words):
        words = [os.fspath(word) for word in words]
        if words[:1] == ["extremes"]:
            return [f"{PROGRAM}_extremes", *words[1:]]
        return [PROGRAM, *words]

    def start(self, *words, **more):
        """The program under way, stdout and stderr piped."""
        more = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **more}
        return self.started(*self.words(*words), **more)

    def finished(self, *words, **more):
        """The program, what came of it, and what it said, `out` and `err`."""
        process = self.start(*words, **more)
        process.out, process.err = (
            (text or b"").decode(errors="surrogateescape") for text in process.communicate(timeout=300)
        )
        return process

    def run_it(self, *words, scene="short.toml", **more):
        """The same of a run of the twin."""
        return self.finished("run", scene, "--engine", "twin", *words, **more)

    def assert_refused(self, process, *said):
        """Ends with 2, one line that says this, and nothing was made."""
        self.assertEqual(process.returncode, 2, process.err)
        self.assertEqual(process.err.count("\n"), 1, process.err)
        for text in said:
            self.assertIn(text, process.err)

    def assert_only(self, *names):
        """The folder holds these besides what it was given."""
        self.assertEqual({p.name for p in self.folder.iterdir()} - self.given, set(names))
