# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""pip install . into a new environment, as docs/python.md says, and a run with what it installed.

PyPI has the build backend: without a network the test is skipped. --build-dir may hold what was
compiled before.
"""

import argparse
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from testing import ROOT, environment, ran

OFFLINE = ("No matching distribution found for scikit-build-core", "Failed to establish a new",
           "Temporary failure in name resolution", "Network is unreachable", "Connection refused")
USE = """
import feltgate
result = feltgate.run("torque_step_cord", engine="twin,quad")
assert result["twin"].errors["torque_nm"].max <= result.bounds["torque_nm"]
print(feltgate.__file__)
"""


class Pip(unittest.TestCase):
    build_dir = ""

    def test_install(self):
        with tempfile.TemporaryDirectory() as folder:
            python = Path(folder) / "venv/bin/python"
            subprocess.run([sys.executable, "-m", "venv", "--system-site-packages",
                            python.parents[1]], check=True)
            command = [python, "-m", "pip", "install", "--disable-pip-version-check", ROOT]
            if self.build_dir:
                command.insert(4, f"--config-settings=build-dir={self.build_dir}")
            clean = environment("PYTHON")
            done = subprocess.run(command, env=clean, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, check=False)
            if done.returncode and any(word in done.stdout for word in OFFLINE):
                self.skipTest("PyPI cannot be reached")
            self.assertEqual(done.returncode, 0, done.stdout)
            used = ran(python, "-c", USE, env=clean, cwd=folder, check=True)
            self.assertIn(str(python.parents[1]), used.stdout)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default="")
    options, rest = parser.parse_known_args()
    Pip.build_dir = options.build_dir
    unittest.main(argv=[sys.argv[0], *rest])
