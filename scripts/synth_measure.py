# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Measurements of `feltgate synth`: blocks and variants of the core, wrappers, figures."""

import re
import shutil
import statistics
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path

import rtl_sources
import synth_path
import synth_tools

CORE = rtl_sources.CORE
AXES = "feltgate_axes"
LINKED = "feltgate_linked"
SCENE_ROW = "core without read-back"
# On a board nobody looks at these: they are there for simulation, or repeat what the register port
# reads. Everything that only they need is left out of the core's figures.
SNAPSHOT_PORTS = "tick_o snapshot_o word_o duty_active_o zeroed_o".split()
AXES_PORTS = (
    "snapshot_valid_o last_o tick_count_o position_o velocity_o tau_hat_o tau_ref_o current_ref_o voltage_o duty_o "
    "duty_active_o word_valid_o word_slot_o word_data_o measured_o zeroed_o"
).split()
# Inputs of a core that is alone and has no engine.
ALONE = ("law_i", "peers_i")
# Parameters that the core sets and a block alone would not have.
BLOCK_PARAMETERS = {
    **dict.fromkeys(("pwm", "pwm_three_phase"), {"Period": "cfg::PWM_PERIOD", "DeadClocks": "cfg::DEAD_CLOCKS",
        "ShortestClocks": "cfg::SHORTEST_CLOCKS"}),
    **dict.fromkeys(("commutation", "field_oriented"), {"Period": "cfg::PWM_PERIOD"}),
}


@dataclass(frozen=True)
class Target:
    """One row of the table."""

    name: str
    module: str
    parameters: dict = field(default_factory=dict)
    open_ports: tuple = ()
    tied_ports: tuple = ()  # to 0


def core_sources(root):
    """Files of the core's RTL in rtl/, in order; the design's package comes before them."""
    lines = (root / "rtl/feltgate_core.f").read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("//")]


def targets(root):
    names = [Path(source).stem for source in core_sources(root)]
    rows = [Target(name, name, BLOCK_PARAMETERS.get(name, {}))
            for name in names if name not in (CORE, "map", "fx", *rtl_sources.WIRED_ROOMS)]
    return rows + [
        Target(SCENE_ROW, CORE, {}, (*SNAPSHOT_PORTS, "reg_rdata_o"), ALONE),
        Target("core with read-back", CORE, {}, tuple(SNAPSHOT_PORTS), ALONE),
    ]


def beside_sources(root):
    """Files of the blocks beside the core in rtl/: link, buses, axes and engine, in order."""
    folders = [rtl_sources.folder_files(root, folder) for folder in rtl_sources.FOLDERS]
    return list(dict.fromkeys(sum(folders, [])))  # the link needs the axes, too


def beside_targets(root):
    """The blocks beside the core, each a row that is measured where it is asked for."""
    names = [Path(path).stem for path in beside_sources(root)
             if "_pkg" not in path and path.split("/")[0] not in ("options", "tops")]
    blocks = [Target(name, name) for name in names if name not in (AXES, "axes_member")]
    # The link of a design with one axis, beside which these are counted.
    several = [Target(f"{name}, {count} axes", name, {"AxisCount": str(count)})
               for name, count in (("link_view", 3), (LINKED, 2), (LINKED, 3))]
    return blocks + several + axes_targets()


def axes_targets():
    """One to three axes, beside a core with read-back."""
    return [
        Target(
            f"{count} {'axis' if count == 1 else 'axes'}",
            AXES,
            {"AxisCount": str(count)},
            tuple(AXES_PORTS),
            ("law_torque_i", "law_late_i", "law_restart_i", "reg_read_i"),
        )
        for count in (1, 2, 3)
    ]


def scene_target(root):
    """The row that scene sets are compared by: the core as a product without a host."""
    return next(row for row in targets(root) if row.name == SCENE_ROW)


def copy_sources(root, design, folder):
    """Copies package and RTL into the working folder, in reading order.

    DESIGN is the name of a generated design, or the path of a package.
    """
    is_path = isinstance(design, Path)
    package = design if is_path else synth_tools.package_file(root, design, folder / "design")
    text = package.read_text(encoding="utf-8")
    names = rtl_sources.of_design([*core_sources(root), *beside_sources(root)], text)
    shutil.copy(package, folder / "cfg.sv")
    for name in names:
        shutil.copy(root / "rtl" / name, folder)
    device = rtl_sources.device_text(root, text)
    (folder / Path(rtl_sources.INCLUDE).name).write_text(device, encoding="utf-8")
    return ["cfg.sv", *(Path(name).name for name in names)]


def read_commands(sources):
    return [f"read_verilog -sv {name}" for name in sources]


def of_design(target, folder):
    """The target, of the core the top of the design in the folder."""
    top = rtl_sources.top_of((folder / "cfg.sv").read_text(encoding="utf-8"))
    return replace(target, module=top) if target.module == CORE else target


def instance(target, connections):
    parameters = ", ".join(f".{n}({v})" for n, v in target.parameters.items())
    pins = ", ".join(f".{port}({net})" for port, net in connections)
    return f"{target.module} #({parameters}) u_dut ({pins});"


def area_top(target, ports):
    """The block as it is counted: its ports, without those that stay open."""
    kept = [p for p in ports if p[0] not in (*target.open_ports, *target.tied_ports)]
    pins = ", ".join(f"{way} logic [{width - 1}:0] {name}" for name, way, width in kept)
    nets = {**dict.fromkeys(target.open_ports, ""), **dict.fromkeys(target.tied_ports, "'0")}
    connections = [(name, nets.get(name, name)) for name, _, _ in ports]
    return f"module area_top ({pins});\n  {instance(target, connections)}\nendmodule\n"


