#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A design whose file was edited: the twin runs it as it is now; what was built from it before, as the RTL, is not
used: each such command ends with 2, names the file, and says what to do. Documentation: docs/designs.md
"""

import os
import sys
import unittest

from testing import BUILD, ROOT, SCRIPTS, Scratch, ran

SAYS = "rtl/designs/lever.toml: the file has changed since"
OTHER = "design lever: its RTL in this program is of another design of this name"
LIMIT = "torque_limit_nm = 0.5"


class Edited(Scratch):
    def setUp(self):
        """A repository in links, in which rtl/designs/lever.toml asks for a lower limit."""
        super().setUp()
        self.shadow = self.folder / "root"
        designs = ROOT / "rtl/designs"
        for source in (*ROOT.iterdir(), *(ROOT / "rtl").iterdir(), *designs.iterdir()):
            if source in (ROOT / "rtl", designs) or source.name in ("build", ".git"):
                continue
            at = self.shadow / source.relative_to(ROOT)
            at.parent.mkdir(parents=True, exist_ok=True)
            at.symlink_to(source)
        self.env = os.environ | {"FELTGATE_ROOT": str(self.shadow), "FELTGATE_PROGRAM": str(BUILD / "feltgate")}
        self.write((designs / "lever.toml").read_text(encoding="utf-8"))

    def write(self, text):
        (self.shadow / "rtl/designs/lever.toml").unlink()
        self.put("root/rtl/designs/lever.toml", text)

    def edit(self, before=LIMIT, after="torque_limit_nm = 0.3"):
        text = (self.shadow / "rtl/designs/lever.toml").read_text(encoding="utf-8")
        self.assertIn(before, text)
        self.write(text.replace(before, after, 1))

    def feltgate(self, program, *words, status=2, says=(SAYS, "run ./feltgate generate")):
        done = ran(BUILD / program, *words, env=self.env, cwd=self.folder, timeout=120)
        return self.ended(done, status, *says)

    def script(self, name, *words):
        done = ran(sys.executable, "-B", SCRIPTS / name, *words, env=self.env, cwd=self.folder, timeout=120)
        self.ended(done, 2, SAYS, "run ./feltgate generate")

    def test_programs(self):
        self.edit()
        # A design is data to the twin; the Verilated RTL, and what synthesis and others take, is of the file as it was.
        done = self.feltgate("feltgate", "run", "wall", "--engine", "twin", status=1, says=())
        self.assertIn("asked          up to -0.3 Nm", done.stdout)
        for engine in ("all", "rtl"):
            self.feltgate("feltgate", "run", "wall", "--engine", engine, says=(OTHER, "run ./feltgate generate"))
        self.feltgate("feltgate", "run", "free_lever", "--design", "paper", "--engine", "rtl", status=0, says=())

    def test_scripts(self):
        self.edit()
        self.script("product.py", "verilog")
        self.script("synth.py", "--block", "pwm", "--no-route")
        self.script("synth.py", "--board", "ulx3s", "--no-route")

    def test_python(self):
        self.edit()
        text = 'import feltgate; print(feltgate.run("wall", engine="twin").figures["tau_ref_min_nm"])'
        done = self.ended(ran(sys.executable, "-B", "-c", text, env=self.env, cwd=self.folder))
        self.assertAlmostEqual(float(done.stdout), -0.3, 3)

    def test_a_file_that_is_no_design_is_told_with_its_line(self):
        self.edit(after="torque_limit = 0.5")
        self.feltgate("feltgate", "run", "wall", "--engine", "twin", says=("lever.toml:", '"torque_limit_nm" is missing'))


if __name__ == "__main__":
    unittest.main()
