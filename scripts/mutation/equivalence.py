# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Is a mutant the same circuit? yosys joins both into one circuit whose output shows a difference.
yosys-abc proves that there is never a difference (scorr, pdr), or finds inputs that give one.

All inputs, also the reset, are free in every clock; registers start at 0, or at their value at
power-up. A memory is cut out: its read data are an input of both circuits, and its address, data
and enable are compared. A buffer replaces each of its pins and is changed as the pin would be.
"""

import re
import shutil
import subprocess
import threading

from . import netlist

EQUIVALENT, DIFFERENT, UNKNOWN = "equivalent", "different", "unknown"
MEMORY_INPUTS = {"RD_DATA": ("RD_PORTS", "WIDTH")}
MEMORY_OUTPUTS = {
    "RD_ADDR": ("RD_PORTS", "ABITS"),
    "WR_ADDR": ("WR_PORTS", "ABITS"),
    "WR_DATA": ("WR_PORTS", "WIDTH"),
    "WR_EN": ("WR_PORTS", "WIDTH"),
}


def buffer_of(cell, pin):
    """The cell that stands in place of a memory's pin."""
    return "\\" + cell.lstrip("\\") + "." + pin


def at_buffers(mutant):
    """The mutant where memories are cut out."""
    if mutant["type"] != "$mem_v2":
        return mutant
    pin = mutant["port"]
    port = "Y" if pin in MEMORY_INPUTS else "A"
    return mutant | {"cell": buffer_of(mutant["cell"], pin), "type": "$pos", "port": port}


def check_clocks(cell, body):
    """Clocks and enables of its ports are cut away uncompared: they must be none, or the clock."""
    reads, writes = (
        re.search(rf"parameter \\{port}_CLK_ENABLE \d+'(\d*)", body).group(1)
        for port in ("RD", "WR")
    )
    clocks = re.search(r"connect \\WR_CLK (.*)", body).group(1)
    if re.search(r"parameter \\WR_PORTS 0\n", body):  # a table, as Yosys makes one of a case
        writes = ""
    if "1" in reads or "0" in writes or set(re.findall(r"[\\$]\S+", clocks)) - {"\\clk_i"}:
        raise netlist.NetlistError(
            f"memory {cell.lstrip(chr(92))}: the proof wants reads without a clock and writes with "
            "clk_i; write it so, or take --proof-seconds 0"
        )


def without_memories(rtlil):
    """The design with ports in place of the pins of its memories, and a buffer between."""
    last_port = max(int(n) for n in re.findall(r"^  wire .*?(?:input|output) (\d+) ", rtlil, re.M))
    numbers = {
        cell: n for n, cell in enumerate(sorted(re.findall(r"^  cell \$mem_v2 (\S+)", rtlil, re.M)), 1)
    }

    def ports(found):
        nonlocal last_port
        cell, body = found.groups()
        count = numbers[cell]
        size = {k: int(v) for k, v in re.findall(r"parameter \\(\w+) (\d+)\n", body)}
        check_clocks(cell, body)
        lines = []
        for pins, direction in ((MEMORY_INPUTS, "input"), (MEMORY_OUTPUTS, "output")):
            for pin, (ports, width) in pins.items():
                signal = re.search(rf"connect \\{pin} (.*)\n", body)
                if not size[ports]:
                    continue
                last_port += 1
                name = rf"\memory_{count}_{pin}"
                total = size[ports] * size[width]
                ends = (name, signal.group(1))
                lines += [
                    f"  wire width {total} {direction} {last_port} {name}",
                    f"  cell $pos {buffer_of(cell, pin)}",
                    "    parameter \\A_SIGNED 0",
                    f"    parameter \\A_WIDTH {total}",
                    f"    parameter \\Y_WIDTH {total}",
                    f"    connect \\A {ends[direction == 'output']}",
                    f"    connect \\Y {ends[direction == 'input']}",
                    "  end",
                ]
        return "\n".join([*lines, ""])

    return re.sub(r"^  cell \$mem_v2 (\S+)(.*?)^  end\n", ports, rtlil, flags=re.M | re.S)


def commands(block, mutants, width):
    """Any of the mutants, chosen by mutsel."""
    return [
        netlist.command(m, block, f"-ctrl mutsel {width} {k}") for k, m in enumerate(mutants, 1)
    ]


def join_script(block, width):
    """Both in one design, the second one with mutants."""
    return [
        "read_rtlil gold.il",
        f"rename {block} gold",
        f"add -input mutsel {width} gold",
        "read_rtlil gate.il",
        f"rename {block} gate",
        "miter -equiv -flatten gold gate joined",
        "hierarchy -top joined",
        "opt_merge -share_all",  # what no mutant reaches is there once
        "async2sync",
        "opt -fast",
        "techmap",
        "setundef -zero -init",
        "setundef -zero",
        "opt -fast",
        "dfflegalize -cell $_DFF_P_ 01",
        "aigmap",
        "opt_clean",
        "write_blif joined.blif",
    ]