def speed_top(target, ports):
    """The block between registers that are shifted in and out, so that no pin limits it."""
    clocks = ("clk_i", "rst_ni")
    ins = [p for p in ports if p[1] == "input" and p[0] not in (*clocks, *target.tied_ports)]
    outs = [p for p in ports if p[1] == "output" and p[0] not in target.open_ports]
    connections = [(name, name) for name, _, _ in ports if name in clocks]
    connections += [(name, "") for name in target.open_ports]
    connections += [(name, "'0") for name in target.tied_ports]
    for prefix, list_of_ports in (("in_q2", ins), ("out", outs)):
        start = 0
        for name, _, width in list_of_ports:
            connections.append((name, f"{prefix}[{start}+:{width}]"))
            start += width
    n_in, n_out = max(1, sum(p[2] for p in ins)), sum(p[2] for p in outs)
    return f"""module speed_top (input logic clk_i, rst_ni, in_i, load_i, output logic out_o);
  logic [{n_in - 1}:0] in_q, in_q2;
  logic [{n_out - 1}:0] out, out_q, shift_q;
  logic load_q;
  always_ff @(posedge clk_i) begin
    in_q <= {n_in}'({{in_q, in_i}});
    in_q2 <= in_q;
    load_q <= load_i;
    out_q <= out;
    shift_q <= load_q ? out_q : {n_out}'({{shift_q, 1'b0}});
    out_o <= shift_q[{n_out - 1}];
  end
  {instance(target, connections)}
endmodule
"""


def file_name(target):
    return re.sub(r"[^a-z0-9_]+", "_", target.name)


def ecp5_figures(cells):
    lut4, ccu2c = cells.get("LUT4", 0), cells.get("CCU2C", 0)
    return {
        "lut4": lut4,
        "ccu2c": ccu2c,
        "lut4_equivalents": lut4 + 2 * ccu2c,
        "ff": cells.get("TRELLIS_FF", 0),
        "mult18": cells.get("MULT18X18D", 0),
        "bram": cells.get("DP16KD", 0),
    }


def gowin_figures(cells):
    """A carry (ALU) takes the place of a LUT, a RAM16SDP4 those of eight, as nextpnr counts them."""
    luts = sum(cells.get(f"LUT{inputs}", 0) for inputs in (1, 2, 3, 4))
    alus = cells.get("ALU", 0)
    return {
        "lut4": luts,
        "alu": alus,
        "lut4_equivalents": luts + alus + 8 * cells.get("RAM16SDP4", 0),
        "ff": sum(count for name, count in cells.items() if name.startswith("DFF")),
        "mult18": cells.get("MULT18X18", 0),
        "bram": sum(cells.get(name, 0) for name in ("DPB", "DPX9B", "SDPB", "SDPX9B", "SP", "SPX9")),
    }


def cyclone_figures(cells):
    return {
        "cyclone_cells": cells.get("cycloneive_lcell_comb", 0) + cells.get("$not", 0),
        "cyclone_ff": cells.get("dffeas", 0),
    }


def write_tops(tools, name, target, read):
    """NAME_area.sv and NAME_speed.sv."""
    ports = tools.ports(target.module, read, target.parameters)
    for kind, text in (("area", area_top(target, ports)), ("speed", speed_top(target, ports))):
        (tools.folder / f"{name}_{kind}.sv").write_text(text, encoding="utf-8")


def measure(tools, root, design, target, seeds):
    """Figures of one target: a dictionary whose keys are those of docs/synthesis.md's JSON."""
    name = file_name(target)
    read = read_commands(copy_sources(root, design, tools.folder))
    target = of_design(target, tools.folder)
    write_tops(tools, name, target, read)
    area = [*read, f"read_verilog -sv {name}_area.sv"]
    figures = ecp5_figures(tools.synthesize_ecp5(f"{name}_area", "area_top", area))
    figures |= cyclone_figures(tools.synthesize_cyclone(f"{name}_c4e", "area_top", area))
    if seeds:
        figures |= measure_speed(tools, name, read, seeds)
    return figures


def measure_speed(tools, name, read, seeds):
    speed = [*read, f"read_verilog -sv {name}_speed.sv"]
    tools.synthesize_ecp5(f"{name}_speed", "speed_top", speed)
    tools.write_netlist(f"{name}_speed")
    found = by_speed(lambda seed: tools.route(f"{name}_speed", seed), seeds)
    middle = found[(len(found) - 1) // 2][0]
    path = synth_path.describe(middle, tools.folder / f"{name}_speed.json")
    return speeds(found) | {"critical_path": path}


def by_speed(route, seeds):
    """[(report, seed)] of route(seed), the slowest first."""
    with ThreadPoolExecutor(max_workers=2) as pool:
        reports = list(pool.map(route, seeds))
    return sorted(zip(reports, seeds), key=lambda pair: synth_path.fmax(pair[0]))


def speeds(found):
    """Median and range of what by_speed() found."""
    mhz = [round(synth_path.fmax(report), 1) for report, _ in found]
    median = round(statistics.median_low(mhz), 1)
    return {"fmax_mhz": median, "fmax_min_mhz": mhz[0], "fmax_max_mhz": mhz[-1]}
