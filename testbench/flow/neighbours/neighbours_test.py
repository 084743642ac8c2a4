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

VENV = Path(sys.argv.pop(1))
EXAMPLES = ROOT / "docs/examples"
MAP = ROOT / "rtl/generated/map.sv"


def run(*command, cwd, **more):
    """(status, all that was said)."""
    env = os.environ | {"PATH": f"{VENV / 'bin'}:{os.environ['PATH']}"} | more
    both = {"capture_output": False, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    done = ran(*command, cwd=cwd, env=env, **both)
    return done.returncode, done.stdout


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
    def fusesoc(self, target, *options):
        """(status, what was said, where it worked)."""
        work = self.folder / target
        return *run(
            "fusesoc", "--config", os.devnull, "--cores-root", ROOT, "run", *options, "--work-root",
            work, "--target", target, "feltgate::feltgate", cwd=self.folder,
        ), work  # fmt: skip

    def test_lint(self):
        self.need("verilator")
        status, said, _ = self.fusesoc("lint")
        self.assertEqual(status, 0, said)
        self.assertNotIn("%Warning", said)

    def test_sim(self):
        self.need("verilator")
        status, said, _ = self.fusesoc("sim")
        self.assertEqual(status, 0, said)
        self.assertIn("smoke: passed", said)

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
    def test_example(self):
        for program in ("iverilog", "yosys"):
            self.need(program)
        where = {"COCOTB_BUILD": str(self.folder / "sim"), "FELTGATE_ROOT": str(ROOT)}
        status, said = run(VENV / "bin/python", "-B", EXAMPLES / "cocotb/test_axi.py", cwd=self.folder, **where)
        self.assertEqual(status, 0, said)
        self.assertIn("3 tests, 0 failed", said)


class Litex(Neighbours):
    def test_example(self):
        for program in ("iverilog", "yosys"):
            self.need(program)
        out, program, netlist = self.folder / "out", self.folder / "soc.vvp", self.folder / "soc.v"
        words = (VENV / "bin/python", "-B", EXAMPLES / "litex_soc.py", out)
        status, said = run(*words, cwd=self.folder, FELTGATE_ROOT=str(ROOT))
        self.assertEqual(status, 0, said)
        self.assertIn("memory_region,feltgate,0x30000000,16384", (out / "csr.csv").read_text())
        script = (out / "gateware/soc.ys").read_text(encoding="utf-8")
        files = re.findall(r"^read_verilog (?:-sv )?(\S+)$", script, re.M)
        self.assertGreater(len(files), 30)
        # Icarus does not take structs in packages: Yosys makes plain Verilog of them.
        top = re.search(r"^synth\S* .*-top (\w+)", script, re.M)[1]
        script = f"read_verilog -sv {' '.join(files)}; prep -flatten -top {top}; write_verilog -noattr {netlist}"
        status, said = run("yosys", "-q", "-p", script, cwd=out / "gateware")
        self.assertEqual(status, 0, said)
        bench = ROOT / "testbench/flow/neighbours/soc_tb.sv"
        words = ("iverilog", "-g2012", "-s", "soc_tb", "-o", program, netlist, MAP, bench)
        status, said = run(*words, cwd=out / "gateware")
        self.assertEqual(status, 0, said)
        self.assertIn("soc: passed", run("vvp", "-n", program, cwd=out / "gateware")[1])


if __name__ == "__main__":
    unittest.main()
