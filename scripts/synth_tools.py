# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs Yosys and nextpnr for `feltgate synth`: the recipe only, no tables.

Both tools may be YoWASP's (WebAssembly from PyPI). YoWASP has its own folder /tmp and loses its log
after ABC has run. Therefore every run happens inside one working folder, with relative names, and
results come back in files.
"""

import json
import os
import re
import shutil
import subprocess
from collections import Counter
from pathlib import Path

import command_line
from command_line import Refused
import interrupts

DEVICE = ("--85k", "--package", "CABGA381", "--speed", "6")
GOWIN_PART, GOWIN_FAMILY = "GW1NR-LV9QN88PC6/I5", "GW1N-9C"
TARGET_MHZ = 200


class ToolError(Refused):
    """A tool that is missing or has failed; the message is for the user."""


def find(name):
    """YoWASP's tool in the venv or on PATH, else Debian's; None when there is neither."""
    folders = os.environ.get("PATH", "")
    if "FELTGATE_VENV" in os.environ:
        folders = os.path.join(os.environ["FELTGATE_VENV"], "bin") + os.pathsep + folders
    return shutil.which(f"yowasp-{name}", path=folders) or shutil.which(name, path=folders)


def needed(name, comma=";", otherwise=""):
    """find(), or ToolError."""
    found = find(name)
    if found is None:
        raise ToolError(f"no {name}{comma} run ./feltgate synth, which fetches it{otherwise}")
    return found


def version(tool):
    """First line of a tool's --version, shortened to name and number."""
    if tool is None:
        return "none"
    done = subprocess.run([tool, "--version"], capture_output=True, text=True, check=False)
    text = (done.stdout + done.stderr).strip().splitlines()
    number = re.search(r"\d+\.\d+(\.\d+)*", text[0] if text else "")
    name = Path(tool).name
    return f"{name} {number.group(0)}" if number else name


def require_current(root, *designs):
    """Refused where the file of one of these names in rtl/designs has changed since ./feltgate generate."""
    generator = command_line.build_folder() / "feltgate_generate"
    if not generator.is_file():
        return  # a script by itself, as the build starts one; ./feltgate builds the generator first
    done = interrupts.run([generator, root, "--check", *designs], **interrupts.CAPTURED)
    if done.returncode:
        raise ToolError(done.stderr.strip().splitlines()[-1])


def made_package(root, path, folder):
    """The cfg.sv of a design's file, with its parameters.mem, made in FOLDER."""
    program = os.environ.get("FELTGATE_PROGRAM") or command_line.build_folder() / "feltgate"
    generator = Path(program).with_name("feltgate_generate")
    if not generator.is_file():
        raise ToolError(f"{path.name} needs the built generator: start it by ./feltgate")
    command = [generator, root, "--design", path, "--output", folder]
    done = interrupts.run(command, **interrupts.CAPTURED)
    if done.returncode:
        raise ToolError(done.stderr.strip())
    return folder / "cfg.sv"


def package_file(root, design, folder):
    """The cfg.sv of a design in rtl/designs, beside its parameters.mem: committed, or made in FOLDER."""
    package = root / f"rtl/generated/{design}/cfg.sv"
    return package if package.is_file() else made_package(root, root / f"rtl/designs/{design}.toml", folder)


def package_of(root, design, folder):
    """What synth_measure.copy_sources() takes of a design, a name in rtl/designs or the user's own file:
    the name, or the path of a package made in FOLDER."""
    if (root / f"rtl/designs/{design}.toml").is_file():
        require_current(root, design)
        return design
    path = Path(design)
    if not path.is_file():
        known = ", ".join(sorted(file.stem for file in root.glob("rtl/designs/*.toml")))
        raise ToolError(f"{design} is neither a design ({known}) nor a file; check the path")
    return made_package(root, path, folder)


