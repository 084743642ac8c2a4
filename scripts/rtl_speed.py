#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Clocks per second of the Verilated core against those of another version, in one run.

OLD and NEW are folders with an rtl/ of this project, or revisions of this repository. Both cores are
built with the flags of the product into one program and run in turn on the same stimulus. The
place where the linker puts their code changes either speed by up to two times. Therefore the program
is linked several times, each time with the object files in another order and at other addresses. The
script prints the median over the links and both ends. If valgrind is installed, it also prints the
machine instructions per clock, which do not depend on the position of the code.
Documentation: docs/speed-for-accuracy.md

  scripts/rtl_speed.py 318dd1b                     this tree against a revision
  scripts/rtl_speed.py ../other . --links 16       two folders
"""

import argparse
import os
import random
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import command_line

ROOT = Path(__file__).resolve().parents[1]
DRIVER = ROOT / "testbench/studies/bench/rtl_speed.cpp"
DEFINES = ["-DVM_COVERAGE=0", "-DVM_SC=0", "-DVM_TRACE=1", "-DVM_TRACE_FST=1", "-DVM_TRACE_VCD=0"]
RUNTIME = ("verilated", "verilated_threads", "verilated_fst_c")
# What feltgate_verilate() in scripts/cmake/verilate.cmake says.
VERILATE = ["--cc", "--trace-fst", "-O3", "--x-initial", "unique", "--x-assign", "unique"]
PAD_BYTES = 1 << 16  # between two objects at most: more than the code of a core has of cache


class SpeedError(command_line.Refused):
    """What cannot be built or run, with what the tool said."""


def call(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise SpeedError(f"{command[0]} failed\n{done.stdout}{done.stderr}".rstrip())
    return done.stdout


def flags():
    """Those of the product's own cores."""
    text = (ROOT / "scripts/cmake/verilate.cmake").read_text(encoding="utf-8")
    return re.search(r"set\(FELTGATE_FASTEST_RTL ([^)]*)\)", text)[1].split()


def rtl_of(version, work):
    """The rtl folder of a checkout or a revision."""
    folder = Path(version) / "rtl"
    if (folder / "feltgate_core.f").exists():
        return folder.resolve()
    packed = subprocess.run(
        ["git", "-C", ROOT, "archive", version, "rtl"], capture_output=True, check=False
    )
    if packed.returncode != 0:
        raise SpeedError(f"{version} is neither a folder with rtl/feltgate_core.f nor a revision here")
    target = work / f"rtl.{len(list(work.glob('rtl.*')))}"
    target.mkdir()
    subprocess.run(["tar", "-x", "-C", target], input=packed.stdout, check=True)
    return target / "rtl"


def compile_core(name, rtl, design, work, include):
    """The object of the core in `rtl`, of Verilator's class `name`."""
    package = rtl / f"generated/{design}/feltgate_pkg.sv"
    if not package.exists():
        raise SpeedError(f"{rtl} has no design {design}")
    lines = (rtl / "feltgate_core.f").read_text(encoding="utf-8").splitlines()
    listed = [line for line in lines if line and not line.startswith("/")]
    folder = work / name
    command = ["verilator", *VERILATE, "--prefix", name, "--top-module", "feltgate_core"]
    command += ["-Wno-fatal", "-Wno-lint", "-Wno-style", "--output-split", "0", "--Mdir", folder]
    call([*command, package, *(rtl / line for line in listed)])
    joined = "".join(f'#include "{path.name}"\n' for path in sorted(folder.glob("*.cpp")))
    (folder / "all.cpp").write_text(joined, encoding="utf-8")
    made = work / f"{name}.o"
    call(["g++", "-std=c++17", "-w", *flags(), *include, *DEFINES, "-c", folder / "all.cpp", "-o", made])
    return made


