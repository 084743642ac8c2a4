#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Every line of docs/instantiate.md, on the instance that stands there; and the examples beside it
connect every port of the core.

instantiate_test.py VENV: the folder into which scripts/build.sh has fetched pyslang.
"""

import os
import re
import shutil
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, ran, text_of

VENV = Path(sys.argv.pop(1))
PAGE = text_of("docs/instantiate.md")
INSTANCE = re.search(r"```systemverilog\n(.*?)```", PAGE, re.S)[1]
LINES = "".join(re.findall(r"```sh\n(.*?)```", PAGE, re.S)).splitlines()
FILES = LINES[0]


class Instantiate(Scratch):
    def setUp(self):
        super().setUp()
        for name in ("rtl", "testbench"):
            (self.folder / name).symlink_to(ROOT / name)
        (self.folder / "my_core.sv").write_text(INSTANCE, encoding="utf-8")

    def shell(self, *lines):
        return ran("bash", "-ec", "\n".join(lines), cwd=self.folder)

    def passes(self, *lines):
        done = self.shell(*lines)
        told = [line for line in (done.stdout + done.stderr).splitlines() if not line.startswith("- ")]  # Verilator's times
        self.assertEqual((done.returncode, told), (0, []), lines[-1])

    def line(self, tool):
        (found,) = (line for line in LINES if line.startswith(tool) and "ulx3s" not in line)
        if not shutil.which(tool.split()[0]):
            self.skipTest(f"no {tool}")
        return found

    def test_verilator(self):
        self.passes(FILES, self.line("verilator"))
        # A port that is left out is found.
        (self.folder / "my_core.sv").write_text(INSTANCE.replace(".enc_z_i(1'b0),", ""))
        self.assertIn("PINMISSING", self.shell(FILES, self.line("verilator")).stderr)

    def test_yosys(self):
        # The front end and the checks of its netlist; ./feltgate synth maps the core to cells.
        line = self.line("yosys")
        self.assertIn("synth_ecp5 -top my_core -json my_core.json", line)
        ends = 'synth_ecp5 -run begin:coarse -top my_core; check -assert"'
        self.passes(FILES, line.split("synth_ecp5")[0] + ends)

    def test_quartus(self):
        (line,) = (line for line in LINES if line.startswith("for f in"))
        self.passes(FILES, line)
        qsf = (self.folder / "my_core.qsf").read_text(encoding="utf-8")
        files = re.findall(r"^set_global_assignment -name SYSTEMVERILOG_FILE (\S+)$", qsf, re.M)
        self.assertEqual(files[0], "rtl/generated/lever/cfg.sv")
        self.assertEqual(files[-1], "my_core.sv")
        self.assertGreater(len(files), 30)
        for name in files:
            self.assertTrue((self.folder / name).is_file(), name)
        python = VENV / "bin/python"
        if not python.exists() and not os.environ.get("CI"):
            self.skipTest("no pyslang; ./feltgate test fetches it")
        done = ran(python, "-B", ROOT / "scripts/quartus_subset.py", self.folder / "my_core.sv")
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))

    def test_board(self):
        (line,) = (line for line in LINES if "ulx3s" in line)
        self.passes(line)

    def test_the_examples_connect_every_port(self):
        bus = FILES.replace("feltgate_core.f", "feltgate_bus.f")
        for top, file in (
            ("wishbone_core", "docs/examples/wishbone_core.sv"),
            ("axi_core", "docs/examples/cocotb/axi_core.sv"),
        ):
            lint = self.line("verilator").replace("my_core", top)
            lint = lint.replace(" -Wno-PINCONNECTEMPTY", "")
            self.passes(bus.replace("my_core.sv", str(ROOT / file)), lint)


if __name__ == "__main__":
    unittest.main()
