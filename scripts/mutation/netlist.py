# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""One netlist of a block with all its mutants, of which one is chosen at run time.

Documentation: docs/testing.md

Yosys writes the block as a netlist of word-wide cells and proposes the mutants: one bit of one pin
of one cell inverted, stuck, or changed by another bit of the pin. Every mutant is in the netlist
behind a comparison with `mutsel`. A module with the block's own name and ports contains the
netlist, so the block's test program is linked with it without changes.
"""

import json
import re
import shutil
import subprocess
from pathlib import Path

import rtl_sources
from command_line import Refused
from seeded_defects.block import Head

MODES = {
    "inv": "inverted",
    "const0": "stuck at 0",
    "const1": "stuck at 1",
    "cnot0": "inverted while another bit of the pin is 0",
    "cnot1": "inverted while another bit of the pin is 1",
}
LIMIT_S = 600  # yosys' mutate never ends when nearly all of its database is asked for
MOST_OF_DATABASE = 0.6
# One clock cannot be wrong at one register; a memory is read without clock, enable and reset.
LEFT_OUT = ("CLK", "RD_CLK", "WR_CLK", "RD_EN", "RD_ARST", "RD_SRST", "clk_i")
# Not `memory -nomap`: its ports would read X for a word that is being written.
FLAT = ["flatten", "opt -full", "memory_collect", "opt_clean -purge"]
# Rooms belong to the core; the blocks in them stay modules. With parameters their names are
# $paramod\NAME\... or $paramod$...\NAME; a pattern of Yosys takes no backslash.
ROOMS = " ".join(f"{r} $paramod*?{r} $paramod*?{r}?*" for r in rtl_sources.WIRED_ROOMS)
LAYERED = [
    "setattr -mod -set keep_hierarchy 1 *",
    f"setattr -mod -unset keep_hierarchy {ROOMS}",
    "flatten",
    "setattr -mod -unset keep_hierarchy *",
    "opt -full",
    "opt_clean -purge",
]


class NetlistError(Refused):
    """Yosys is missing or has failed; the message says what to do."""


def yosys():
    found = shutil.which("yosys")
    if found is None:
        raise NetlistError("no yosys on the PATH; install Debian's package yosys")
    return found


def run_yosys(script, name, folder):
    """Runs it in the folder, since not every command takes a path with a blank; its log."""
    path, log = folder / f"{name}.ys", folder / f"{name}.log"
    path.write_text("\n".join(script) + "\n", encoding="utf-8")
    with log.open("wb") as file:
        try:
            done = subprocess.run([yosys(), "-s", path.name], cwd=folder, stdout=file, stderr=file,
                                  stdin=subprocess.DEVNULL, timeout=LIMIT_S, check=False)
        except subprocess.TimeoutExpired as error:
            raise NetlistError(f"yosys did not end within {LIMIT_S} s; log: {log}") from error
    text = log.read_text(encoding="utf-8", errors="replace")
    if done.returncode:
        last = text.strip().splitlines()[-3:]
        raise NetlistError("\n".join([f"yosys failed; the whole log: {log}", *last]))
    return text


def cell_types(rtlil):
    """{cell: (type, what it drives at Q)} of a flat design in RTLIL."""
    found = {}
    for kind, name, body in re.findall(r"^  cell (\S+) (\S+)$(.*?)^  end$", rtlil, re.M | re.S):
        q = re.search(r"^    connect \\Q (.*)$", body, re.M)
        name = name.lstrip("\\")
        child = kind.startswith(("\\", "$paramod"))
        found[name] = name if child else kind, q.group(1).replace("\\", "") if q else ""
    return found


def powered_up(rtlil):
    """(cell, "Q") of registers with a value at power-up, which yosys' mutate loses when it changes
    Q."""
    wires = set(
        re.findall(
            r"attribute \\init [^\n]*\n(?:  attribute [^\n]*\n)*  wire (?:\w+ \S+ )*(\S+)\n", rtlil
        )
    )
    found = set()
    for cell, body in re.findall(r"^  cell \S+ (\S+)$(.*?)^  end$", rtlil, re.M | re.S):
        q = re.search(r"connect \\Q (.*)", body)
        if q and any(word in wires for word in q.group(1).split()):
            found.add((cell.lstrip("\\"), "Q"))
    return found


def parse(line, types):
    """One command of yosys' list, as the fields of a mutant."""
    words = line.split()
    options, sources = {}, []
    for key, value in zip(words[1:], words[2:]):
        if key == "-src":
            sources.append(value)
        elif key.startswith("-") and not re.fullmatch(r"-\d+", key):
            options[key[1:]] = value
    kind, register = types.get(options["cell"], ("?", ""))
    return options | {"type": kind, "register": register, "sources": sources}


def says(mutant):
    """One line for a person."""
    register = mutant["register"] if mutant["port"] not in ("D", "Q") else ""
    wire = f"{mutant['wire']}[{mutant['wirebit']}]" if "wire" in mutant else ""
    of = "".join([f" of {register}" if register else "", f", {wire}" if wire else ""])
    by = f" ({mutant['ctrlbit']})" if "ctrlbit" in mutant else ""
    return f"bit {mutant['portbit']} of {mutant['type']}.{mutant['port']}{of} {MODES[mutant['mode']]}{by}"