def compile_all(versions, design, work):
    root = Path(re.search(r"VERILATOR_ROOT\s*= (.*)", call(["verilator", "-V"]))[1].strip())
    include = [f"-I{root}/include", f"-I{root}/include/vltstd"]
    plain = ["g++", "-std=c++17", "-w", "-O2", *include, *DEFINES, "-c"]
    jobs = []
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for name, version in zip(("VA", "VB"), versions):
            rtl = rtl_of(version, work)
            jobs.append(pool.submit(compile_core, name, rtl, design, work, include))
        for name in RUNTIME:
            pool.submit(call, [*plain, root / f"include/{name}.cpp", "-o", work / f"{name}.o"]).result()
        cores = [job.result() for job in jobs]
    driver = work / "driver.o"
    call([*plain, f"-I{work}/VA", f"-I{work}/VB", DRIVER, "-o", driver])
    return [*cores, driver, *(work / f"{name}.o" for name in RUNTIME)]


def link(objects, work, seed):
    """The program with its objects in an order and at distances of `seed`'s."""
    draw = random.Random(seed)
    order = list(objects)
    draw.shuffle(order)
    placed = []
    for place, item in enumerate(order):
        pad = work / f"pad{place}.s"
        text = f'.text\n.skip {draw.randrange(PAD_BYTES)}, 0x90\n.section .note.GNU-stack,"",@progbits\n'
        pad.write_text(text, encoding="utf-8")
        placed += [pad, item]
    program = work / "rtl_speed"
    call(["g++", *placed, "-lz", "-lpthread", "-latomic", "-o", program])
    return program


def run(program, clocks, rounds):
    """Pairs of ns per clock, and the line that ends them."""
    *pairs, end = call([program, str(clocks), str(rounds)]).splitlines()
    return [tuple(float(v) for v in pair.split()) for pair in pairs], end.split()


def instructions(program, name, clocks=20000):
    """Machine instructions per clock of one core, by the difference of a long and a short run."""
    counts = []
    for n in (1000, 1000 + clocks):
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
        command += [f"--toggle-collect={name}::eval_step()", program, str(n), "1"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        found = re.search(r"Collected : (\d+)", done.stderr)
        if found is None:
            return None
        counts.append(int(found[1]))
    return (counts[1] - counts[0]) / clocks


def spread(values):
    return f"{statistics.median(values):.3g} ({min(values):.3g} .. {max(values):.3g})"


def measure(options, work):
    objects = compile_all((options.old, options.new), options.design, work)
    old, new, ratios, equal = [], [], [], True
    for seed in range(options.links):
        program = link(objects, work, seed)
        pairs, (hash_a, hash_b, armed, _) = run(program, options.clocks, options.rounds)
        equal = equal and hash_a == hash_b
        old.append(1e3 / statistics.median(a for a, _ in pairs))
        new.append(1e3 / statistics.median(b for _, b in pairs))
        ratios.append(statistics.median(a / b for a, b in pairs))
        if options.verbose:
            print(f"link {seed}: {old[-1]:.3g} {new[-1]:.3g} ratio {ratios[-1]:.3g}", flush=True)
        if armed == "0":
            raise SpeedError("the core was never armed: the stimulus does not fit it")
    print(f"design {options.design}, {options.links} links, million clocks per second:")
    print(f"  {options.old}: {spread(old)}")
    print(f"  {options.new}: {spread(new)}")
    print(f"times as fast: {spread(ratios)}")
    if shutil.which("valgrind"):
        counted = [instructions(program, name) for name in ("VA", "VB")]
        if all(counted):
            print(f"instructions per clock: {counted[0]:.0f} and {counted[1]:.0f}")
    print(f"snapshots are {'equal in every bit' if equal else 'DIFFERENT'}")


def main():
    parser = argparse.ArgumentParser(
        allow_abbrev=False,
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("old", metavar="OLD", help="folder or revision")
    parser.add_argument("new", metavar="NEW", nargs="?", default=str(ROOT), help="default: this tree")
    parser.add_argument("--design", default="lever", help="default: lever")
    add = command_line
    add.add_number(parser, "--links", 8, "programs linked", least=1)
    add.add_number(parser, "--clocks", 1000000, "of each core in a round", least=1)
    add.add_number(parser, "--rounds", 5, "of each program", least=1)
    add.add_flags(parser, verbose="a line for each link")
    options = parser.parse_args()

    def work():
        with tempfile.TemporaryDirectory(prefix="rtl_speed.") as folder:
            measure(options, Path(folder))

    return command_line.ended("rtl_speed", work)


if __name__ == "__main__":
    sys.exit(main())
