# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The Python code of README and docs/python.md runs as it stands; so does the notebook."""

import contextlib
import io
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "host/host"))
from board_process import BoardProcess  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "common"))
from testing import ROOT, ran  # noqa: E402

BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NOTEBOOK = ROOT / "docs/fixed_against_float.ipynb"


def blocks(page):
    return BLOCK.findall((ROOT / page).read_text(encoding="utf-8"))


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder.name)

    def run_blocks(self, page):
        said = io.StringIO()
        with BoardProcess() as board, contextlib.redirect_stdout(said):
            names = {"port": board.port}
            for block in blocks(page):
                exec(compile(block, page, "exec"), names)  # one after the other, as a reader would
        return said.getvalue()

    def test_readme(self):
        (block,) = blocks("README.md")
        self.assertLessEqual(len(block.splitlines()), 12)
        self.run_blocks("README.md")
        self.assertTrue(list(Path().glob("*.png")))

    def test_python_page(self):
        self.assertGreaterEqual(len(blocks("docs/python.md")), 5)
        self.run_blocks("docs/python.md")

    def test_notebook(self):
        done = ran(sys.executable, ROOT / "scripts/notebook.py", NOTEBOOK, "--check")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_notebook_that_breaks_is_noticed(self):
        text = NOTEBOOK.read_text(encoding="utf-8")
        broken = Path("broken.ipynb")
        broken.write_text(text.replace("assert wide < narrow", "assert wide > narrow"))
        self.assertNotEqual(broken.read_text(), text)
        done = ran(sys.executable, ROOT / "scripts/notebook.py", broken, "--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("AssertionError", done.stderr)


if __name__ == "__main__":
    unittest.main()
