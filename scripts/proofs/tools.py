# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs Yosys, yosys-smtbmc and z3 for one proof. docs/testing.md

Yosys may be YoWASP's, which sees /tmp as a folder of its own, so every run works inside its folder
with relative names.
"""

import re
import shutil
from dataclasses import dataclass, field
from pathlib import Path

import rtl_sources
import synth_tools
from crew import Crew
from seeded_defects import patches

from . import catalog, trace

TIME_LIMIT_S = 1800
# z3 without --unroll takes minutes where it takes a second with it.
SMTBMC = ("-s", "z3", "--unroll", "--noprogress")

# Below rtl/, in reading order.
PACKAGES = ("generated/{}/cfg.sv", "generated/map.sv", "generated/feltgate_link_pkg.sv",
            "generated/feltgate_engine_pkg.sv", "core/fx.sv")


class Broken(Exception):
    """A tool that is missing or has failed: no verdict on the property."""


@dataclass
class Result:
    """What one run of yosys-smtbmc said."""

    passed: bool
    seconds: float
    failed: list = field(default_factory=list)  # assertions
    step: int = 0  # in which they fail
    reached: dict = field(default_factory=dict)  # cover: step
    unreached: list = field(default_factory=list)
    depth: int = 0  # of an induction that holds
    trace: str = ""


class Tools:
    """Programs on the PATH; the folder is emptied by its owner."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.crew = Crew()
        self.yosys = synth_tools.find("yosys")
        if self.yosys is None:
            raise Broken("no Yosys: run ./feltgate prove, which fetches it, or install yosys")
        # Of the same maker, since one reads what the other writes.
        self.smtbmc = shutil.which(f"{self.yosys}-smtbmc")
        if self.smtbmc is None:
            raise Broken(f"no {self.yosys}-smtbmc beside Yosys; install yosys")
        if shutil.which("z3") is None:
            raise Broken("no z3: run ./feltgate prove, which fetches it, or install z3")

    def versions(self):
        return {
            "yosys": synth_tools.version(self.yosys),
            "z3": synth_tools.version(shutil.which("z3")),
        }


def closure(root, names, cut=()):
    """Modules that these need, in reading order; a cut one needs none."""
    ordered, _ = rtl_sources.modules(root)
    needed, left = set(), list(names)
    while left:
        name = left.pop()
        if name not in needed:
            needed.add(name)
            if name in cut:
                continue
            text = (root / "rtl" / ordered[name]).read_text(encoding="utf-8")
            left += rtl_sources.instantiated(text, ordered.keys())
    return [name for name in ordered if name in needed]


def ports_only(text):
    """A module without what is in it: nothing drives its outputs, so they are free."""
    return text[: text.index("\n);") + 3] + "\nendmodule\n`default_nettype wire\n"


def split_design(text):
    """lever/ROUNDING=2/OBSERVER: design, changed constants of its package, further defines."""
    design, *more = text.split("/")
    return design, [m for m in more if "=" in m], [m for m in more if "=" not in m]


def copy_sources(root, proof, design, patch, folder):
    """Writes what the proof reads into the folder; returns the names, in order."""
    text = catalog.wrapper_text(root, proof.wrapper)
    known = rtl_sources.modules(root)[0]
    wanted = [*rtl_sources.instantiated(text, known.keys()), *proof.sources]
    names = closure(root, wanted, proof.cut)
    strange = [name for name in proof.cut if name not in names]
    if strange:
        raise Broken(f"{proof.key}: cut {', '.join(strange)}, which it does not read")
    design, constants, _ = split_design(design)
    paths = [f"rtl/{known[name]}" for name in names]
    texts = [text, *((root / path).read_text(encoding="utf-8") for path in paths)]
    for package in reversed(PACKAGES):  # those that are named
        path = f"rtl/{package.format(design)}"
        if any(f"{Path(path).stem}::" in named for named in texts):
            paths.insert(0, path)
            texts.append((root / path).read_text(encoding="utf-8"))
    if any('`include "device.svh"' in named for named in texts):
        paths.insert(0, f"rtl/{rtl_sources.INCLUDE}")
    changed = {str(k): v for k, v in patches.patched(patch, root).items()} if patch else {}
    if not changed.keys() <= set(paths):
        raise Broken(f"{patch}: changes {', '.join(changed)}, which {proof.key} does not read")
    for path in paths:
        source = changed.get(path) or (root / path).read_text(encoding="utf-8")
        for constant in constants if f"generated/{design}/" in path else ():
            name, value = constant.split("=")
            source = re.sub(rf"(localparam int {name} = )\d+;", rf"\g<1>{value};", source)
        if Path(path).stem in proof.cut:
            source = ports_only(source)
        (folder / Path(path).name).write_text(source, encoding="utf-8")
    shutil.copy(root / f"rtl/generated/{design}/parameters.mem", folder)  # the core's ParameterFile
    (folder / "proof.sv").write_text(text, encoding="utf-8")
    return [*(Path(path).name for path in paths), "proof.sv"]


