# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Whole boards for `feltgate synth --board`: ULX3S and Tang Nano 9K to a bitstream, the DE0-Nano as cells.

Documentation: docs/boards/ulx3s.md, docs/boards/tang_nano_9k.md, docs/boards/de0_nano.md
"""

import json
import math
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

import outputs
import synth_measure
import synth_path
from synth_tools import ToolError, Tools, counted, feeds, package_of, version

# The gates' flip-flops: cleared without a clock, behind the output buffers of the pins.
GOWIN_GATES = "o:gate_* %ci1:+OBUF[O] %ci1:+OBUF[I] %ci1 t:DFFC* %i"
# Above this share of a GW1NR-9C's places nextpnr finds no legal placement: docs/boards/tang_nano_9k.md
GOWIN_FULL = 0.8
# What the I/O cell of a gate has to have: its register, cleared without a clock, off.
GATE_CELL = ("SRMODE ASYNC", "OUTREG.REGSET RESET", "OUTREG.OUTREGMODE FF", "LSRMUX LSR")
# EP4CE22F17C6: logic elements, blocks of 9216 bits, multipliers of 18 by 18 bits.
# As Quartus' fitter summaries of the chip have them, such as that of stnolting/neorv32-setups for this board:
# 22,320 elements, 608,256 memory bits, 132 elements of 9 by 9 bits.
EP4CE22 = {"cells": 22320, "m9k": 66, "mult18": 66}
EP4CE22_BITS = EP4CE22["m9k"] * 9216


def of_package(folder, name):
    return int(re.search(rf"int {name} = (\d);", (folder / "cfg.sv").read_text(encoding="utf-8"))[1])


def legs(folder):
    return of_package(folder, "PHASES")


def sources(root, board, design, folder):
    """Copies all files of the board into the folder; their names in reading order."""
    names = synth_measure.copy_sources(root, design, folder)
    if board == "tang_nano_9k" and (legs(folder) == 3 or of_package(folder, "CURRENT_LOOP")):
        raise ToolError(f"{design} has three phases or a current loop, which do not fit {board}; take ulx3s")
    beside = sorted(root.glob("rtl/boards/panel/*.sv"))
    for path in [*beside, *sorted(root.glob(f"rtl/boards/{board}/*.*"))]:
        shutil.copy(path, folder)
        if path.suffix == ".sv":
            names.append(path.name)
    return names


def clock_hz(folder):
    text = (folder / "cfg.sv").read_text(encoding="utf-8")
    return int(re.search(r"\bCLOCK_HZ = (\d+);", text).group(1))


def with_clock(root, design, hz, folder):
    """A design of rtl/designs with another clock as a file of its own; a user's own file as it is. The serial clock of
    an absolute encoder becomes the fastest that is not above its own and that this clock can be divided to."""
    path = root / f"rtl/designs/{design}.toml"
    if hz is None or not path.is_file():
        return design
    text, count = re.subn(r"^clock_hz = [\d_]+", f"clock_hz = {hz:_}", path.read_text(encoding="utf-8"), flags=re.M)
    if count != 1:
        raise ToolError(f"{path} has {count} lines clock_hz; give one")
    text = re.sub(
        r"^serial_hz = ([\d_]+)",
        lambda m: f"serial_hz = {hz / (2 * math.ceil(hz / (2 * int(m[1].replace('_', ''))))):.10g}",
        text,
        flags=re.M,
    )
    folder.mkdir(parents=True, exist_ok=True)
    changed = folder / f"{design}_{hz // 1_000_000}mhz.toml"
    changed.write_text(text, encoding="utf-8")
    return str(changed)


def gate_cells(text):
    """How many I/O cells of nextpnr's configuration have the register of a gate."""
    cells = {}
    for tile in text.split(".tile ")[1:]:
        for cell, setting in re.findall(r"^enum: (\w*IOLOGIC\w)\.(.*)$", tile, re.M):
            cells.setdefault((tile.splitlines()[0], cell), set()).add(setting)
    return sum(all(wanted in settings for wanted in GATE_CELL) for settings in cells.values())


