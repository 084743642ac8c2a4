#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Every flip-flop of the core, and where the Verilated model keeps it: Yosys names the flip-flops,
with all names that each has in the hierarchy, and one of these is a member of the model.

  flop_table.py --root R --design lever --header Vfaults___024root.h --model Vfaults
                --output flops.hpp
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "scripts"))
import rtl_sources  # noqa: E402

TOP = rtl_sources.CORE
MODEL = f"feltgate_core__DOT__gen_{TOP.removesuffix('_top')}__DOT__u_top"  # the device in what is Verilated


def sources(root, design):
    names = [f"generated/{design}/cfg.sv", *rtl_sources.core_files(root)]
    return [root / "rtl" / name for name in names]


def netlist(yosys, files):
    """The core, word by word: flip-flops are still those of the source."""
    with tempfile.TemporaryDirectory() as folder:
        read = "read_verilog -sv " + " ".join(f'"{f}"' for f in files)
        # Not every command of Yosys takes a path with a blank, and YoWASP's sees /tmp as a folder
        # of its own.
        script = (f"{read}; hierarchy -top {TOP}; proc; flatten; opt_expr; opt_clean; "
                  "write_json core.json")
        run = subprocess.run([yosys, "-q", "-p", script], cwd=folder, capture_output=True,
                             text=True, check=False)
        if run.returncode:
            raise SystemExit(f"yosys: {run.stdout}{run.stderr}")
        return json.loads((Path(folder) / "core.json").read_text(encoding="utf-8"))["modules"][TOP]


def names_by_bits(module):
    """{bits of a net: names of it}: the public nets that are just these bits."""
    found = {}
    for name, net in module["netnames"].items():
        if not net.get("hide_name"):
            found.setdefault(tuple(net["bits"]), []).append(name)
    return found


def member(name, members):
    nested = name.replace(".", "__DOT__").replace("[", "__BRA__").replace("]", "__KET__")
    above, block, port = f"{MODEL}__DOT__{nested}".rsplit("__DOT__", 2)
    # The second: an output port that is wired to a field of a struct. The last two: one of the device itself.
    for candidate in (f"{MODEL}__DOT__{nested}", f"{above}__DOT____Vcellout__{block}__{port}",
                      f"feltgate_core__DOT__{nested}", nested):
        if candidate in members:
            return candidate
    return None


def rank(name, bits):
    """A register by its own name, before its block's output, before what that is wired to, a struct of the device last."""
    own, output = re.search(r"_q\d?$", name), name.endswith("_o") and "." in name
    return (not own, not output, name.endswith("_i"), -name.count("."), len(bits), len(name), name)


def in_its_block(name):
    """Without the modules of wires around its block."""
    return re.sub(rf"^(u_({'|'.join(rtl_sources.WIRED_ROOMS)})\.)+(?=u_)", "", name)


def flops(module, members):
    """[(name, member, first bit, width)], and names of flip-flops that the model does not keep."""
    nets = names_by_bits(module)
    whole = {}  # bit: (bits of its net)
    for bits in nets:
        for bit in bits:
            whole.setdefault(bit, []).append(bits)
    found, lost = {}, []
    for cell in module["cells"].values():
        kind = cell["type"]
        if "latch" in kind or ("dff" in kind and kind not in ("$dff", "$adff")):
            raise SystemExit(f"flop_table: what is a {kind}?")
        if kind not in ("$dff", "$adff"):
            continue
        for bit in cell["connections"]["Q"]:
            choices = sorted((rank(n, bits), n, bits) for bits in whole[bit] for n in nets[bits])
            name, bits = in_its_block(choices[0][1]), choices[0][2]
            kept = [(n, bits_of, m) for _, n, bits_of in choices if (m := member(n, members))]
            if not kept:
                lost.append(f"{name}[{bits.index(bit)}]")
                continue
            _, of, where = kept[0]
            found[(name, bits.index(bit))] = (where, of.index(bit))
    return found, lost


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, required=True)
    parser.add_argument("--design", required=True)
    parser.add_argument("--header", type=Path, required=True, help="of the Verilated model")
    parser.add_argument("--model", required=True, help="its class")
    parser.add_argument("--yosys", default="yosys")
    parser.add_argument("--output", type=Path, required=True)
    options = parser.parse_args()
    text = options.header.read_text(encoding="utf-8")
    members = set(re.findall(r"(?:[CSIQ]Data|VlWide<\d+>)(?:/\*[0-9:]+\*/)? (\w+);|"
                             r"VL_(?:IN|OUT)\w*\((\w+),", text))
    members = {name for pair in members for name in pair if name}
    module = netlist(options.yosys, sources(options.root, options.design))
    found, lost = flops(module, members)
    if lost:
        raise SystemExit(f"flop_table: the model has no place for {', '.join(lost)}")
    places = sorted({where for where, _ in found.values()})
    root = f"{options.model}___024root"
    lines = [
        "// Written by testbench/campaigns/faults/flop_table.py.",
        "#pragma once",
        f"#include <{root}.h>",
        "struct Flop {", "  const char* name;", "  int bit;", "  int place, place_bit;", "};",
        "inline constexpr Flop kFlops[] = {",
        *(f'    {{"{name}", {bit}, {places.index(where)}, {at}}},'
          for (name, bit), (where, at) in sorted(found.items())),
        "};",
        f"inline void* flop_place({root}& r, int n) {{", "  switch (n) {",
        *(f"    case {n}: return &r.{where};" for n, where in enumerate(places)),
        "  }", "  return nullptr;", "}", "",
    ]
    options.output.write_text("\n".join(lines), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
