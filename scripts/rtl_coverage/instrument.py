#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Changes the output of `verilator --coverage` so that its counts fit a test.

In Verilator's output every model has its own counts, which are lost with the model; a bit "toggles"
when a reset changes its random initial value; and each count is atomic. After the change all models
of a program count together. A toggle counts only while the reset is high, after it has been low.
Verilator's own writer writes the counts when the program ends, to the file that FELTGATE_COVERAGE
names.

  instrument.py DIRECTORY CLASS
"""

import re
import sys
from pathlib import Path

COUNT = re.compile(r"\+\+\(vlSymsp->__Vcoverage\[(\d+)\]\);")
ATOMIC = re.compile(r"(vlSymsp->__Vcoverage\[\d+\])\.fetch_add\(1, std::memory_order_relaxed\);")
POINT = re.compile(r"__vlCoverInsert\(&\(vlSymsp->__Vcoverage\[(\d+)\]\), first, [^;]*?\"v_(\w+)/")
ARRAY = re.compile(r"uint32_t __Vcoverage\[(\d+)\];")
OTHER = re.compile(r"\+\+\(?vlSymsp->__Vcoverage|__Vcoverage\[\d+\]\)?(\+\+|\.fetch_add)")
BORN = "if (VL_UNLIKELY(!vlSymsp->__Vm_didInit)) {"

STATE = """\
static inline uint32_t __Vcoverage[{size}];
    static inline uint32_t coverage_toggles = 0;  // 1 where a toggle counts
    static inline bool coverage_writes = false;
    uint32_t coverage_seen = 0;  // of the reset, or evaluations where there is none
"""
WITH_RESET = """
    if (!this->rst_ni) vlSymsp->coverage_seen = 1;
    vlSymsp->coverage_toggles = this->rst_ni ? vlSymsp->coverage_seen : 0;
"""
WITHOUT_RESET = """
    if (vlSymsp->coverage_seen < 9) ++vlSymsp->coverage_seen;
    vlSymsp->coverage_toggles = vlSymsp->coverage_seen > 8;
"""
# A model made at the end tells the writer what the points are, who then sets all counts to 0.
WRITER = """
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <vector>
static void coverage_write() {{
    const char* const file = std::getenv("FELTGATE_COVERAGE");
    if (file == nullptr) return;
    {name}__Syms::coverage_writes = true;
    const std::vector<uint32_t> counts(std::begin({name}__Syms::__Vcoverage), \
std::end({name}__Syms::__Vcoverage));
    VerilatedContext context;
    {name} model{{&context}};
    std::copy(counts.begin(), counts.end(), {name}__Syms::__Vcoverage);
    context.coveragep()->forcePerInstance(true);
    context.coveragep()->write(file);
}}
"""


class InstrumentError(Exception):
    """Verilator wrote something else than what this expects."""


def once(text, old, new, where):
    if text.count(old) != 1:
        raise InstrumentError(f"{where}: '{old}' is there {text.count(old)} times")
    return text.replace(old, new)


def plain(text):
    """Verilator 5.006 counts in atomic words, later ones in plain ones: all plain."""
    text = ATOMIC.sub(r"++(\1);", text)
    text = text.replace("assert(sizeof(uint32_t) == sizeof(std::atomic<uint32_t>));", "")
    text = text.replace("reinterpret_cast<uint32_t*>(countp)", "countp")
    return text.replace("std::atomic<uint32_t>", "uint32_t")


def changed(files, name):
    """{file: new text} of the generated files."""
    files = {file: plain(text) for file, text in files.items()}
    toggles = {
        int(n) for text in files.values() for n, page in POINT.findall(text) if page == "toggle"
    }
    if not toggles:
        raise InstrumentError(f"{name}: no bit is counted")
    out = {}
    for file, text in files.items():
        text = COUNT.sub(
            lambda m: f"vlSymsp->__Vcoverage[{m[1]}] += "
            + ("vlSymsp->coverage_toggles;" if int(m[1]) in toggles else "1;"),
            text,
        )
        text = text.replace(
            "uint32_t* count32p = countp;",
            "if (!vlSymsp->coverage_writes) return;\n    uint32_t* count32p = countp;",
        )
        text = text.replace("    *count32p = 0;\n", "")
        if file == f"{name}__Syms.h":
            size = ARRAY.search(text)
            if not size:
                raise InstrumentError(f"{file}: no counts")
            text = text.replace(size[0], STATE.format(size=size[1]))
        if file == f"{name}.cpp":
            has_reset = re.search(r"\brst_ni\{", text)
            where = "void " + name + "::eval_step() {"
            text = once(
                text,
                where,
                WRITER.format(name=name) + where + (WITH_RESET if has_reset else WITHOUT_RESET),
                file,
            )
            text = once(
                text,
                BORN,
                BORN
                + "\n        static const bool at_exit = (std::atexit(coverage_write), true);\n"
                "        (void)at_exit;",
                file,
            )
        out[file] = text
    left = [file for file, text in out.items() if ".fetch_add(" in text or OTHER.search(text)]
    if left:
        raise InstrumentError(f"{left[0]}: counts in another way")
    return out


def main(directory, name):
    folder = Path(directory)
    files = {
        path.name: path.read_text(encoding="utf-8")
        for path in folder.glob("*.*")
        if path.suffix in (".h", ".cpp") and path.name != "all.cpp"
    }
    try:
        for file, text in changed(files, name).items():
            (folder / file).write_text(text, encoding="utf-8")
    except InstrumentError as error:
        print(f"instrument.py: {folder}/{error}; made for Verilator 5.006 and 5.032", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
