# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Evaluates one design point: its RTL against its twin, its error, its area, its speed.

RTL and program depend only on the structure. They are built once per structure and kept in the
working folder; the values in registers are set at run time. Documentation: docs/speed-for-accuracy.md
"""

import fcntl
import hashlib
import json
import os
import re
import shutil
import sys
import tempfile
import tomllib
from pathlib import Path

import command_line
import interrupts
import outputs
import rtl_sources
import synth_measure
import synth_tools
from exploration.design_text import design_text

ROOT = Path(os.environ.get("FELTGATE_ROOT", Path(__file__).resolve().parents[2]))
BUILD = Path(os.environ.get("FELTGATE_BUILD", ROOT / "build"))
SEEDS = (1, 2, 3)
LIBRARIES = ("explore", "chain", "plant_files", "plant", "config", "verilated")
OPTIMISE = "-O1"  # measured: -O2 costs as much compiling as it saves running
BOUNDED = ("torque_nm", "tau_ref_nm", "tau_hat_nm", "velocity_rad_s")


class PointError(Exception):
    """A point that could not be evaluated; the message is for the user."""


def run(command, **options):
    done = interrupts.run(command, **interrupts.CAPTURED, **options)
    if done.returncode:
        said = (done.stdout + done.stderr).strip().splitlines()
        raise PointError("\n".join([f"{command[0]} failed", *said[-12:]]))
    return done.stdout


def generate(design, folder):
    """(coarse, refusal): whether only --allow-coarse lets it pass, and why nothing does."""
    command = [BUILD / "feltgate_generate", ROOT, "--design", design, "--output", folder]
    for extra in ([], ["--allow-coarse"]):
        done = interrupts.run([*command, *extra], **interrupts.CAPTURED)
        if done.returncode == 0:
            return bool(extra), None
    if done.returncode != 2 or not done.stderr.startswith(str(design)):
        raise PointError(f"feltgate_generate failed: {done.stderr.strip()}")
    return False, done.stderr.strip().removeprefix(str(design)).lstrip(":0123456789 ")


def tool_version(command):
    return run([command, "--version"]).splitlines()[0]


def compiler():
    return os.environ.get("CXX", "g++")


def yosys():
    """Debian's where there is one: five times faster than the one from PyPI."""
    return shutil.which("yosys") or synth_tools.find("yosys")


_sources = None


def sources_digest():
    """Of the RTL, the headers and the tools: what every structure is built from."""
    global _sources
    if _sources is None:
        digest = hashlib.sha256(f"{OPTIMISE} {tool_version(compiler())}".encode())
        digest.update(f"{tool_version('verilator')} {synth_tools.version(yosys())}".encode())
        paths = [*core_rtl(), *ROOT.glob("model/**/*.hpp")]
        paths += [ROOT / "model/studies/explore/point_main.cpp", Path(__file__)]
        paths += [BUILD / f"libfeltgate_{name}.a" for name in LIBRARIES]
        paths = [p for p in paths if "generated" not in p.parts]
        paths += [ROOT / "rtl/generated/map.sv"]
        paths += [ROOT / "model/include/feltgate/generated" / name for name in ("map.hpp", "causes.hpp")]
        for path in sorted(paths):
            digest.update(path.read_bytes())
        _sources = digest.hexdigest()
    return _sources


def structure_key(package):
    """What RTL and program depend on: the package without the values that registers carry."""
    text = re.sub(
        r"function automatic logic \[31:0\] parameter_reset.*?endfunction", "", package, flags=re.S
    )
    # Nor on the number by which a host knows those values: the core has no use for it.
    text = re.sub(r"^(//|.*\bDESIGN_CRC\b).*$", "", text, flags=re.M)
    return hashlib.sha256(f"{sources_digest()} {text}".encode()).hexdigest()[:16]


def core_rtl():
    """The devices, and the module with a port for each pin that C++ sees of them."""
    names = [*rtl_sources.core_files(ROOT), *rtl_sources.folder_files(ROOT, "options")]
    return [*(ROOT / "rtl" / name for name in names), ROOT / "model/sim/backends/feltgate_core.sv"]


