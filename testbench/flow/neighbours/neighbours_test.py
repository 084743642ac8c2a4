#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""FuseSoC builds lint and sim and lists the boards' files; the examples of cocotb and LiteX run.

neighbours_test.py VENV CLASS: where scripts/build.sh has fetched them. docs/other-tools.md
"""

import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, ran
from seeded_defects import patches

VENV = Path(sys.argv.pop(1))
EXAMPLES = ROOT / "docs/examples"


def run(*command, cwd, **more):
    """(status, all that was said)."""
    env = os.environ | {"PATH": f"{VENV / 'bin'}:{os.environ['PATH']}"} | more
    both = {"capture_output": False, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    done = ran(*command, cwd=cwd, env=env, **both)
    return done.returncode, done.stdout


def broken(folder, patch):
    """A copy of what the examples need, with a seeded defect in it."""
    for name in ("rtl", "docs/examples", "testbench/flow/neighbours"):
        shutil.copytree(ROOT / name, folder / name)
    shutil.copy(ROOT / "feltgate.core", folder)
    if patch:
        patches.write_copies(ROOT / "testbench" / patch, folder)
    return folder


@unittest.skipUnless(
    (VENV / "bin/fusesoc").exists() or os.environ.get("CI"),
    "no FuseSoC, cocotb and LiteX; ./feltgate test fetches them",
)
class Neighbours(Scratch):
    def need(self, program):
        if not shutil.which(program):
            if os.environ.get("CI"):
                self.fail(f"no {program}")
            self.skipTest(f"no {program}")


class Fusesoc(Neighbours):
    def fusesoc(self, target, *options, root=ROOT):
        """(status, what was said, where it worked)."""
        work = self.folder / target
        return *run(
            "fusesoc", "--config", os.devnull, "--cores-root", root, "run", *options, "--work-root",
            work, "--target", target, "feltgate::feltgate", cwd=self.folder,
        ), work  # fmt: skip

    def test_lint(self):
        self.need("verilator")
        status, said, _ = self.fusesoc("lint")
        self.assertEqual(status, 0, said)
        self.assertNotIn("%Warning", said)
        root = broken(self.folder / "copy", None)
        file = root / "rtl/core/estimators/lowpass.sv"
        file.write_text(file.read_text().replace("endmodule", "  wire nobodys;\nendmodule", 1))
        status, said, _ = self.fusesoc("lint", root=root)
        self.assertNotEqual(status, 0)
        self.assertIn("nobodys", said)

    def test_sim(self):
        self.need("iverilog")
        status, said, _ = self.fusesoc("sim")
        self.assertEqual(status, 0, said)
        self.assertIn("smoke: passed", said)
        root = broken(
            self.folder / "copy", "bus/wishbone_port/defects.diff/answered_while_it_waits"
        )
        _, said, _ = self.fusesoc("sim", root=root)
        self.assertIn("instead of", said)
        self.assertNotIn("smoke: passed", said)

    def listed(self, work, name):
        """Files of the project that FuseSoC has set up, below the root."""
        text = next(work.glob("*.eda.yml")).read_text(encoding="utf-8")
        found = re.findall(r"name: src/[^/]*/(\S+)", text)
        for path in found:
            self.assertTrue(list(work.glob(f"src/*/{path}")), path)
        boards = {f"rtl/boards/{name}/{p.name}" for p in ROOT.glob(f"rtl/boards/{name}/*.sv")}
        self.assertLess(boards, set(found))
        return found

    def test_de0_nano(self):
        status, said, work = self.fusesoc("de0_nano", "--setup")
        self.assertEqual(status, 0, said)
        found = self.listed(work, "de0_nano")
        qsf = (ROOT / "rtl/boards/de0_nano/de0_nano.qsf").read_text(encoding="utf-8")
        wanted = re.findall(r"SYSTEMVERILOG_FILE (\S+)", qsf)
        here = ROOT / "rtl/boards/de0_nano"
        self.assertEqual(
            {os.path.relpath(here / path, ROOT) for path in wanted},
            {path for path in found if path.endswith(".sv")},
        )
        tcl = next(work.glob("*.tcl")).read_text(encoding="utf-8")
        self.assertIn("settings.tcl", tcl)
        if not shutil.which("tclsh"):
            return
        # What Quartus would be told, by a Tcl that only prints it.
        (self.folder / "print.tcl").write_text(
            "proc unknown {args} {puts $args}\n"
            f"source {next(work.glob('src/*/rtl/boards/de0_nano/settings.tcl'))}\n"
        )
        status, said = run("tclsh", "print.tcl", cwd=self.folder)
        self.assertEqual(status, 0, said)
        pins = re.findall(r"^set_location_assignment (\S+) -to (\S+)$", qsf, re.M)
        told = re.findall(r"^set_location_assignment (\S+) -to \{?([^\s}]+)\}?$", said, re.M)
        self.assertGreater(len(pins), 20)
        self.assertEqual(pins, told)
        self.assertNotIn("_FILE", said)


class Cocotb(Neighbours):
    def example(self, root):
        build = self.folder / "sim"
        return run(
            VENV / "bin/python", "-B", root / "docs/examples/cocotb/test_axi.py", cwd=self.folder,
            COCOTB_BUILD=str(build), FELTGATE_ROOT=str(root),
        )  # fmt: skip

    def test_example(self):
        self.need("iverilog")
        status, said = self.example(ROOT)
        self.assertEqual(status, 0, said)
        self.assertIn("3 tests, 0 failed", said)

    def test_a_defect_is_seen(self):
        self.need("iverilog")
        root = broken(self.folder / "copy", "bus/axi_lite_port/defects.diff/disarm_waits")
        status, said = self.example(root)
        self.assertEqual(status, 1, said)
        self.assertIn("a_disarm_passes_a_write_that_waits failed", said)


class Litex(Neighbours):
    def soc(self, root):
        """What the testbench says of the SoC."""
        out = self.folder / "out"
        status, said = run(
            VENV / "bin/python", "-B", root / "docs/examples/litex_soc.py", out, cwd=self.folder,
            FELTGATE_ROOT=str(root),
        )  # fmt: skip
        self.assertEqual(status, 0, said)
        self.assertIn("memory_region,feltgate,0x30000000,16384", (out / "csr.csv").read_text())
        script = (out / "gateware/soc.ys").read_text(encoding="utf-8")
        files = re.findall(r"^read_verilog (?:-sv )?(\S+)$", script, re.M)
        self.assertGreater(len(files), 30)
        bench = root / "testbench/flow/neighbours/soc_tb.sv"
        program = self.folder / "soc.vvp"
        status, said = run(
            "iverilog", "-g2012", "-s", "soc_tb", "-o", program, *files, bench, cwd=out / "gateware"
        )
        self.assertEqual(status, 0, said)
        return run("vvp", "-n", program, cwd=out / "gateware")[1]

    def test_example(self):
        self.need("iverilog")
        self.assertIn("soc: passed", self.soc(ROOT))

    def test_a_defect_is_seen(self):
        self.need("iverilog")
        root = broken(self.folder / "copy", "bus/wishbone_port/defects.diff/error_is_no_error")
        said = self.soc(root)
        self.assertNotIn("soc: passed", said)


if __name__ == "__main__":
    unittest.main()
