# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Whole boards for `feltgate synth --board`: the ULX3S to its bitstream, the DE0-Nano as cells of its chip.

Documentation: docs/boards/ulx3s.md, docs/boards/de0_nano.md
"""

import os
import re
import shutil
import statistics
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import design_package
import outputs
import synth_measure
import synth_path
from synth_tools import ToolError, Tools, version

BOARDS = ("ulx3s", "de0_nano")
GATES = 4
# What the I/O cell of a gate has to have: its register, cleared without a clock, off.
GATE_CELL = ("SRMODE ASYNC", "OUTREG.REGSET RESET", "OUTREG.OUTREGMODE FF", "LSRMUX LSR")
# EP4CE22F17C6: logic elements, blocks of 9216 bits, multipliers of 18 by 18 bits.
# As Quartus' fitter summaries of the chip have them, such as that of stnolting/neorv32-setups for this board:
# 22,320 elements, 608,256 memory bits, 132 elements of 9 by 9 bits.
EP4CE22 = {"cells": 22320, "m9k": 66, "mult18": 66}
EP4CE22_BITS = EP4CE22["m9k"] * 9216


def sources(root, board, design, folder):
    """Copies all files of the board into the folder; their names in reading order."""
    names = synth_measure.copy_sources(root, design, folder)
    beside = sorted(root.glob("rtl/boards/panel/*.sv"))
    for path in [*beside, *sorted(root.glob(f"rtl/boards/{board}/*.*"))]:
        shutil.copy(path, folder)
        if path.suffix == ".sv":
            names.append(path.name)
    return names


def clock_hz(folder):
    text = (folder / "feltgate_pkg.sv").read_text(encoding="utf-8")
    return int(re.search(r"\bCLOCK_HZ = (\d+);", text).group(1))


def gate_cells(text):
    """How many I/O cells of nextpnr's configuration have the register of a gate."""
    cells = {}
    for tile in text.split(".tile ")[1:]:
        for cell, setting in re.findall(r"^enum: (\w*IOLOGIC\w)\.(.*)$", tile, re.M):
            cells.setdefault((tile.splitlines()[0], cell), set()).add(setting)
    return sum(all(wanted in settings for wanted in GATE_CELL) for settings in cells.values())


def measure_ulx3s(tools, read, seeds, hz):
    """Figures and the seed of the fastest result; the configurations are in the folder."""
    figures = synth_measure.ecp5_figures(tools.synthesize_ecp5("board", "ulx3s", read))
    if not seeds:
        return figures, None
    # The gates' registers into the I/O cells: nextpnr reads it from the cell.
    tools.write_netlist(
        "board",
        "select -set gates w:gate_?_?? %ci1 t:TRELLIS_FF %i",
        f"select -assert-count {GATES} @gates",
        'setattr -set syn_useioff 1 -set ioff_dir "output" @gates',
    )
    with ThreadPoolExecutor(max_workers=2) as pool:
        reports = list(pool.map(lambda seed: tools.route_board("board", seed, "ulx3s.lpf"), seeds))
    by_speed = sorted(zip(reports, seeds), key=lambda pair: synth_path.fmax(pair[0]))
    speeds = [round(synth_path.fmax(report), 1) for report, _ in by_speed]
    slowest = by_speed[0][0]
    netlist = tools.folder / "board.json"
    figures |= {
        "fmax_mhz": round(statistics.median_low(speeds), 1),
        "fmax_min_mhz": speeds[0],
        "fmax_max_mhz": speeds[-1],
        "clock_mhz": hz / 1e6,
        "critical_path": synth_path.describe(slowest, netlist, "ulx3s", "u_"),
    }
    wanted = next(iter(slowest["fmax"].values()))["constraint"]
    if abs(wanted - hz / 1e6) > 0.01:
        raise ToolError(f"the PLL gives {wanted} MHz, the design wants {hz / 1e6:g} MHz")
    return figures, by_speed[-1][1]


def main_ulx3s(tools, read, options, seeds):
    hz = clock_hz(tools.folder)
    figures, best = measure_ulx3s(tools, read, seeds, hz)
    rows = [
        ("LUT4 equivalents", figures["lut4_equivalents"], 83640),
        ("flip-flops", figures["ff"], 83640),
        ("MULT18X18D", figures["mult18"], 156),
        ("DP16KD", figures["bram"], 208),
    ]
    print_rows("LFE5U-85F", rows)
    if best is None:
        return figures, True
    closed = figures["fmax_min_mhz"] >= hz / 1e6
    print(
        f"Fmax {figures['fmax_mhz']:.1f} MHz [{figures['fmax_min_mhz']:.1f}-{figures['fmax_max_mhz']:.1f}] "
        f"of {len(seeds)} seeds, the design's clock {hz / 1e6:g} MHz: "
        f"timing {'closes in all' if closed else 'DOES NOT CLOSE in all'}"
    )
    print(f"critical path of the slowest: {figures['critical_path']}")
    configuration = tools.folder / f"board_{best}.config"
    found = gate_cells(configuration.read_text(encoding="utf-8"))
    if found != GATES:
        raise ToolError(f"{found} of {GATES} gates leave from a register in an I/O cell: {configuration}")
    print(f"gate registers in I/O cells, cleared without a clock: {found} of {GATES}")
    if not closed:
        print("synth: no bitstream; lower clock_hz of the design", file=sys.stderr)
        return figures, False
    output = options.output or Path("ulx3s.bit")
    outputs.write_whole(output, tools.pack(f"board_{best}").read_bytes())
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


MAINS = {"ulx3s": main_ulx3s, "de0_nano": main_de0_nano}


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
        package = design_package.package_of(root, design, folder / "design")
        target = synth_measure.Target("board", options.board, registered=options.board == "ulx3s")
        names = sources(root, options.board, package, folder)
        read = synth_measure.read_commands(names, target)
        progress(f"{options.board}, design {name}: synthesis, then seeds {options.seeds}")
        print(f"{options.board}, design {name}; nothing of this ran on a board")
        figures, fine = MAINS[options.board](tools, read, options, seeds)
        progress("")
    used = {"yosys": version(tools.yosys), "nextpnr": version(tools.nextpnr)}
    return {name: {f"board {options.board}": figures}}, used, fine
