#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A design whose file was edited after it was built in is used by no command: each ends with 2, names
the file, and says what to do. Documentation: docs/designs.md
"""

import os
import sys
import unittest

from testing import BUILD, ROOT, SCRIPTS, Scratch, ran

SAYS = "rtl/designs/lever.toml: the file has changed since"
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
        vector = ROOT / "vectors/traces/membrane.vec"
        for program, *words in (
            ("feltgate", "run", "wall", "--engine", "twin"),
            ("feltgate", "replay", vector, "--engine", "twin"),
            ("feltgate", "trim", "wall"),
            ("feltgate", "stability", "lever"),
            ("feltgate_board", "--for", "0.1"),
        ):
            with self.subTest(program, words=words):
                self.feltgate(program, *words)
        # What uses no built design, and another design.
        self.feltgate("feltgate", "design", "lever", status=0, says=())
        self.feltgate("feltgate", "run", "free_lever", "--design", "paper", "--engine", "twin", status=0, says=())

    def test_scripts(self):
        self.edit()
        self.script("product.py", "verilog")
        self.script("synth.py", "--block", "pwm", "--no-route")
        self.script("synth.py", "--board", "ulx3s", "--no-route")
        self.script("page.py")

    def test_python(self):
        self.edit()
        text = """import feltgate
for call in (lambda: feltgate.run("wall", engine="twin"), feltgate.Twin, feltgate.Chain, feltgate.bounds):
    try:
        call()
        print("ran")
    except ValueError as error:
        print(error)"""
        done = self.ended(ran(sys.executable, "-B", "-c", text, env=self.env, cwd=self.folder))
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 4)
        for line in lines:
            self.assertIn(SAYS, line)
            self.assertIn("run ./feltgate generate and install the package again", line)

    def test_a_file_that_is_no_design_is_told_with_its_line(self):
        self.edit(after="torque_limit = 0.5")
        self.feltgate("feltgate", "run", "wall", "--engine", "twin", says=("lever.toml:", '"torque_limit_nm" is missing'))


if __name__ == "__main__":
    unittest.main()
