# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""One SystemVerilog module with a block's name and ports, and any of the block's defects."""

import re
import subprocess

from .patches import NONE, ROOT, DefectError, patched


def split(text):
    """The parts between the commas of the outermost level."""
    parts, depth, start = [], 0, 0
    for at, letter in enumerate(text):
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append(text[start:at])
            start = at + 1
    return [part.strip() for part in [*parts, text[start:]] if part.strip()]


def closing(text, at):
    """Where the parenthesis that opens at `at` closes."""
    depth = 0
    for k in range(at, len(text)):
        depth += (text[k] == "(") - (text[k] == ")")
        if depth == 0:
            return k
    raise DefectError("a parenthesis of the module's head does not close")


def expanded(path):
    """The text of a source whose ports are macros of rtl/tops/device.svh, those of the lever."""
    command = ["verilator", "-E", "-P", f"-I{ROOT / 'rtl/tops'}", str(path)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class Head:
    """Parameters and ports of a module, as its source has them."""

    def __init__(self, name, source):
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", source, flags=re.S)
        found = re.search(rf"\bmodule\s+{name}\s*(#\s*)?\(", text)
        if not found:
            raise DefectError(f"no module {name} with ports in its source")
        end = closing(text, found.end() - 1)
        self.parameters = []
        if found.group(1):
            for part in split(text[found.end() : end]):
                if not part.startswith("localparam"):
                    self.parameters.append(re.search(r"(\w+)\s*=", part).group(1))
            start = text.index("(", end)
            end = closing(text, start)
        else:
            start = found.end() - 1
        self.text = text[found.start() : end + 1] + ";"
        self.ports = []  # (direction, type, name)
        for part in split(text[start + 1 : end]):
            port = re.fullmatch(r"(input|output)\s+(.*?)(\w+)", part, re.S)
            if not port:
                raise DefectError(f"{name}: port '{part}' is not 'direction type name'")
            self.ports.append((port.group(1), " ".join(port.group(2).split()), port.group(3)))
        self.clocked = "clk_i" in [port[2] for port in self.ports]  # else combinational


def modules_of(texts):
    """{module: path} of {path: text}."""
    return {
        name: path
        for path, text in texts.items()
        for name in re.findall(r"^\s*module\s+(\w+)", text, re.M)
    }


def renamed_copy(texts, change, suffix, block):
    """The text of the block with `change`, and of all modules between it and what was changed,
    each under its name and the suffix."""
    where = modules_of(texts)
    texts = {**texts, **change}
    uses = {
        name: {m for m in where if re.search(rf"^\s*{m}\s+(#\s*\(|\w+\s*\()", texts[path], re.M)}
        for name, path in where.items()
    }
    copies = {block} | {name for name, path in where.items() if path in change}
    while True:
        more = {name for name in where if uses[name] & copies} - copies
        if not more:
            break
        copies |= more
    out = []
    for path in sorted({where[name] for name in copies}):
        text = texts[path]
        for name in copies:
            text = re.sub(rf"^(\s*module\s+){name}\b", rf"\g<1>{name}_{suffix}", text, flags=re.M)
            text = re.sub(
                rf"^(\s*){name}(\s+(#\s*\(|\w+\s*\())", rf"\g<1>{name}_{suffix}\2", text, flags=re.M
            )
        out.append(text)
    return "\n".join(out)


def instance(head, block, k, name):
    """One copy: its outputs as wires of its own, a clock only if it is the chosen one."""
    lines = []
    if head.clocked:
        lines += [f"  logic clock_{k};", f"  assign clock_{k} = clk_i && chosen[{k}];"]
    ports = []
    for direction, kind, port in head.ports:
        wire = f"clock_{k}" if port == "clk_i" else port
        if direction == "output":
            wire = f"out_{k}_{port}"
            lines.append(f"  {kind} {wire};")
        ports.append(f".{port}({wire})")
    values = ", ".join(f".{p}({p})" for p in head.parameters)
    parameters = f"#({values}) " if values else ""
    lines.append(f"  {block}_{name} {parameters}u_{name} ({', '.join(ports)});")
    return "\n".join(lines)


def chooser(block, head, names):
    """The module of the block's own name."""
    lines = [
        "`default_nettype none",
        head.text,
        '  import "DPI-C" function int feltgate_chosen_defect(input string names);',
        f"  logic [{len(names) - 1}:0] chosen;",
        f"  initial chosen = {len(names)}'d1 << feltgate_chosen_defect(\"{' '.join(names)}\");",
        *(instance(head, block, k, name) for k, name in enumerate(names)),
    ]
    if head.clocked:
        # Verilator orders the members of its class by what is a clock: clk_i must be one here, too.
        lines.append("  always @(posedge clk_i) if (chosen == 0) $stop;")
    for direction, _, port in head.ports:
        if direction == "output":
            choice = "".join(f"chosen[{k}] ? out_{k}_{port} : " for k in range(1, len(names)))
            lines.append(f"  assign {port} = {choice}out_0_{port};")
    return "\n".join([*lines, "endmodule", "`default_nettype wire", ""])


def block_of_defects(block, patches, sources, root=ROOT):
    """The text of a module that is the block with one of the defects."""
    texts = {path: (root / path).read_text(encoding="utf-8") for path in sources}
    where = modules_of(texts)
    if block not in where:
        raise DefectError(f"no module {block} in {', '.join(map(str, sources))}")
    source = texts[where[block]]
    head = Head(block, expanded(root / where[block]) if "`include" in source else source)
    copies = {NONE: renamed_copy(texts, {}, NONE, block)}
    for patch in sorted(patches):
        change = patched(patch, root)
        for path in change:
            if path not in texts:
                raise DefectError(f"{patch}: changes {path}, which is not part of {block}'s test")
        copies[patch.name] = renamed_copy(texts, change, patch.name, block)
    return chooser(block, head, list(copies)) + "\n".join(copies.values())


def check_same_class(one, other):
    """An object compiled with the one header is linked with the other's library."""
    text = [re.sub(r"#include .*\n", "", path.read_text(encoding="utf-8")) for path in (one, other)]
    if text[0] != text[1]:
        raise DefectError(f"{one} and {other} differ: a port is a clock in one of them alone")
