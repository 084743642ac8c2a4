#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Seeded defects: patches beside their tests, applied to copies of the product. docs/testing.md

  defects.py copy PATCH --output DIR      the patched files, at their paths below DIR
  defects.py block NAME --patches P... --sources S... --output FILE
      one SystemVerilog file: a module of the block's name and ports that holds a copy of the block
      for each patch. The one that FELTGATE_DEFECT names has a clock and drives the outputs; `none`
      is a copy without a defect.
  defects.py same-class A.h B.h --output FILE
      writes FILE when Verilator gave both classes the same members in the same order, so that what
      was compiled with the one may be linked with the other

A patch that does not apply, changes no code or has no first line that says what it breaks is refused.
"""

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
NONE = "none"


class DefectError(Exception):
    """The message names the patch and what to change."""


def code_only(text):
    """Source without comments and white space, which no defect is made of."""
    return re.sub(r"//[^\n]*|/\*.*?\*/|\s+", " ", text, flags=re.S).split()


def summary(patch):
    """The first line of a patch: what it breaks."""
    line = patch.read_text(encoding="utf-8").partition("\n")[0].strip()
    if not line or re.match(r"(---|\+\+\+|@@|diff|index|Index)", line):
        raise DefectError(f"{patch}: its first line does not say what it breaks; write it there")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", patch.stem) or patch.stem == NONE:
        raise DefectError(f"{patch}: its name is no word like missing_carry; rename it")
    return line


def touched(patch):
    """Paths of the files that a patch changes, relative to the repository."""
    text = patch.read_text(encoding="utf-8")
    paths = [Path(path) for path in re.findall(r"^\+\+\+ b/(\S+)", text, re.M)]
    if not paths:
        raise DefectError(f"{patch}: changes no file; make it with git diff")
    return paths


def patched(patch, root=ROOT):
    """{path: text} of the files that a patch changes, as they are with it."""
    summary(patch)
    before, after = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for path in touched(patch):
            if not (root / path).is_file():
                raise DefectError(f"{patch}: changes {path}, which is not there")
            before[path] = (root / path).read_text(encoding="utf-8")
            Path(folder, path).parent.mkdir(parents=True, exist_ok=True)
            Path(folder, path).write_text(before[path], encoding="utf-8")
        command = ["patch", "-p1", "--fuzz=0", "--batch", "--forward", "--reject-file=-"]
        command += ["--no-backup-if-mismatch", "-d", folder, "-i", patch.resolve()]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise DefectError(f"{patch}: does not apply; make it again\n{done.stdout}{done.stderr}")
        for path in before:
            after[path] = Path(folder, path).read_text(encoding="utf-8")
            if code_only(after[path]) == code_only(before[path]):
                raise DefectError(f"{patch}: changes no code of {path}")
    return after


def write_copies(patch, output, root=ROOT):
    """Writes the patched files below `output`; returns their paths there."""
    paths = []
    for path, text in patched(patch, root).items():
        (output / path).parent.mkdir(parents=True, exist_ok=True)
        (output / path).write_text(text, encoding="utf-8")
        paths.append(output / path)
    return paths


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
        if "clk_i" not in [port[2] for port in self.ports]:
            raise DefectError(f"{name}: no port clk_i")


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
    lines = [f"  logic clock_{k};", f"  assign clock_{k} = clk_i && chosen[{k}];"]
    ports = []
    for direction, kind, port in head.ports:
        if direction == "output":
            lines.append(f"  {kind} out_{k}_{port};")
        own = "clock" if port == "clk_i" else f"out_{k}_{port}"
        wire = f"clock_{k}" if own == "clock" else own if direction == "output" else port
        ports.append(f".{port}({wire})")
    values = ", ".join(f".{p}({p})" for p in head.parameters)
    lines.append(f"  {block}_{name} {f'#({values}) ' if values else ''}u_{name} ({', '.join(ports)});")
    return "\n".join(lines)


def chooser(block, head, names):
    """The module of the block's own name."""
    lines = [
        "`default_nettype none",
        head.text,
        '  import "DPI-C" function int feltgate_chosen_defect(input string names);',
        f"  logic [{len(names) - 1}:0] chosen;",
        f"  initial chosen = {len(names)}'d1 << feltgate_chosen_defect(\"{' '.join(names)}\");",
        # Verilator orders the members of its class by what is a clock: clk_i must be one here, too.
        "  always @(posedge clk_i) if (chosen == 0) $stop;",
        *(instance(head, block, k, name) for k, name in enumerate(names)),
    ]
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
    head = Head(block, texts[where[block]])
    copies = {NONE: renamed_copy(texts, {}, NONE, block)}
    for patch in sorted(patches):
        change = patched(patch, root)
        for path in change:
            if path not in texts:
                raise DefectError(f"{patch}: changes {path}, which is not part of {block}'s test")
        copies[patch.stem] = renamed_copy(texts, change, patch.stem, block)
    return chooser(block, head, list(copies)) + "\n".join(copies.values())


def check_same_class(one, other):
    """An object compiled with the one header is linked with the other's library."""
    text = [re.sub(r"#include .*\n", "", path.read_text(encoding="utf-8")) for path in (one, other)]
    if text[0] != text[1]:
        raise DefectError(f"{one} and {other} differ: a port is a clock in one of them alone")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    verbs = parser.add_subparsers(dest="verb", required=True)
    copy = verbs.add_parser("copy", help="patched copies of the files that a patch changes")
    copy.add_argument("patch", type=Path)
    block = verbs.add_parser("block", help="a module that holds a copy of the block for each patch")
    block.add_argument("name")
    block.add_argument("--patches", type=Path, nargs="+", required=True)
    block.add_argument("--sources", type=Path, nargs="+", required=True, help="block and children")
    same = verbs.add_parser("same-class", help="are two Verilated classes laid out alike?")
    same.add_argument("headers", type=Path, nargs=2)
    for verb in (copy, block, same):
        verb.add_argument("--output", type=Path, required=True)
        verb.add_argument("--root", type=Path, default=ROOT)
    options = parser.parse_args()
    try:
        root = options.root.resolve()
        if options.verb == "copy":
            write_copies(options.patch, options.output, root)
        elif options.verb == "same-class":
            check_same_class(*options.headers)
            options.output.write_text("", encoding="utf-8")
        else:
            sources = [path.resolve().relative_to(root) for path in options.sources]
            text = block_of_defects(options.name, options.patches, sources, root)
            options.output.parent.mkdir(parents=True, exist_ok=True)
            options.output.write_text(text, encoding="utf-8")
    except (DefectError, OSError) as error:
        print(f"defects: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
