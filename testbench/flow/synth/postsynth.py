#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Makes what a post-synthesis lock-step needs: netlist.v, the netlist of a block or board as Yosys maps
it, with the cells' models flattened in (neither Verilator nor Icarus reads Yosys' cells_sim.v), and
pair.sv, which drives netlist and RTL alike. Called by testbench/flow/CMakeLists.txt.

  postsynth.py --root R --design lever --block dob --output DIR [--defect PATCH] [--parameter N=V]
  postsynth.py --root R --design lever --board ulx3s --output DIR  the whole of a board, with pins
"""

import argparse
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "scripts"))
import synth_board  # noqa: E402
import synth_measure  # noqa: E402
from seeded_defects import patches  # noqa: E402
from synth_tools import ToolError, Tools  # noqa: E402

BOARD_CLOCKS = ("clk_25mhz", "clk_27mhz")  # clk in pair.sv
CLOCKS = ("clk_i", "rst_ni", *BOARD_CLOCKS)
MODELS = ("mult18x18d_model.sv", "dp16kd_model.sv")
GOWIN_MODELS = ("gowin_cells_model.sv",)
HARNESS = Path("model/sim/backends/feltgate_core.sv")
# The stub of a board's PLL; the family is that of Tools.write_simulation().
BOARDS = {"ulx3s": ("EHXPLLL.sv", "ecp5", MODELS), "tang_nano_9k": ("rPLL.sv", "gowin", GOWIN_MODELS)}


def pair(block, ports, parameters):
    """RTL and netlist with the same inputs, each with its outputs in one word."""
    ins = [p for p in ports if p[1] == "input" and p[0] not in CLOCKS]
    outs = [p for p in ports if p[1] == "output"]
    instances = []
    for kind, module in (("rtl", f"{block} #({parameters})"), ("netlist", f"{block}_netlist")):
        pins = [
            f".{name}({'clk' if name in BOARD_CLOCKS else name})" for name, _, _ in ports if name in CLOCKS
        ]
        for word, some in (("in_i", ins), (f"{kind}_o", outs)):
            start = 0
            for name, _, width in some:
                pins.append(f".{name}({word}[{start}+:{width}])")
                start += width
        instances.append(f"  {module} u_{kind} ({', '.join(pins)});")
    n_in, n_out = sum(p[2] for p in ins), sum(p[2] for p in outs)
    of_board = any(name in BOARD_CLOCKS for name, _, _ in ports)
    # A block without a reset has the pin all the same: the test drives it.
    clocks = "clk" if of_board else "clk_i, rst_ni"
    head = (
        f"module pair (input logic {clocks}, input logic [{n_in - 1}:0] in_i, "
        f"output logic [{n_out - 1}:0] rtl_o, netlist_o);"
    )
    return "\n".join([head, *instances, "endmodule", ""]), n_in, n_out


def fields(ports, wanted):
    """C++: where each output or input lies, so that it has a name."""
    start, rows = 0, []
    for name, way, width in ports:
        if way == wanted and name not in CLOCKS:
            rows.append(f'    {{"{name}", {start}, {width}}},')
            start += width
    return rows


def change_defaults(path, values):
    text = path.read_text(encoding="utf-8")
    for name, value in values:
        text, count = re.subn(rf"(parameter int {name} *= )[^,]+,", rf"\g<1>{value},", text)
        if count != 1:
            raise ToolError(f"{path} has no parameter {name}; correct the caller")
    path.write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, required=True)
    parser.add_argument("--design", required=True, help="its name, or the path of its package")
    parser.add_argument("--block")
    parser.add_argument("--board", choices=BOARDS, help="instead of a block")
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--parameter", action="append", default=[], help="of RTL and netlist")
    parser.add_argument("--defect", nargs=2, metavar=("FILE", "NAME"), help="of the netlist alone")
    options = parser.parse_args()
    block, output = options.board or options.block, options.output
    pll, family, models = BOARDS.get(options.board, (None, "ecp5", MODELS))
    design = Path(options.design) if options.design.endswith(".sv") else options.design
    output.mkdir(parents=True, exist_ok=True)
    try:
        tools = Tools(output)
        if options.board:
            sources = synth_board.sources(options.root, block, design, output)
            stub = options.root / "testbench/boards/boards/stub" / pll
            (output / pll).write_text(stub.read_text(encoding="utf-8"), encoding="utf-8")
        else:
            sources = synth_measure.copy_sources(options.root, design, output)
            if block == HARNESS.stem:  # the device of the design with a port for each pin and signal
                (output / HARNESS.name).write_text((options.root / HARNESS).read_text(encoding="utf-8"), encoding="utf-8")
                sources.append(HARNESS.name)
        read = synth_measure.read_commands(sources)
        for model in models:
            (output / model).write_text(
                (Path(__file__).parent / model).read_text(encoding="utf-8"), encoding="utf-8"
            )
        values = [p.split("=") for p in options.parameter]
        if options.defect:
            for path, text in patches.patched(Path(*options.defect), options.root).items():
                (output / path.name).write_text(text, encoding="utf-8")
        change = " ".join(f"-chparam {n} {v}" for n, v in values)
        if options.board:  # Yosys 0.23 takes a parameter of a top with parameters below it only so
            change_defaults(output / f"{block}.sv", values)
        elif block.startswith("scene_") or values:
            read = [*read, f"hierarchy {change} -top {block}"]
        ports = tools.ports(block, read)
        tools.write_simulation(block, read, (*models, pll) if pll else models, family)
    except (ToolError, patches.DefectError) as error:
        print(error, file=sys.stderr)
        return 1
    parameters = ", ".join(f".{n}({v})" for n, v in values)
    text, n_in, n_out = pair(block, ports, parameters)
    (output / "pair.sv").write_text(text, encoding="utf-8")
    header = [
        "// Written by testbench/flow/synth/postsynth.py.",
        "#pragma once",
        f"constexpr int kInputBits = {n_in};",
        f"constexpr int kOutputBits = {n_out};",
        "struct Field { const char* name; int first; int width; };",
        "constexpr Field kFields[] = {",
        *fields(ports, "output"),
        "};",
        "constexpr Field kInputs[] = {",
        *fields(ports, "input"),
        "};",
    ]
    (output / "pair_fields.hpp").write_text("\n".join(header) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