class Ulx3s:
    """ECP5: the steps to a bitstream, and what it has of what is counted."""

    chip, packed, clock_hz = "LFE5U-85F", "bit", None
    there = {"lut4_equivalents": 83640, "ff": 83640, "mult18": 156, "bram": 208}
    names = ("LUT4 equivalents", "flip-flops", "MULT18X18D", "DP16KD")

    def synthesize(self, tools, read):
        return synth_measure.ecp5_figures(tools.synthesize_ecp5("board", "ulx3s", read))

    def write_netlist(self, tools):
        # The gates' registers into the I/O cells: nextpnr reads it from the cell.
        tools.write_netlist(
            "board",
            "select -set gates w:gate_?_??_o %ci1 t:TRELLIS_FF %i",
            f"select -assert-count {2 * legs(tools.folder)} @gates",
            'setattr -set syn_useioff 1 -set ioff_dir "output" @gates',
        )

    def route(self, tools, seed, _):
        return tools.route_board("board", seed, "ulx3s.lpf")

    def check(self, tools, seed):
        """A line about the gates' registers, or ToolError where they are not what they have to be."""
        configuration = tools.folder / f"board_{seed}.config"
        found = gate_cells(configuration.read_text(encoding="utf-8"))
        gates = 2 * legs(tools.folder)
        if found != gates:
            raise ToolError(f"{found} of {gates} gates leave from a register in an I/O cell: {configuration}")
        return f"gate registers in I/O cells, cleared without a clock: {found} of {gates}"

    def pack(self, tools, seed):
        return tools.pack(f"board_{seed}")


class TangNano9k:
    """Gowin GW1NR-9C. A design of rtl/designs gets the clock that the board's PLL makes of 27 MHz."""

    chip, packed, clock_hz = "GW1NR-9C", "fs", 54_000_000
    there = {"lut4_equivalents": 8640, "ff": 6480, "mult18": 20, "bram": 26}
    names = ("LUT4 equivalents", "flip-flops", "MULT18X18", "BSRAM")

    def synthesize(self, tools, read):
        return synth_measure.gowin_figures(tools.synthesize_gowin("board", "tang_nano_9k", read))

    def write_netlist(self, tools):
        tools.write_netlist("board", f"select -assert-count {2 * legs(tools.folder)} {GOWIN_GATES}")
        figures = synth_measure.gowin_figures(counted(tools.folder / "board.stat")["num_cells_by_type"])
        there, luts = self.there["lut4_equivalents"], figures["lut4_equivalents"]
        found = feeds(json.loads((tools.folder / "board.json").read_text(encoding="utf-8"))["modules"]["tang_nano_9k"])
        least = luts + found["none"]
        print(
            f"flip-flops behind a LUT {found['LUT']}, behind a carry {found['ALU']}, behind neither {found['none']}: "
            f"{least} to {least + found['ALU']} places of {there}, and the ends of the carry chains"
        )
        if least > GOWIN_FULL * there:
            raise ToolError(
                f"{least} of {there} places: above {GOWIN_FULL:.0%} nextpnr finds no legal placement. Leave out scenes "
                "(feltgate design --for) or options, or take ulx3s"
            )

    def route(self, tools, seed, mhz):
        return tools.route_gowin("board", seed, "tang_nano_9k.cst", mhz)

    def check(self, tools, _seed):
        gates = 2 * legs(tools.folder)  # write_netlist() has counted them
        return f"gate registers cleared without a clock: {gates} of {gates}; in the fabric, not in I/O cells"

    def pack(self, tools, seed):
        return tools.pack_gowin(f"board_{seed}")


ROUTED = {"ulx3s": Ulx3s(), "tang_nano_9k": TangNano9k()}
BOARDS = (*ROUTED, "de0_nano")


def measure_routed(tools, board, steps, read, seeds, hz):
    """Figures and the seed of the fastest result; the results of all are in the folder."""
    figures = steps.synthesize(tools, read)
    if not seeds:
        return figures, None
    steps.write_netlist(tools)
    found = synth_measure.by_speed(lambda seed: steps.route(tools, seed, hz / 1e6), seeds)
    slowest, netlist = found[0][0], tools.folder / "board.json"
    path = synth_path.describe(slowest, netlist, board, "u_")
    figures |= synth_measure.speeds(found) | {"clock_mhz": hz / 1e6, "critical_path": path}
    wanted = synth_path.clock(slowest)["constraint"]
    if abs(wanted - hz / 1e6) > 0.01:
        raise ToolError(f"the PLL gives {wanted} MHz, the design wants {hz / 1e6:g} MHz")
    return figures, found[-1][1]


def output_of(options):
    return options.output or Path(f"{options.board}.{ROUTED[options.board].packed}")


