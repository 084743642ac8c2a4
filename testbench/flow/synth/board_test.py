#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""`feltgate synth --board`, with stand-ins for the tools: what it prints, refuses and writes.

board_test.py VENV SEEDS: with the tools of the venv, ULX3S to a bitstream, within the budget.
Documentation: docs/boards/ulx3s.md
"""

import json
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "common"))
from testing import ROOT, ran  # noqa: E402
import synth_board  # noqa: E402
import synth_budget  # noqa: E402

VENV = Path(sys.argv[1]) if len(sys.argv) > 1 else None
SEEDS = sys.argv[2] if VENV else ""

CELL = "\n".join(f"enum: IOLOGICA.{word}" for word in synth_board.GATE_CELL)
YOSYS = """#!/usr/bin/env python3
import json, re, sys
script = open(sys.argv[sys.argv.index("-s") + 1]).read()
cells = {"LUT4": 100, "CCU2C": 10, "TRELLIS_FF": 50, "MULT18X18D": 2, "DP16KD": 2,
         "cycloneive_lcell_comb": 300, "dffeas": 60, "altsyncram": 4, "cycloneive_mult18": 2}
stat = json.dumps({"design": {"num_cells_by_type": cells, "num_memory_bits": 34816}})
for name in re.findall(r"-o (\\S+) stat", script):
    open(name, "w").write(stat)
for name in re.findall(r"write_rtlil (\\S+)", script):
    open(name, "w").write("")
for name in re.findall(r"write_json (\\S+)", script):
    cells = {"a": {"type": "TRELLIS_FF", "connections": {"Q": [5]}, "attributes": {}}}
    nets = {"u_core.x_q": {"bits": [5]}}
    open(name, "w").write(json.dumps({"modules": {"ulx3s": {"cells": cells, "netnames": nets}}}))
"""
NEXTPNR = """#!/usr/bin/env python3
import json, sys
word = lambda name: sys.argv[sys.argv.index(name) + 1]
fmax = SPEEDS[word("--seed")]
step = {"type": "logic", "delay": 1.5, "from": {"cell": "a"}, "to": {"cell": "a"}}
path = {"path": [step]}
report = {"fmax": {"clk": {"achieved": fmax, "constraint": CLOCK}}, "critical_paths": [path]}
open(word("--report"), "w").write(json.dumps(report))
open(word("--textcfg"), "w").write(CONFIG)
"""
PACK = "#!/usr/bin/env python3\nimport sys\nopen(sys.argv[-1], 'w').write(sys.argv[-2])\n"


class StandIns(unittest.TestCase):
    """The board's script on tools that answer at once."""

    def run_board(self, *words, speeds=(90, 70, 80), clock=50, gates=4):
        with tempfile.TemporaryDirectory() as folder:
            config = "".join(f".tile R{n}\n{CELL}\n" for n in range(gates))
            constants = f"SPEEDS = {dict(zip('123', speeds))}\nCLOCK = {clock}\n"
            constants += f"CONFIG = {config!r}\n"
            nextpnr = NEXTPNR.replace("import json, sys\n", "import json, sys\n" + constants)
            for name, text in (("yosys", YOSYS), ("nextpnr-ecp5", nextpnr), ("ecppack", PACK)):
                path = Path(folder, "bin", f"yowasp-{name}")
                path.parent.mkdir(exist_ok=True)
                path.write_text(text, encoding="utf-8")
                path.chmod(0o755)
            environment = os.environ | {"FELTGATE_VENV": folder, "FELTGATE_BUILD": folder}
            output, figures = Path(folder, "my.bit"), Path(folder, "f.json")
            command = [sys.executable, "-B", ROOT / "scripts/synth.py", *words, "--json", figures]
            if "ulx3s" in words:
                command += ["-o", output]
            done = ran(*command, env=environment)
            written = output.read_text(encoding="utf-8") if output.exists() else ""
            there = json.loads(figures.read_text(encoding="utf-8")) if figures.exists() else None
            return done, written, there

    def test_the_fastest_seed_is_packed(self):
        done, written, there = self.run_board("--board", "ulx3s")
        self.assertEqual(done.returncode, 1)  # slower than the budget
        self.assertIn("fmax_mhz 80", done.stdout)
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

    def test_area_alone(self):
        done, written, there = self.run_board("--board", "ulx3s", "--no-route")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("fmax_mhz", there["designs"]["lever"]["board ulx3s"])
        self.assertEqual(written, "")

    def test_percent_of_the_cyclone(self):
        done, _, there = self.run_board("--board", "de0_nano")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("34816 of  608256    5.7%", done.stdout)
        self.assertEqual(there["designs"]["lever"]["board de0_nano"]["m9k"], 4)

    def test_wrong_words_are_refused(self):
        for words, said in (
            (("--board", "ulx3s", "--block", "core"), "neither --block nor --for"),
            (("--board", "ulx3s", "--design", "nowhere.toml"), "neither a design"),
            (("--board", "other"), "invalid choice"),
            (("--board", "ulx3s", "--design", "a", "--design", "b"), "takes one --design"),
        ):
            with self.subTest(words):
                done, _, _ = self.run_board(*words)
                self.assertEqual(done.returncode, 2)
                self.assertIn(said, done.stderr)

    def test_a_cell_that_lacks_one_setting_is_none(self):
        self.assertEqual(synth_board.gate_cells(f".tile A\n{CELL}\n"), 1)
        for setting in synth_board.GATE_CELL:
            text = f".tile A\n{CELL}\n".replace(f"enum: IOLOGICA.{setting}\n", "")
            text = text.replace(setting, "X")
            self.assertEqual(synth_board.gate_cells(text), 0, setting)

    def test_both_boards_have_a_budget(self):
        rows = synth_budget.read(ROOT / "scripts/synth_budget.toml")["figures"]["lever"]
        for board in synth_board.BOARDS:
            self.assertIn(f"board {board}", rows)


class Bitstream(unittest.TestCase):
    def setUp(self):
        if not (VENV / "bin").exists():
            self.skipTest("no Yosys from PyPI; ./feltgate synth fetches it")

    def test_within_the_budget(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-B", ROOT / "scripts/synth.py", "--board", "ulx3s"]
            environment = os.environ | {"FELTGATE_VENV": str(VENV)}
            environment.pop("FELTGATE_BUILD", None)
            done = ran(*command, "--seeds", SEEDS, "-o", Path(folder, "u.bit"), env=environment)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            count = SEEDS.count(",") + 1
            said = f"of {count} seeds, the design's clock 50 MHz: timing closes"
            self.assertIn(said, done.stdout)
            self.assertIn("synth: within the budget", done.stdout)
            data = Path(folder, "u.bit").read_bytes()
            self.assertTrue(re.search(rb"Part: LFE5U-85F-6CABGA381", data[:200]))
            self.assertGreater(len(data), 100_000)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "Bitstream" if VENV else "StandIns"])
