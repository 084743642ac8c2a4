#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws the clocks of each block of the core: docs/images/blocks/BLOCK.svg, from the RTL in Icarus.

  block_clocks.py VCD            writes the drawings
  block_clocks.py VCD --check    status 1 if a drawing is stale

The test icarus.block_clocks makes the VCD: build/testbench/flow/clocks.vcd. For each block the tick in which most of its
ports change is drawn; for blocks with a time of their own, the clocks around an edge of one port.
"""

import argparse
import re
import sys
from pathlib import Path

import rtl_sources
from timing_diagram import svg

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs/images/blocks"
INSTANCE = re.compile(r"^\s*(\w+)\s*(?:#\s*\((?:[^()]|\([^()]*\))*\)\s*)?(u_\w+)\s*\(", re.M)
# Blocks that do not follow the wave: the port whose edge is drawn.
EDGES = {"quad_decoder": "a_i", "pwm": "gate_a_hi_o", "registers": "reg_write_i",
         "absolute_encoder": "sample_i", "current_sense": "valid_o", "current_control": "valid_o",
         "current_check": "missing_o",
         "commutation": "valid_o", "pwm_three_phase": "gate_a_hi_o", "field_oriented": "valid_o"}
BEFORE, AFTER = 3, 40  # clocks around such an edge
LATE = {"current_sense": 15, "current_control": 22, "current_check": 22, "commutation": 88, "pwm_three_phase": 20, "field_oriented": 190}  # clocks before it, of blocks that answer late
BUSES = {"param_i": "param_", "product_i": "product_", "operand_i": "read_"}  # drawn where these strobes are
RESETS = ("clk_i", "rst_ni")


def modules_by_instance(root):
    """{name of an instance: its module} of the core, and of blocks that the testbench has beside it."""
    found = {}
    for path in rtl_sources.core_files(root):
        code = rtl_sources.code_only((root / "rtl" / path).read_text(encoding="utf-8"))
        for module, instance in INSTANCE.findall(code):
            if module not in rtl_sources.NO_BLOCKS:
                found.setdefault(instance, module)
    return {**found, **{f"u_{name}": name for name in rtl_sources.DROP_INS}}


def read_vcd(path, modules):
    """({block: {port: [value in each clock]}}, clocks of wave[0]); of two instances the first."""
    block_of, taken, symbols, scope = {}, set(), {}, []
    clock = wave = None
    lines = iter(path.read_text(encoding="utf-8").splitlines())
    for line in lines:
        words = line.split()
        if line.startswith("$scope"):
            scope.append(words[2])
            block = modules.get(words[2])
            if block and block not in taken:
                taken.add(block)
                block_of["/".join(scope)] = block
        elif line.startswith("$upscope"):
            scope.pop()
        elif line.startswith("$var"):
            name, symbol, width = words[4], words[3], int(words[2])
            block = block_of.get("/".join(scope))
            if scope[-1] == "dut" and name == "clk_i":
                clock = symbol
            if block == "sequencer" and name == "wave_o":
                wave = symbol
            if block and re.search(r"_n?[io]$", name) and name not in RESETS:
                symbols.setdefault(symbol, []).append((block, name, width))
        elif line.startswith("$enddefinitions"):
            break
    ports, now, starts, clocks = {}, {}, [], 0
    for line in lines:
        if line[:1] in "01xz":
            value, symbol = line[0], line[1:]
        elif line[:1] == "b":
            value, symbol = line[1:].split()
        else:
            continue
        if symbol == clock and value == "1":
            # Just before the edge: the values of this clock.
            if wave in now and now[wave].lstrip("0") == "1":
                starts.append(clocks)
            for key, uses in symbols.items():
                for block, name, width in uses:
                    ports.setdefault(block, {}).setdefault((name, width), []).append(now.get(key))
            clocks += 1
        now[symbol] = value
    return ports, starts


def lane(name, width, values, strobes):
    """A WaveDrom lane of the values, or None if they are constant."""
    changes = sum(a != b for a, b in zip(values, values[1:]))
    if not changes:
        return None
    if width == 1:
        shape = (v if v in ("0", "1") else "x" for v in values)
        return {"name": name, "wave": "".join(shape)}
    shape = ""
    for at, value in enumerate(values):
        used = [s for s, seen in strobes.items() if s.startswith(BUSES.get(name, "-")) and seen[at] == "1"]
        new = at == 0 or value != values[at - 1]
        shape += ("5" if used else "x") if name in BUSES else ("7" if at else "=") if new else "."
    return {"name": name, "wave": shape} if shape.strip("x") else None


def is_strobe(name, width):
    return width == 1 and re.match(r"(at|after|param|product|read|division)_?\w*_i$", name)


def order(port, values):
    """Strobes first, by their clocks; then words by their first change."""
    first = next((k for k in range(1, len(values)) if values[k] != values[k - 1]), len(values))
    if is_strobe(*port):
        return 0, values.index("1") if "1" in values else len(values), port[0]
    return 1, first, port[0]


def window(block, ports, starts):
    """(first clock, clock that is numbered 0, last clock + 1)"""
    length = len(next(iter(ports.values())))
    if block in EDGES:
        seen = next(v for (name, _), v in ports.items() if name == EDGES[block])
        before = LATE.get(block, BEFORE)
        edges = [k for k in range(before, length - AFTER) if {seen[k - 1], seen[k]} == {"0", "1"}]
        found = [(k - before, k, k + AFTER) for k in edges]
    else:
        found = [(a, a, b) for a, b in zip(starts, starts[1:])]
    return max(found, key=lambda w: sum(len(set(v[w[0] : w[2]])) > 1 for v in ports.values()), default=None)


def is_event(wave, k):
    """Whether something happens in period k of a lane: an edge, a new word, a word that is used."""
    return wave[k] == "5" or (wave[k] not in ".x" and wave[k] != wave[k - 1])


def drawing(block, ports, starts):
    found = window(block, ports, starts)
    if found is None:
        return None
    first, zero, last = found
    cut = {port: values[first:last] for port, values in ports.items()}
    strobes = {name: v for (name, width), v in cut.items() if is_strobe(name, width)}
    lanes = []
    for side in ("i", "o"):
        for (name, width), values in sorted(cut.items(), key=lambda item: order(*item)):
            if not name.endswith((f"_{side}", f"_n{side}")) or name == "wave_i":  # the clocks themselves
                continue
            one = lane(name, width, values, strobes)
            if one:
                lanes.append(one)
        if side == "i" and lanes:
            lanes.append({})
    drawn = list(filter(None, lanes))
    busy = [k for k in range(1, last - first) if any(is_event(one["wave"], k) for one in drawn)]
    if not busy:
        return None
    low, high = max(0, busy[0] - 1), min(last - first, busy[-1] + 2)
    for one in drawn:
        shape = one["wave"][low].replace(".", "=") + one["wave"][low + 1 : high]
        one["data"] = [""] * sum(c in "=57" for c in shape)
        one["wave"] = re.sub(r"([01x])\1+", lambda same: same[1].ljust(len(same[0]), "."), shape)
    unit = "clocks from the edge" if block in EDGES else "clocks of the wave"
    foot = "green: a new value; blue: the block uses the word on the bus; hatched: it does not"
    return svg({
        "signal": lanes,
        "head": {"text": f"{block}: {unit}", "tock": first + low - zero},
        "foot": {"text": foot},
        "config": {"hscale": 0.5},
    })


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("vcd", type=Path)
    parser.add_argument("--check", action="store_true", help="only compare")
    options = parser.parse_args()
    try:
        ports, starts = read_vcd(options.vcd, modules_by_instance(ROOT))
    except OSError as error:
        print(f"{options.vcd}: {error.strerror}; the test icarus.block_clocks makes it", file=sys.stderr)
        return 2
    drawings = {block: drawing(block, lanes, starts) for block, lanes in ports.items()}
    drawings = {f"{block}.svg": drawn for block, drawn in sorted(drawings.items()) if drawn}
    there = {path.name: path.read_text(encoding="utf-8") for path in IMAGES.glob("*.svg")}
    wrong = []
    if options.check:
        differ = sorted(n for n in {*there, *drawings} if there.get(n) != drawings.get(n))
        wrong = [f"{IMAGES.relative_to(ROOT)}/{n}: stale; scripts/block_clocks.py {options.vcd.resolve()} writes it" for n in differ]
    else:
        IMAGES.mkdir(exist_ok=True)
        for name, drawn in drawings.items():
            (IMAGES / name).write_text(drawn, encoding="utf-8")
        for name in there.keys() - drawings.keys():
            (IMAGES / name).unlink()
    print("\n".join(wrong) or f"{len(drawings)} drawings in {IMAGES.relative_to(ROOT)}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