def main_routed(tools, read, options, seeds):
    board, hz = options.board, clock_hz(tools.folder)
    steps = ROUTED[board]
    figures, best = measure_routed(tools, board, steps, read, seeds, hz)
    rows = [(name, figures[key], there) for name, (key, there) in zip(steps.names, steps.there.items())]
    print_rows(steps.chip, rows)
    if best is None:
        return figures, True
    closed = figures["fmax_min_mhz"] >= hz / 1e6
    print(
        f"Fmax {figures['fmax_mhz']:.1f} MHz [{figures['fmax_min_mhz']:.1f}-{figures['fmax_max_mhz']:.1f}] "
        f"of {len(seeds)} seeds, the design's clock {hz / 1e6:g} MHz: "
        f"timing {'closes in all' if closed else 'DOES NOT CLOSE in all'}"
    )
    print(f"critical path of the slowest: {figures['critical_path']}")
    print(steps.check(tools, best))
    if not closed:
        print("synth: no bitstream; lower clock_hz of the design", file=sys.stderr)
        return figures, False
    output = output_of(options)
    outputs.write_whole(output, steps.pack(tools, best).read_bytes())
    print(f"wrote {output} (seed {best})", file=sys.stderr)
    return figures, True


def main_de0_nano(tools, read, options, seeds):
    cells = tools.synthesize_cyclone("board", "de0_nano", read)
    figures = synth_measure.cyclone_figures(cells)
    figures["mult18"] = cells.get("cycloneive_mult18", 0)
    figures["memory_bits"] = tools.memory_bits("board", "de0_nano", read)
    figures["m9k"] = cells.get("altsyncram", 0)
    rows = [
        ("LUT and carry cells", figures["cyclone_cells"], EP4CE22["cells"]),
        ("flip-flops", figures["cyclone_ff"], EP4CE22["cells"]),
        ("memory bits", figures["memory_bits"], EP4CE22_BITS),
        ("M9K", figures["m9k"], EP4CE22["m9k"]),
        ("18 x 18 multipliers", figures["mult18"], EP4CE22["mult18"]),
    ]
    print_rows("EP4CE22F17C6, where a logic element holds a cell and a flip-flop", rows)
    print("Mapped by Yosys, not fitted: no place, no time. Quartus maps in its own way.")
    return figures, True


def print_rows(chip, rows):
    print(f"of {chip}")
    for name, used, there in rows:
        print(f"  {name:<19} {used:>7} of {there:>7}  {used / there:6.1%}")


def run(options, root, progress):
    """Figures {design: {row: figures}}, the tools that made them, and whether all is well."""
    design = (options.design or ["lever"])[0]
    name = Path(design).stem
    seeds = [] if options.no_route else [int(seed) for seed in options.seeds.split(",")]
    keep = os.environ.get("FELTGATE_BUILD")
    with tempfile.TemporaryDirectory(prefix="feltgate-synth-") as temporary:
        folder = Path(keep or temporary, "synth", f"{options.board}_{name}")
        folder.mkdir(parents=True, exist_ok=True)
        tools = Tools(folder)
        if seeds and options.board == "ulx3s" and tools.nextpnr is None:
            raise ToolError("no nextpnr-ecp5: run ./feltgate synth, which fetches it, or --no-route")
        steps = ROUTED.get(options.board)
        design = with_clock(root, design, steps and steps.clock_hz, folder / "design")
        package = package_of(root, design, folder / "design")
        names = sources(root, options.board, package, folder)
        read = synth_measure.read_commands(names)
        progress(f"{options.board}, design {name}: synthesis, then seeds {options.seeds}")
        print(f"{options.board}, design {name}; nothing of this ran on a board")
        main = main_routed if steps else main_de0_nano
        figures, fine = main(tools, read, options, seeds)
        progress("")
        if steps and steps.clock_hz and seeds and fine and Path(design).parent == folder / "design":
            beside, text = output_of(options).with_suffix(".toml"), Path(design).read_text(encoding="utf-8")
            if beside.exists() and beside.read_text(encoding="utf-8") != text:
                beside = beside.with_suffix(".design.toml")  # a file of the user's own is not replaced
            outputs.write_whole(beside, text)
            print(f"wrote {beside}, its design, for feltgate host --design", file=sys.stderr)
    used = {"yosys": version(tools.yosys), "nextpnr": version(tools.nextpnr)}
    return {name: {f"board {options.board}": figures}}, used, fine
