# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the tests in Python share: where things are, programs run to their end, a command's main()
called here, and a folder of a test's own. It puts scripts/ on the path.
"""

import contextlib
import functools
import hashlib
import io
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("FELTGATE_BUILD") or ROOT / "build")
SCRIPTS = ROOT / "scripts"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))


def text_of(path):
    """Of a file of the repository."""
    return (ROOT / path).read_text(encoding="utf-8")


def ran(*command, **options):
    """What came of a program: its status, and what it said as text."""
    options = {"capture_output": True, "text": True, "check": False} | options
    return subprocess.run([str(word) for word in command], **options)


def script(name, *words, **options):
    """The same of scripts/NAME."""
    return ran(sys.executable, "-B", SCRIPTS / name, *words, **options)


def called(main, *words):
    """(status, stdout, stderr) of main(words) of a command."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = main([str(word) for word in words])
        except SystemExit as ended:
            status = ended.code
    return status, out.getvalue(), err.getvalue()


def environment(*prefixes, **more):
    """Ours without the variables of the project and those of these prefixes, and with more."""
    without = ("FELTGATE_", *prefixes)
    return {k: v for k, v in os.environ.items() if not k.startswith(without)} | more


def week():
    """Since 1970: each week a usual run tries another part of what takes long. FELTGATE_WEEK chooses it again."""
    return int(os.environ.get("FELTGATE_WEEK") or time.time() // (7 * 24 * 3600))


def weekly(parts):
    """Of a test that takes long: a usual run has it in one week of so many, --whole always."""

    def decorated(test):
        part = int(hashlib.md5(test.__qualname__.encode()).hexdigest()[:4], 16)
        if "FELTGATE_WHOLE" in os.environ or (part + week()) % parts == 0:
            return test

        @functools.wraps(test)
        def left_out(self):
            print(f"{test.__qualname__}: in another week, or with --whole", file=sys.stderr)

        return left_out

    return decorated


class Scratch(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()

    def ended(self, done, status=0, *said):
        """What came of a program that ended with this status and said this on stderr."""
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        for words in said:
            self.assertIn(words, done.stderr)
        return done

    def started(self, *command, **options):
        """A program under way in the folder; who starts it ends it, or the test's end does."""
        options = {"cwd": self.folder} | options
        process = subprocess.Popen([str(word) for word in command], **options)
        for stream in filter(None, (process.stdin, process.stdout, process.stderr)):
            self.addCleanup(stream.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def until(self, what, within_s=60):
        """Waits for what must come, and returns it; fails where it does not."""
        end = time.monotonic() + within_s
        while not (come := what()):
            self.assertLess(time.monotonic(), end, "never came")
            time.sleep(0.005)
        return come

    def put(self, name, text):
        """The path of a file of this text, below the folder."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def put_program(self, name, text):
        """The same, to be run; without a first line of its own a shell script."""
        path = self.put(name, text if text.startswith("#!") else f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)
        return path