def verilator_root():
    root = run(["verilator", "--getenv", "VERILATOR_ROOT"]).strip()
    return Path(root or "/usr/share/verilator")


def build_program(generated, folder):
    """Verilates the core and compiles the program of the structure; it is FOLDER/point."""
    rtl = folder / "rtl"
    command = ["verilator", "--cc", "--prefix", "Vpoint", "--top-module", "feltgate_core"]
    command += ["--Mdir", rtl, "-O3", "--x-initial", "unique", "--x-assign", "unique"]
    command += ["--output-split", "0", "-Wno-fatal"]
    run([*command, generated / "cfg.sv", *core_rtl()])
    joined = rtl / "all.cpp"
    names = sorted(p.name for p in rtl.glob("*.cpp"))
    joined.write_text("".join(f'#include "{name}"\n' for name in names), encoding="utf-8")
    include = verilator_root() / "include"
    flags = ["-std=c++17", OPTIMISE, "-w", "-I", rtl, "-isystem", include]
    flags += ["-isystem", include / "vltstd", "-I", ROOT / "model", "-I", ROOT / "model/include"]
    flags += ["-I", generated, '-DPOINT_HEADER="point.hpp"', "-DPOINT_TYPE=Point"]
    flags += [
        "-DVM_COVERAGE=0",
        "-DVM_SC=0",
        "-DVM_TRACE=1",
        "-DVM_TRACE_FST=1",
        "-DVM_TRACE_VCD=0",
    ]
    objects = []
    for source in (joined, ROOT / "model/studies/explore/point_main.cpp"):
        objects.append(folder / f"{source.stem}.o")
        run([compiler(), *flags, "-c", source, "-o", objects[-1]])
    libraries = [BUILD / f"libfeltgate_{name}.a" for name in LIBRARIES]
    libraries += ["-lfmt", "-lz", "-pthread"]
    run([compiler(), *objects, *libraries, "-o", folder / "point"])


def tools_in(folder):
    tools = synth_tools.Tools(folder)
    tools.yosys = yosys()
    return tools


def synthesis_inputs(generated, folder, tools):
    """Copies the sources, writes the wrappers; commands that read the sources."""
    names = rtl_sources.core_files(ROOT)
    shutil.copy(generated / "cfg.sv", folder)
    for name in names:
        shutil.copy(ROOT / "rtl" / name, folder)
    target = synth_measure.scene_target(ROOT)
    names = ["cfg.sv", *(Path(name).name for name in names)]
    read = synth_measure.read_commands(names)
    synth_measure.write_tops(tools, "core", target, read)
    return read


def synthesize(generated, folder):
    """Cells of the core without read-back, for an ECP5, by Yosys."""
    tools = tools_in(folder)
    read = synthesis_inputs(generated, folder, tools)
    read += ["read_verilog -sv core_area.sv"]
    return synth_measure.ecp5_figures(tools.synthesize_ecp5("core_area", "area_top", read))


def place_and_route(generated, folder):
    """Fmax of the seeds, MHz."""
    tools = tools_in(folder)
    if tools.nextpnr is None:
        raise PointError("no nextpnr-ecp5: run ./feltgate synth once, which fetches it")
    read = synthesis_inputs(generated, folder, tools)
    figures = synth_measure.measure_speed(tools, "core", read, SEEDS)
    del figures["critical_path"]
    return figures