class Tools:
    """The tools of one run and the folder in which they work."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.yosys = find("yosys")
        self.nextpnr = find("nextpnr-ecp5")
        if self.yosys is None:
            raise ToolError("no Yosys: run ./feltgate synth, which fetches it, or install yosys")

    def is_wasm(self):
        return Path(self.yosys).name.startswith("yowasp")

    def run_yosys(self, name, script, outputs):
        """Runs a script; its log is NAME.log. Fails unless every output was written."""
        (self.folder / f"{name}.ys").write_text("\n".join(script) + "\n", encoding="utf-8")
        self.run([self.yosys, "-s", f"{name}.ys"], name, outputs)

    def run(self, command, name, outputs):
        """The same of any command."""
        for output in outputs:
            (self.folder / output).unlink(missing_ok=True)
        log = self.folder / f"{name}.log"
        with log.open("wb") as file:
            done = interrupts.run(
                command, cwd=self.folder, stdout=file, stderr=subprocess.STDOUT
            )
        missing = [output for output in outputs if not (self.folder / output).exists()]
        if done.returncode or missing:
            tail = log.read_text(encoding="utf-8", errors="replace").splitlines()[-5:]
            raise ToolError("\n".join([f"{command[0]} failed; the whole log: {log}", *tail]))

    def synthesize(self, name, top, script):
        """Cell counts of TOP behind the script; NAME.il is what write_netlist() takes."""
        script = [*script, f"tee -q -o {name}.stat stat -json -top {top}", f"write_rtlil {name}.il"]
        self.run_yosys(name, script, [f"{name}.stat", f"{name}.il"])
        return counted(self.folder / f"{name}.stat")["num_cells_by_type"]

    def synthesize_ecp5(self, name, top, read):
        """Synthesizes TOP; returns its cell counts.

        abc9 maps the LUTs (the only way in current Yosys, an option in 0.23), without the PFU's
        wide multiplexers, which take two LUTs where ABC finds one. opt_merge then removes the
        reset inverters that Yosys 0.23 writes once per flip-flop.
        """
        option = "" if self.is_wasm() else " -abc9"
        script = [
            *read,
            f"synth_ecp5 -top {top} -nowidelut{option} -run begin:check",
            "opt_merge -share_all",
            "opt_clean",
        ]
        return self.synthesize(name, top, script)

    def write_netlist(self, name, *commands):
        """NAME.il as NAME.json, for nextpnr. A run of its own: see above on ABC and the log."""
        script = [f"read_rtlil {name}.il", *commands, "autoname", "blackbox =A:whitebox"]
        self.run_yosys(f"{name}_json", [*script, f"write_json {name}.json"], [f"{name}.json"])

    def write_simulation(self, top, read, models, family="ecp5"):
        """TOP's netlist as netlist.v, module TOP_netlist, with the models of its cells."""
        if family == "gowin":
            self.synthesize_gowin("mapped", top, read)
        else:
            self.synthesize_ecp5("mapped", top, read)
        script = ["read_rtlil mapped.il", "blackbox =A:whitebox", f"rename {top} {top}_netlist"]
        if family == "gowin":  # names of the mapping, a hundred letters long
            script += [f"rename -hide {top}_netlist/*"]
        script += [f"select {top}_netlist", "write_verilog -noattr -selected mapped.v"]
        self.run_yosys("mapped_v", script, ["mapped.v"])
        cells = "lattice/cells_sim_ecp5.v" if self.is_wasm() else "ecp5/cells_sim.v"
        if family == "gowin":
            cells = "gowin/cells_sim.v"
        script = [f"read_verilog +/{cells}", *(f"read_verilog -overwrite -sv {m}" for m in models)]
        script += ["read_verilog mapped.v", f"hierarchy -check -top {top}_netlist", "proc"]
        script += ["flatten", "opt -fast", "opt_clean -purge", "write_verilog -noattr netlist.v"]
        self.run_yosys("netlist", script, ["netlist.v"])

    def place(self, command, name, seed, *endings):
        """Places and routes NAME.json by a nextpnr; its report, and NAME_SEED.ENDING of each is there."""
        outputs = [f"{name}_{seed}.{ending}" for ending in ("report", *endings)]
        words = ["--timing-allow-fail", "--seed", str(seed), "-q"]
        words += ["--json", f"{name}.json", "--report", outputs[0]]
        self.run([*command, *words], f"{name}_{seed}", outputs)
        return json.loads((self.folder / outputs[0]).read_text(encoding="utf-8"))

    def route(self, name, seed):
        """For an ECP5, without pins."""
        words = (*DEVICE, "--freq", str(TARGET_MHZ), "--lpf-allow-unconstrained")
        return self.place([self.nextpnr, *words], name, seed)

    def route_board(self, name, seed, constraints):
        """With a board's pins."""
        words = ("--lpf", constraints, "--textcfg", f"{name}_{seed}.config")
        return self.place([self.nextpnr, *DEVICE, *words], name, seed, "config")

    def pack(self, name):
        """NAME.config as NAME.bit, what the FPGA loads."""
        command = [needed("ecppack"), "--compress", f"{name}.config", f"{name}.bit"]
        self.run(command, f"{name}_pack", [f"{name}.bit"])
        return self.folder / f"{name}.bit"

    def synthesize_gowin(self, name, top, read):
        """Synthesizes TOP for the GW1NR-9C; returns its cell counts."""
        flow = f"synth_gowin -top {top} -family gw1n -nowidelut -run begin:check"
        return self.synthesize(name, top, [*read, flow])

    def route_gowin(self, name, seed, constraints, mhz):
        """As route_board(), for the GW1NR-9C; NAME_SEED.json is what pack_gowin() takes."""
        command = [needed("nextpnr-himbaechel-gowin", ":", ", or --no-route"), "--device", GOWIN_PART]
        command += ["--vopt", f"family={GOWIN_FAMILY}", "--vopt", f"cst={constraints}"]
        command += ["--freq", f"{mhz:g}", "--write", f"{name}_{seed}.json"]
        return self.place(command, name, seed, "json")

    def pack_gowin(self, name):
        """NAME.json as NAME.fs, what the FPGA loads."""
        command = [needed("gowin_pack"), "-d", GOWIN_FAMILY, "-o", f"{name}.fs", f"{name}.json"]
        self.run(command, f"{name}_pack", [f"{name}.fs"])
        return self.folder / f"{name}.fs"

    def ports(self, top, read, parameters=()):
        """(name, direction, width) of every port of TOP, with those of the PARAMETERS that are numbers."""
        name = f"{top}_ports"
        # Not by hierarchy -chparam: Yosys 0.70 gives a module with arrays at its parts a second name, and stops.
        values = [f"chparam -set {n} {v} {top}" for n, v in dict(parameters).items() if v.isdigit()]
        script = [*read, *values, f"hierarchy -top {top}", "proc", f"write_json {name}.json"]
        self.run_yosys(name, script, [f"{name}.json"])
        modules = json.loads((self.folder / f"{name}.json").read_text(encoding="utf-8"))["modules"]
        found = next(m for m in modules.values() if int(m["attributes"].get("top", "0"), 2))
        return [(n, p["direction"], len(p["bits"])) for n, p in found["ports"].items()]

    def memory_bits(self, name, top, read):
        """Bits of the memories of TOP before they are mapped."""
        stat = f"{name}_memory.stat"
        script = [*read, f"hierarchy -top {top}", "proc", "flatten", "opt_clean", "memory_dff"]
        script += ["opt_clean", f"tee -q -o {stat} stat -json -top {top}"]
        self.run_yosys(f"{name}_memory", script, [stat])
        return counted(self.folder / stat)["num_memory_bits"]

    def synthesize_cyclone(self, name, top, read):
        """Cell counts for Cyclone IV E: not fitted, 18 x 18 products as black boxes."""
        script = [
            "read_verilog -lib cyclone_cells.v",
            *read,
            f"hierarchy -check -top {top}",
            "proc",
            "flatten",
            "opt",
            "wreduce",
            "techmap -map +/mul2dsp.v -D DSP_A_MAXWIDTH=18 -D DSP_B_MAXWIDTH=18 "
            "-D DSP_A_MINWIDTH=5 -D DSP_B_MINWIDTH=5 -D DSP_NAME=$__MUL18X18",
            "techmap -map cyclone_mult.v",
            "delete t:$meminit t:$meminit_v2",  # Yosys' map of M9K has no place for contents
            "opt_clean",
            f"synth_intel -family cycloneive -top {top} -run begin:vqm",
            "opt_clean",
        ]
        (self.folder / "cyclone_mult.v").write_text(CYCLONE_MULT, encoding="utf-8")
        (self.folder / "cyclone_cells.v").write_text(CYCLONE_CELLS, encoding="utf-8")
        return self.synthesize(name, top, script)