def elaborate(tools, root, proof, design, folder, patch=None, alone=None):
    """Writes all.smt2, and PROPERTY.smt2 with that assertion alone: of a patch, and of the one
    named alone."""
    folder.mkdir(parents=True, exist_ok=True)
    names = copy_sources(root, proof, design, patch, folder)
    defines = "".join(f" -D {name}" for name in [*proof.defines, *split_design(design)[2]])
    script = [
        # Of the whole core no module is elaborated with parameters that it does not have there.
        f"read_verilog -sv -formal{' -defer' if proof.cut else ''}{defines} {' '.join(names)}",
        f"prep -top {proof.top} -flatten",
        "select -assert-none w:* a:hierconn %i",  # a name inside that is not there would be free
        *(f"delete {cells}" for cells in proof.abstract),
        "memory_map -formal",
        "chformal -lower" if "yowasp" in Path(tools.yosys).name else "",
        "async2sync",
        "opt -keepdc -fast",
        "dffunmap",
        "setundef -undriven -anyseq",
        "design -save all",
        "write_smt2 -wires all.smt2",
        "delete t:$assert",
        "write_smt2 -wires covers.smt2",
    ]
    outputs = ["all.smt2", "covers.smt2"]
    if patch or alone:
        for entry in proof.properties:
            if entry.name == alone or (patch and entry.defect == patch):
                others = f"t:$assert c:{entry.name} %d"
                rest = f"delete {others}"
                if entry.from_any == "next":
                    rest = (
                        f"chformal -assert -delay 1 {others}; "
                        f"chformal -assert -assert2assume {others}"
                    )
                elif entry.from_any is True:
                    rest = f"chformal -assert -assert2assume {others}"
                script += ["design -load all", rest, f"write_smt2 -wires {entry.name}.smt2"]
                outputs.append(f"{entry.name}.smt2")
    (folder / "elaborate.ys").write_text("\n".join(script) + "\n", encoding="utf-8")
    log = folder / "elaborate.log"
    with log.open("wb") as file:
        done = tools.crew.run(
            [tools.yosys, "-q", "-s", "elaborate.ys"], cwd=folder, stdout=file, stderr=file
        )
    if done.returncode or not all((folder / name).exists() for name in outputs):
        tail = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()[-3:]
        raise Broken("\n".join([f"{proof.key}: Yosys failed; all files: {folder}", *tail]))


def solve(tools, folder, smt2, options, show=()):
    """Runs yosys-smtbmc on SMT2 of the folder."""
    name = f"{Path(smt2).stem}{''.join(o for o in options if o in ('-i', '-c'))}"
    vcd = f"{name}.vcd"
    (folder / vcd).unlink(missing_ok=True)
    log = folder / f"{name}.log"
    command = [
        "timeout",
        str(TIME_LIMIT_S),
        tools.smtbmc,
        *SMTBMC,
        *options,
        "--dump-vcd",
        vcd,
        smt2,
    ]
    with log.open("wb") as file:
        status, seconds = tools.crew.timed(command, cwd=folder, stdout=file, stderr=file)
    text = log.read_text(encoding="utf-8", errors="replace")
    if status == 124:
        raise Broken(f"{folder / smt2}: no verdict within {TIME_LIMIT_S} s")
    if not re.search(r"Status: (PASSED|FAILED)", text):
        tail = text.strip().splitlines()[-3:]
        raise Broken("\n".join([f"yosys-smtbmc failed; all files: {folder}", *tail]))
    result = Result("Status: PASSED" in text, seconds)
    result.failed = list(dict.fromkeys(re.findall(r"Assert failed in \S+ (\S+)", text)))
    steps = [
        int(n) for n in re.findall(r"(?:Checking assertions|Trying induction) in step (\d+)", text)
    ]
    if "-i" in options and result.passed:
        result.depth = int(options[options.index("-t") + 1]) - steps[-1]
    if "-c" in options:
        result.reached = reached_covers(text)
        result.unreached = re.findall(r"Unreached cover statement at (?:\S+: )?(\w+)", text)
    elif not result.passed and (folder / vcd).exists():
        signals = trace.read((folder / vcd).read_text(encoding="utf-8"))
        result.step, result.trace = trace.table(signals, show)
    return result


def reached_covers(text):
    """{cover: step}; two versions of yosys-smtbmc say it in two ways."""
    found = {}
    for line in text.splitlines():
        old = re.search(r"Reached cover statement at (\S+) in step (\d+)", line)
        new = re.search(r"Reached cover statement in step (\d+) at \S+: (\S+)", line)
        if old:
            found[old.group(1)] = int(old.group(2))
        elif new:
            found[new.group(2)] = int(new.group(1))
    return found