class Structure:
    """The folder of one structure; parts are made by whoever comes first, others wait."""

    def __init__(self, workdir, generated):
        package = (generated / "cfg.sv").read_text(encoding="utf-8")
        self.generated = generated
        self.key = structure_key(package)
        self.folder = Path(workdir) / "structures" / self.key
        self.folder.mkdir(parents=True, exist_ok=True)

    def part(self, name, make):
        """The file NAME of the structure, which make(temporary folder) leaves there or returns."""
        path = self.folder / name
        with (self.folder / f".{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not path.exists():
                with tempfile.TemporaryDirectory(prefix=".build-", dir=self.folder) as temporary:
                    made = Path(temporary) / name
                    result = make(Path(temporary))
                    if result is not None:
                        made.write_text(json.dumps(result), encoding="utf-8")
                    made.replace(path)
        return path

    def program(self):
        return self.part("point", lambda f: build_program(self.generated, f))

    def area(self):
        path = self.part("area.json", lambda f: synthesize(self.generated, f))
        return json.loads(path.read_text(encoding="utf-8"))

    def speed(self):
        path = self.part("speed.json", lambda f: place_and_route(self.generated, f))
        return json.loads(path.read_text(encoding="utf-8"))


def measured(result, name):
    """The measured error that bound_NAME bounds."""
    signal, unit = re.fullmatch(r"(.*?)_(nm|rad_s)", name).groups()
    return result[f"{signal}_error_max_{unit}"]


def bounds(design, result):
    """The proven bounds of a design file at the speeds of `result`, and whether its errors keep them."""
    # A margin for the core's own factor, which may be the larger one.
    speed = 1.01 * result["raw_velocity_max_rad_s"]
    found = json.loads(run([BUILD / "feltgate_point_bounds", ROOT, design, str(speed)]))
    if not found["bound_without"]:
        kept = (measured(result, name) <= found[f"bound_{name}"] for name in BOUNDED)
        found["bound_holds"] = all(kept)
    return found


def evaluate_design(text, workdir, route=False, area=True):
    """What is measured at the design of a TOML text; docs/speed-for-accuracy.md has the keys."""
    Path(workdir).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".point-", dir=workdir) as temporary:
        folder = Path(temporary)
        design = folder / "point.toml"
        design.write_text(text, encoding="utf-8")
        coarse, refusal = generate(design, folder)
        if refusal is not None:
            return {"status": "refused", "reason": refusal}
        structure = Structure(workdir, folder)
        command = [structure.program(), folder / "values.txt", ROOT / "vectors/plants/linear.toml"]
        done = interrupts.run(command, **interrupts.CAPTURED)
        if done.returncode not in (0, 1) or not done.stdout:
            raise PointError(f"structure {structure.key}: {done.stderr.strip()}")
        result = json.loads(done.stdout) | {"coarse": coarse, "structure": structure.key}
        if result["status"] == "ok":
            result |= bounds(design, result)
            if area:
                result |= structure.area()
            if route:
                result |= structure.speed()
        return result


def evaluate(point, workdir, route=False):
    """What is measured at {"base": NAME, "set": {"section.key": value}}."""
    return evaluate_design(design_text(ROOT, point), workdir, route)


SCHEMA = "feltgate-point/1"
HELP = """\
Evaluates one design point: builds its RTL, compares it with its twin bit for bit, measures its
error against the exact design, its delays, and its area on an ECP5.

  feltgate explore point rtl/designs/lever.toml
  feltgate explore point my.toml --route --json my.json    also places and routes it, three seeds

A design that is coarser than one for use may be is measured too and says so. Exit code: 0
measured, 1 RTL and twin differ or the design is refused, 2 wrong use."""


def report(result):
    rows = [f"  {key:28} {value}" for key, value in result.items() if not isinstance(value, dict)]
    return "\n".join(rows)


def main(words):
    parser = command_line.parser("explore point", HELP)
    parser.add_argument("design", metavar="FILE", help="a design file")
    parser.add_argument("--route", action="store_true", help="also Fmax, median of three seeds")
    parser.add_argument("--json", metavar="FILE", help="write the figures here")
    parser.add_argument("--work", metavar="DIR", default=str(BUILD / "explore"), help="kept builds")
    arguments = parser.parse_args(words)
    outputs.check(parser, json=arguments.json)
    try:
        text = Path(arguments.design).read_text(encoding="utf-8")
        tomllib.loads(text)
        result = evaluate_design(text, arguments.work, arguments.route)
    except (OSError, tomllib.TOMLDecodeError) as error:
        print(f"{arguments.design}: {error}; name a design file", file=sys.stderr)
        return 2
    except (PointError, synth_tools.ToolError) as error:
        print(error, file=sys.stderr)
        return 2
    if arguments.json:
        told = {"schema": SCHEMA} | result
        outputs.write_whole(arguments.json, json.dumps(told, indent=1) + "\n")
    print(report(result), file=sys.stderr if arguments.json == outputs.STDOUT else sys.stdout)
    return 0 if result["status"] == "ok" else 1
