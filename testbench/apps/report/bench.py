# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the tests of the reports share: the scripts on the path, and a stand-in for the program."""

import re
import sys
from pathlib import Path

from markup import Markup
from testing import ROOT, SCRIPTS, Scratch, environment, ran, script, text_of  # noqa: F401

FAKE = Path(__file__).resolve().parent / "fake_feltgate.py"


class Bench(Scratch):
    """A scratch folder, with the stand-in as the program that the scripts start."""

    def setUp(self):
        super().setUp()
        self.program = self.put_program("feltgate", f'exec "{sys.executable}" -B "{FAKE}" "$@"')
        presets = text_of("rtl/designs/presets.txt").splitlines()
        for design in (name for name in presets if name.endswith("_law")):
            self.program.with_name(f"feltgate_{design}").symlink_to(self.program)

    def environment(self, **more):
        return environment(**{"FELTGATE_PROGRAM": str(self.program)} | more)

    def script(self, name, *arguments, **environment):
        """Runs scripts/NAME and returns what came of it."""
        return script(name, *arguments, env=self.environment(**environment), timeout=600)

    def fake(self, *arguments):
        ran(self.program, *arguments, check=True)

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