class Joined:
    """The block beside itself with any of these mutants; the folder has its block.il."""

    def __init__(self, folder, block, mutants, work, crew, own=False):
        self.work, self.crew = work, crew
        self.numbers = {m["number"]: k for k, m in enumerate(mutants, 1)}
        self.width = max(1, len(mutants).bit_length())
        work.mkdir(parents=True, exist_ok=True)
        text = (folder / "block.il").read_text(encoding="utf-8")
        # Of a block with its children whole, mutants come first and memories are cut out of both.
        layers = netlist.FLAT if own else []
        if not own:
            text = without_memories(text)
            mutants = [at_buffers(m) for m in mutants]
        (work / "design.il").write_text(text, encoding="utf-8")
        changed = {"gold": [], "gate": commands(block, mutants, self.width)}
        for name, change in changed.items():
            script = ["read_rtlil design.il", *change, *layers, f"write_rtlil {name}.il"]
            netlist.run_yosys(script, name, work, crew)
            if own:
                flat = work / f"{name}.il"
                flat.write_text(
                    without_memories(flat.read_text(encoding="utf-8")), encoding="utf-8"
                )
        netlist.run_yosys(join_script(block, self.width), "join", work, crew)
        self.blif = (work / "joined.blif").read_text(encoding="utf-8")
        self.abc = shutil.which("yosys-abc")
        if self.abc is None:
            raise netlist.NetlistError("no yosys-abc on the PATH; install Debian's package yosys")

    def prove(self, mutant, seconds):
        """(verdict, what was said, seconds of CPU time)"""
        number = self.numbers[mutant["number"]]
        bits = [f"in_mutsel[{k}]" if self.width > 1 else "in_mutsel" for k in range(self.width)]
        inputs, rest = self.blif.split(".outputs", 1)
        for k, bit in enumerate(bits):
            inputs = re.sub(rf"(?<=\s){re.escape(bit)}(?=\s)", "", inputs)
            value = "1\n" if number >> k & 1 else ""
            rest = rest.replace("\n.names", f"\n.names {bit}\n{value}.names", 1)
        name = f"{mutant['number']}.blif"
        (self.work / name).write_text(inputs + ".outputs" + rest, encoding="utf-8")
        # yosys-abc 0.23 dies in some bmc3, so that comes last, by itself.
        total = 0.0
        for script in (f"scorr; dc2; scorr -F 2; pdr -T {seconds}", f"bmc3 -F 20 -T {seconds}"):
            said, spent = self.run(f"read_blif {name}; strash; {script}", 10 * seconds + 60)
            total += spent
            found = re.search(r"asserted in frame (\d+)", said)
            if found:
                return DIFFERENT, f"differs in clock {found.group(1)}", total
            if "Property proved" in said:
                return EQUIVALENT, "Property proved", total
        return UNKNOWN, f"no verdict in {seconds} s", total

    def run(self, script, limit_s):
        """(output, seconds of CPU time) of yosys-abc."""
        log = self.work / f"{threading.get_ident()}.log"
        with log.open("wb") as file:
            _, seconds = self.crew.timed(
                [self.abc, "-c", script],
                limit_s,
                cwd=self.work,
                stdout=file,
                stderr=file,
                stdin=subprocess.DEVNULL,
            )
        return log.read_text(encoding="utf-8", errors="replace"), seconds

    def example(self, mutant):
        """Inputs in the clocks up to the one in which it differs, changes only."""
        name = f"{mutant['number']}.blif"
        self.run(f"read_blif {name}; strash; bmc3 -F 60 -T 60; write_cex -n example.txt", 120)
        found = self.work / "example.txt"
        if not found.exists():
            return "no example"
        values = {}
        for signal, bit, clock, value in re.findall(
            r"in_(\S+?)(?:\[(\d+)\])?@(\d+)=(\d)", found.read_text(encoding="utf-8")
        ):
            key = int(clock), signal
            values[key] = values.get(key, 0) | int(value) << int(bit or 0)
        lines, last = ["inputs that show it, from a state of 0 (memory_N_RD_DATA: any word):"], {}
        for clock in range(max((key[0] for key in values), default=-1) + 1):
            now = {
                signal: value
                for (c, signal), value in values.items()
                if c == clock and signal != "clk_i"
            }
            changed = [f"{s}={v:#x}" for s, v in sorted(now.items()) if last.get(s, 0) != v]
            lines.append(f"  clock {clock}: {' '.join(changed) or 'as before'}")
            last |= now
        return "\n".join(lines)
