#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""feltgate product: Icarus and slang take what it writes as Verilog-2005; what it refuses.

Documentation: docs/other-tools.md

product_test.py VENV: the folder into which scripts/build.sh has fetched pyslang.
"""

import os
import re
import shutil
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, ran, script, weekly

VENV = Path(sys.argv.pop(1))
SLANG = """
import sys
from pyslang import driver
slang = driver.Driver()
slang.addStandardArgs()
words = f"slang --std 1364-2005 --top lever_top {sys.argv[1]}"
fine = slang.parseCommandLine(words, driver.CommandLineOptions()) and slang.processOptions()
sys.exit(0 if fine and slang.parseAllSources() and slang.runFullCompilation(True) else 1)
"""


@unittest.skipUnless(shutil.which("yosys") or os.environ.get("CI"), "no yosys")
class Product(Scratch):
    def product(self, *words):
        program = Path(os.environ["FELTGATE_BUILD"], "feltgate")
        env = os.environ | {"FELTGATE_PROGRAM": str(program)}
        return script("product.py", *words, cwd=self.folder, env=env)

    def written(self, *words):
        done = self.ended(self.product("verilog", *words))
        path = self.folder / "feltgate.v"
        readers = [["iverilog", "-g2005", "-Wall", "-t", "null", "-s", "lever_top", path]]
        if (VENV / "bin/python").exists():
            readers.append([VENV / "bin/python", "-c", SLANG, path])
        for command in readers:
            done = ran(*command)
            self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        return path.read_text()

    def test_lever(self):
        text = self.written()
        self.assertIn("device lever_top of design lever", text)
        self.assertNotIn("$paramod", text)
        modules = re.findall(r"^module (\w+)", text, re.M)
        self.assertEqual(len(modules), text.count("endmodule"))
        self.assertEqual(len(set(modules)), len(modules))
        self.assertTrue(all(name.startswith("feltgate_") for name in modules if name != "lever_top"), modules)
        for name in ("lever_top", "feltgate_observer", "feltgate_pwm", "feltgate_safety"):
            self.assertIn(name, modules)
        # Memories as arrays, products as *.
        self.assertNotRegex(text, r"<= \d+'hx")
        self.assertIn('ramstyle = "no_rw_check"', text)
        law = text.partition("module feltgate_torque_law(")[2].partition("endmodule")[0]
        self.assertEqual(law.count(" * "), 1)

    def board(self, *words):
        done = self.ended(self.product("board", *words))
        return done

    @weekly(3)
    def test_board_of_a_design_of_ones_own(self):
        own = (ROOT / "rtl/designs/lever.toml").read_text()
        own = own.replace("torque_limit_nm = 0.5", "torque_limit_nm = 0.25")
        (self.folder / "own.toml").write_text(own)
        self.board("--design", "own.toml")
        made = self.folder / "de0_nano_own"
        settings = (made / "de0_nano.qsf").read_text()
        named = re.findall(r"SYSTEMVERILOG_FILE (\S+)", settings)
        self.assertGreater(len(named), 30)
        self.assertTrue(all((made / name).is_file() for name in named), named)
        self.assertNotIn("..", "".join(named))
        # All that Quartus is told to read is in the folder, and it elaborates.
        command = ["verilator", "--lint-only", f"-I{made / 'rtl'}", "--top-module", "de0_nano", *(made / n for n in named)]
        done = ran(*command)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        for name in ("de0_nano.qpf", "de0_nano.sdc", "build.tcl"):
            self.assertTrue((made / name).is_file())
        # Package and file of parameters are of one design, and not of lever.
        package = (made / "rtl/cfg.sv").read_text()
        values = (made / "rtl/parameters.mem").read_text()
        words = dict(re.findall(r"9'd(\d+): parameter_reset = 32'd(\d+);", package))
        self.assertGreater(len(words), 40)
        listed = re.findall(r"^[0-9a-f]{9}$", values, re.M)
        self.assertEqual(len(listed), 512)
        for address, word in words.items():
            self.assertEqual(int(listed[int(address)], 16) & 0xFFFFFFFF, int(word), address)
        lever = (ROOT / "rtl/generated/lever/parameters.mem").read_text()
        self.assertNotEqual(values, lever)
        self.assertIn("design own", (made / "design.txt").read_text())
        # Written again over itself with another design: nothing of the first is left.
        (made / "rtl/stale.sv").write_text("")
        self.board("--design", "lever", "-o", "de0_nano_own")
        self.assertEqual((made / "rtl/parameters.mem").read_text(), lever)
        self.assertFalse((made / "rtl/stale.sv").exists())

    def test_board_of_a_design_by_mt(self):
        """It has the estimator of the design, and what that is made of."""
        own = (ROOT / "rtl/designs/lever.toml").read_text()
        own, found = re.subn(r"m1 = 767\nn = 1 .*", 'estimator = "mt"\nwindow_s = 386e-6\ncycles = 16', own)
        self.assertEqual(found, 1)
        (self.folder / "mt.toml").write_text(own)
        self.board("--design", "mt.toml")
        made = self.folder / "de0_nano_mt"
        by_mt = (ROOT / "rtl/options/mt/velocity_estimator.sv").read_text()
        self.assertEqual((made / "rtl/velocity_estimator.sv").read_text(), by_mt)
        self.assertIn("SYSTEMVERILOG_FILE rtl/span_meter.sv\n", (made / "de0_nano.qsf").read_text())

    def test_board_refused(self):
        own = (ROOT / "rtl/designs/lever.toml").read_text()
        fast = own.replace("clock_hz = 50_000_000", "clock_hz = 100_000_000")
        (self.folder / "fast.toml").write_text(fast)
        (self.folder / "mine").mkdir()
        (self.folder / "mine/thesis.txt").write_text("x")
        for words, said in (
            (("--design", "fast.toml"), "the board's clock is 50 MHz, the design wants 100"),
            (("-o", "mine"), "not from here"),
            (("-o", "mine/thesis.txt"), "is a file"),
            (("--design", "levr"), "levr is neither"),
        ):
            with self.subTest(said):
                self.ended(self.product("board", *words), 2, said)
        self.assertEqual((self.folder / "mine/thesis.txt").read_text(), "x")


if __name__ == "__main__":
    unittest.main()