def where(mutant):
    """path:line of each place in the source, of yosys' rtl/x.sv:12.3-14.9 the first line."""
    return sorted({re.sub(r"\.\d+-[\d.]+$", "", source) for source in mutant["sources"]})


def command(mutant, top, width):
    """The mutant as a command of yosys: chosen by `mutsel`, of so many bits."""
    by = f" -ctrlbit {mutant['ctrlbit']}" if "ctrlbit" in mutant else ""
    return (f"mutate -ctrl mutsel {width} {mutant['number']} -mode {mutant['mode']} -module {top} "
            f"-cell {mutant['cell']} -port {mutant['port']} -portbit {mutant['portbit']}{by}")


def wrapper(block, source, sources, width):
    """The module of the block's own name: its ports, and which mutant it is."""
    head = Head(block, source)
    ports = ", ".join(f".{port}({port})" for _, _, port in head.ports)
    edges = set(re.findall(r"\bposedge (\w+)", sources)) & {port for _, _, port in head.ports}
    return "\n".join(
        [
            "`default_nettype none",
            head.text,
            '  import "DPI-C" function int feltgate_chosen_mutant();',
            f"  logic [{width - 1}:0] mutsel;",
            f"  initial mutsel = {width}'(feltgate_chosen_mutant());",
            f"  {block}_mutants u_mutants ({ports}, .mutsel(mutsel));",
            # Verilator orders the members of its class by what is a clock: what is one in the block
            # must be one here, too, whatever a mutant does to it.
            *(f"  always @(posedge {port}) if (&mutsel) $stop;" for port in sorted(edges)),
            "endmodule",
            "`default_nettype wire",
            "",
        ]
    )


def chosen(parameter):
    """NAME=VALUE for Yosys, which takes no sign."""
    name, value = parameter.split("=")
    return (
        f"{name} 32'h{int(value) & 0xffffffff:08x}" if value.startswith("-") else f"{name} {value}"
    )


def write(block, sources, parameters, count, seed, output, root, own=False):
    """Writes output (.sv) and, beside it, mutants.json: their numbers, what they change and where."""
    folder = output.parent
    folder.mkdir(parents=True, exist_ok=True)
    # Sources keep the names that they have in the repository.
    link = folder / "rtl"
    link.unlink(missing_ok=True)
    link.symlink_to(root / "rtl")
    changed = "".join(f" -chparam {chosen(p)}" for p in parameters)
    log = run_yosys(
        [
            "read_verilog -sv " + " ".join(f'"{source}"' for source in sources),
            f"hierarchy -top {block}{changed}",
            "proc",
            *(LAYERED if own else FLAT),
            f"rename -top {block}",
            "write_rtlil block.il",
            f"select {block}",
            f"mutate -list 1 -seed {seed} -o one.txt",
        ],
        "read",
        folder,
    )
    database = int(re.search(r"Raw database size: (\d+)", log).group(1))
    # Some pins are left out below; what is asked for makes up for them.
    asked = max(1, min(count * 3 // 2, int(MOST_OF_DATABASE * database)))
    run_yosys(
        [
            "read_rtlil block.il",
            f"select {block}",
            f"mutate -list {asked} -seed {seed} -o proposed.txt",
        ],
        "list",
        folder,
    )
    design = (folder / "block.il").read_text(encoding="utf-8")
    types = cell_types(design)
    started = powered_up(design)
    mutants = [
        parse(line, types)
        for line in (folder / "proposed.txt").read_text(encoding="utf-8").splitlines()
    ]
    mutants = [
        m for m in mutants if m["port"] not in LEFT_OUT and (m["cell"], m["port"]) not in started
    ][:count]
    width = len(mutants).bit_length() + 1  # all bits set is no mutant
    for number, mutant in enumerate(mutants, 1):
        mutant["number"] = number
    run_yosys(
        [
            "read_rtlil block.il",
            *(command(m, block, width) for m in mutants),
            *(FLAT if own else []),
            # Verilator 5.006 loses changes of a word that is driven in parts, some by others of it.
            "opt_clean",
            "splitnets -driver",
            f"rename {block} {block}_mutants",
            "write_verilog -noattr netlist.v",
        ],
        "netlist",
        folder,
    )
    texts = {Path(p).stem: Path(root, p).read_text(encoding="utf-8") for p in sources}
    clocked = "\n".join(texts.values()) if own else texts[block]  # by a child, too
    text = wrapper(block, texts[block], clocked, width)
    netlist = (folder / "netlist.v").read_text(encoding="utf-8")
    if not output.exists() or output.read_text(encoding="utf-8") != text + netlist:
        output.write_text(
            text + netlist, encoding="utf-8"
        )  # else nothing needs to be compiled again
    found = [{"number": m["number"], "what": says(m), "where": where(m)} for m in mutants]
    (folder / "mutants.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
