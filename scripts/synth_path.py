# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""nextpnr's critical path with the RTL's names: source register, logic between, target register."""

import json
import re

# Yosys' autoname builds a name from a neighbour's by such suffixes; it may be quite another signal.
MADE_UP = re.compile(
    r"_(?:TRELLIS_FF|LUT[1-4]|CCU2C|MULT18X18D?|DP16KD|PFUMX|L6MUX21|DFF[A-Z]*|ALU)(?:_|$)|\$"
)
OUTPUTS = {"MULT18X18D": r"P\d+$", "DP16KD": r"DO[AB]\d+$"}
REGISTER = re.compile(r"TRELLIS_FF$|DFF[A-Z]*$")


def clock(report):
    """What the report has of the one clock."""
    return next(iter(report["fmax"].values()))


def fmax(report):
    """MHz of the one clock."""
    return clock(report)["achieved"]


def signal_names(netlist, prefix="u_dut."):
    """For every bit the best name that the RTL has for it, if any."""
    names = {}
    for name, net in netlist["netnames"].items():
        if MADE_UP.search(name) or not name.startswith(prefix):
            continue
        for index, bit in enumerate(net["bits"]):
            label = f"{name}[{index}]" if len(net["bits"]) > 1 else name
            # Deepest in the hierarchy says most; among those, a register by its own name.
            rank = (name.count("."), name.endswith("_q"), -len(name))
            if bit not in names or rank > names[bit][0]:
                names[bit] = (rank, label)
    return {bit: label for bit, (_, label) in names.items()}


def cell_label(cell, netlist, names):
    """What a register drives by its name in the RTL; where Yosys kept none, its always_ff block."""
    found = netlist["cells"].get(cell) or netlist["cells"].get(cell.split("$")[0])
    if not found:
        return "?"
    for port, bits in found["connections"].items():
        output = "Q$" if REGISTER.match(found["type"]) else OUTPUTS.get(found["type"], "$.")
        if re.match(output, port) and bits and bits[0] in names:
            return names[bits[0]].removeprefix("u_dut.")
    source = found.get("attributes", {}).get("src", "")
    place = re.match(r"(\w+\.sv):(\d+)", source)
    if place and place.group(1).endswith("_speed.sv"):
        return "the wrapper"
    if place and REGISTER.match(found["type"]):
        return f"{place.group(1)}:{place.group(2)}"
    return cell.removeprefix("u_dut.")


def describe(report, netlist_path, top="speed_top", prefix="u_dut."):
    """One line: start -> end, its time, how it divides, what it passes."""
    netlist = json.loads(netlist_path.read_text(encoding="utf-8"))["modules"][top]
    names = signal_names(netlist, prefix)
    steps = report["critical_paths"][0]["path"]
    routing = sum(step["delay"] for step in steps if step["type"] == "routing")
    total = sum(step["delay"] for step in steps)
    cells = [step["from"]["cell"] for step in steps if step["type"] == "logic"]
    carries = [cell for cell in cells if "$CCU2_COMB" in cell or re.search(r"_ALU_|_ALULC", cell)]
    start, end = (
        cell_label(step[way]["cell"], netlist, names)
        for step, way in ((steps[0], "from"), (steps[-1], "to"))
    )
    through = [f"{len(cells) - len(carries)} LUT" if len(cells) > len(carries) else ""]
    through += [f"{len(carries)} carry bits" if carries else ""]
    how = ", ".join([t for t in through if t] or ["no logic"])
    return f"{start} -> {end}: {total:.2f} ns, {routing:.2f} of it routing, {how}"
