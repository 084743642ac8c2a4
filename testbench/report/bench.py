# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the tests of the reports share: the scripts on the path, and a stand-in for the program."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from markup import Markup

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
FAKE = Path(__file__).resolve().parent / "fake_feltgate.py"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))
sys.path.insert(0, str(FAKE.parent))


class Bench(unittest.TestCase):
    """A scratch folder, with the stand-in as the program that the scripts start."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.program = self.folder / "feltgate"
        self.program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -B "{FAKE}" "$@"\n')
        self.program.chmod(0o755)
        presets = (ROOT / "rtl/designs/presets.txt").read_text(encoding="utf-8").splitlines()
        for design in (name for name in presets if name.endswith("_law")):
            self.program.with_name(f"feltgate_{design}").symlink_to(self.program)

    def environment(self, **more):
        kept = {k: v for k, v in os.environ.items() if not k.startswith("FELTGATE_")}
        return kept | {"FELTGATE_PROGRAM": str(self.program), **more}

    def script(self, name, *arguments, **environment):
        """Runs scripts/NAME and returns what came of it."""
        return subprocess.run(
            [sys.executable, "-B", SCRIPTS / name, *map(str, arguments)],
            env=self.environment(**environment),
            capture_output=True,
            text=True,
            timeout=600,
            check=False,
        )

    def fake(self, *arguments):
        subprocess.run([self.program, *map(str, arguments)], check=True)

    def assert_self_contained(self, page):
        """A whole page from which no reference leads away: only data: and places in it."""
        found = Markup(page)
        self.assertEqual(found.complaints, [])
        self.assertEqual(len(found.ids), len(set(found.ids)))
        self.assertNotRegex(page, r"https?:|//[a-z]+\.[a-z]")
        for target in re.findall(r'(?:src|href)="([^"]*)"', page):
            self.assertTrue(target.startswith(("data:image/svg+xml;base64,", "#")), target[:60])
        self.assertNotRegex(page, r"@import|url\(")
        for anchor in set(re.findall(r'href="#([^"]*)"', page)):
            self.assertIn(f'id="{anchor}"', page)