def drivers_of(cells):
    """{bit: name of the cell that drives it}."""
    return {bit: name for name, cell in cells.items() for port, bits in cell["connections"].items()
            if cell["port_directions"][port] == "output" for bit in bits}


def feeds(module):
    """How many flip-flops have a LUT that is free for them, a carry, or neither before them."""
    drivers, found, taken = drivers_of(module["cells"]), Counter(), set()
    for cell in module["cells"].values():
        if cell["type"].startswith("DFF"):
            before = drivers.get(cell["connections"]["D"][0])
            kind = module["cells"][before]["type"][:3] if before else ""
            kind = kind if kind == "ALU" or kind == "LUT" and before not in taken else "none"
            taken.add(before)
            found[kind] += 1
    return found


# mul2dsp writes $__MUL18X18. The cell is counted only, so it needs no contents.
CYCLONE_CELLS = """(* blackbox *)
module cycloneive_mult18 (input [17:0] A, input [17:0] B, output [35:0] Y);
endmodule
"""
CYCLONE_MULT = """module \\$__MUL18X18 (input [17:0] A, input [17:0] B, output [35:0] Y);
  parameter A_WIDTH = 18, B_WIDTH = 18, Y_WIDTH = 36, A_SIGNED = 0, B_SIGNED = 0;
  cycloneive_mult18 _TECHMAP_REPLACE_ (.A(A), .B(B), .Y(Y));
endmodule
"""


def counted(path):
    """What Yosys' stat -json has of the whole."""
    text = path.read_text(encoding="utf-8")
    found = json.loads(text[text.index("{") :])
    return found.get("design") or next(iter(found["modules"].values()))
