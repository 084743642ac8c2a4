#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The core of a design as one Verilog-2005 file, a board's Quartus project, or a scene as an FMU.

Documentation: docs/other-tools.md, docs/boards/de0_nano.md
"""

import re
import sys
import tempfile
from pathlib import Path

import command_line
import outputs
import product_board
import product_fmu
import rtl_sources
import synth_measure
from synth_tools import Tools, package_of, version

EPILOG = """examples:
  feltgate product verilog                                feltgate.v: design lever
  feltgate product verilog --design paper -o paper.v
  feltgate product board --design my.toml                 folder de0_nano_my: the DE0-Nano's project
  feltgate product fmu --scene wall                       wall.fmu: twin and plant for FMI 3.0

Exit code: 0 written, 2 a design, tool or option cannot be used."""
NOTICE = """// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The device {top} of design {design} in Verilog-2005: written from its SystemVerilog by
// `feltgate product verilog` with {yosys}. Do not edit; a struct is a port of all its bits, the first
// field on top; docs/architecture.md.
"""
# What only Yosys reads.
ATTRIBUTES = (
    "src hdlname top module_not_derived unused_bits full_case parallel_case always_ff dynports"
).split()


def arguments_of(argv):
    parser = command_line.parser("product", __doc__.splitlines()[0], EPILOG)
    parser.add_argument("kind", choices=("verilog", "board", "fmu"), help="what to write")
    what = "a name in rtl/designs, or a file; default lever"
    parser.add_argument("--design", default="lever", help=what)
    what = "of an fmu: a name in vectors/scenes, or a file; default membrane"
    parser.add_argument("--scene", metavar="SCENE", help=what)
    what = "default feltgate.v; of a board a folder, default de0_nano_DESIGN; of an fmu SCENE.fmu"
    command_line.add_path(parser, "-o", "--output", what=what)
    options = parser.parse_args(argv)
    if options.scene and options.kind != "fmu":
        parser.error("--scene is of an fmu; leave it out")
    if options.kind == "board":
        return options
    if options.kind == "fmu":
        options.scene = options.scene or "membrane"
        options.output = options.output or Path(f"{Path(options.scene).stem}.fmu")
        outputs.check(parser, [options.scene], output=options.output)
        return options
    options.output = options.output or Path("feltgate.v")
    outputs.check(parser, [options.design], output=options.output)
    return options


def renamed(text, top):
    """Every module but the core with feltgate_ before its name; variants get numbers."""
    names, counts = {}, {}
    for found in re.findall(r"^module (\S+?)\s*\(", text, re.M):
        word = found.lstrip("\\")
        base = re.search(r"(?:\$paramod(?:\$[0-9a-f]+)?\\)?([a-z]\w*)", word).group(1)
        if base == top:
            names[found] = base
            continue
        counts[base] = counts.get(base, 0) + 1
        number = f"_{counts[base]}" if counts[base] > 1 else ""
        names[found] = f"feltgate_{base}{number}"
    for old, new in names.items():
        # In its own head and where it is instantiated, first in a line; a blank ends an escaped
        # name.
        place = re.compile(rf"^(\s*(?:module )?){re.escape(old)}(?=[\s(])", re.M)
        text = place.sub(lambda match, name=new: match[1] + name, text)
    return text


def verilog(root, options, folder):
    """The text of the file."""
    tools = Tools(folder)
    package = package_of(root, options.design, folder / "design")
    sources = synth_measure.copy_sources(root, package, folder)
    top = rtl_sources.top_of((folder / "cfg.sv").read_text(encoding="utf-8"))
    kept = " ".join(f"-unset {name}" for name in ATTRIBUTES)
    script = [
        *synth_measure.read_commands(sources),
        f"hierarchy -check -top {top}",
        "proc",
        "opt_expr",
        "opt_reduce",  # one enable for a word of a memory, not one for each bit
        "opt_clean",
        # A read of a word being written gives the old one, as in the RTL. That it may be any is
        # told to
        # vendors again afterwards; Yosys would write x for it.
        "select -set loose m:* a:ramstyle %i",
        "setattr -unset no_rw_check -unset ramstyle m:*",
        "memory_dff",  # the registers of a block RAM beside it, as vendors know it
        'setattr -set ramstyle "no_rw_check" @loose',
        "memory_collect",
        f"setattr -mod {kept}",
        f"setattr {kept}",
        "write_verilog core.v",
    ]
    tools.run_yosys("product", script, ["core.v"])
    text = renamed((folder / "core.v").read_text(encoding="utf-8"), top)
    # x for a collision that cannot be, which is no read that a vendor knows.
    text = re.sub(r"\n    if \([^\n]*\)\n      \S+ <= \d+'hx+;", "", text)
    head = NOTICE.format(
        design=Path(options.design).stem,
        top=top,
        yosys=version(tools.yosys),
    )
    return head + text.partition("*/\n")[2]


def run(options):
    """The exit code."""
    root = command_line.root()
    with tempfile.TemporaryDirectory(prefix="feltgate-product-") as folder:
        if options.kind == "board":
            made = product_board.write(root, options.design, options.output, Path(folder))
            print(f"wrote {made}: cd {made}; quartus_sh -t build.tcl", file=sys.stderr)
            return 0
        if options.kind == "fmu":
            outputs.write_whole(options.output, product_fmu.fmu(root, options.design, options.scene))
            print(f"wrote {options.output}", file=sys.stderr)
            return 0
        outputs.write_whole(options.output, verilog(root, options, Path(folder)))
    print(f"wrote {options.output}", file=sys.stderr)
    return 0


def main(argv=None):
    options = arguments_of(argv)
    return command_line.ended("product", lambda: run(options))


if __name__ == "__main__":
    sys.exit(main())
