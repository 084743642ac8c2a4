# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""`feltgate product board`: the Quartus project of a board in one folder, with the RTL and one design.

Documentation: docs/boards/de0_nano.md
"""

import os
import re
import shutil
from pathlib import Path

import outputs
import rtl_sources
from synth_tools import ToolError, package_file, package_of

BOARD = "de0_nano"
CLOCK_HZ = 50_000_000
MARK = "design.txt"
SOURCE = re.compile(r"^(set_global_assignment -name SYSTEMVERILOG_FILE )(\S+)$", re.M)


def constant(text, name):
    return int(re.search(rf"\b{name} = (\d+);", text).group(1))


def design_files(root, design, folder):
    """The package and the parameters of one design, made together."""
    package = package_of(root, design, folder)
    if not isinstance(package, Path):
        package = package_file(root, package, folder)
    return package, package.with_name("parameters.mem")


def prepare(output):
    """An empty folder, or one that this has written before."""
    if output.exists() and not output.is_dir():
        raise ToolError(f"{output} is a file; give another folder with -o")
    if output.is_dir() and any(output.iterdir()) and not (output / MARK).is_file():
        raise ToolError(f"{output} is there and not from here; give another folder with -o")
    output.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(output / "rtl", ignore_errors=True)
    (output / "rtl").mkdir()


def write(root, design, output, temporary):
    """Writes the project; the path of its folder."""
    name = Path(design).stem
    output = output or Path(f"{BOARD}_{name}")
    package, parameters = design_files(root, design, temporary)
    text = package.read_text(encoding="utf-8")
    hz = constant(text, "CLOCK_HZ")
    if hz != CLOCK_HZ:
        raise ToolError(
            f"{design}: the board's clock is 50 MHz, the design wants {hz / 1e6:g}; set clock_hz = 50_000_000"
        )
    prepare(output)
    board = root / "rtl/boards" / BOARD
    settings = (board / f"{BOARD}.qsf").read_text(encoding="utf-8")
    copied = {}

    def moved(found):
        source = Path(os.path.normpath(board / found[2]))
        sources = [package]
        if source.name != "cfg.sv":
            files = rtl_sources.of_design([str(source.relative_to(root / "rtl"))], text)
            sources = [root / "rtl" / file for file in files]
        for source in sources:
            if source.name in copied:
                raise ToolError(f"{BOARD}.qsf: two files {source.name}; rename one")
            copied[source.name] = source
        return "\n".join(f"{found[1]}rtl/{source.name}" for source in sources)

    settings = SOURCE.sub(moved, settings).replace("SEARCH_PATH ../../tops", "SEARCH_PATH rtl")
    if "cfg.sv" not in copied:
        raise ToolError(f"{BOARD}.qsf has no cfg.sv among its sources; put it back")
    for source in [*copied.values(), parameters]:
        shutil.copyfile(source, output / "rtl" / source.name)
    device = output / "rtl" / Path(rtl_sources.INCLUDE).name
    outputs.write_whole(device, rtl_sources.device_text(root, text))
    settings += (
        "\n# Where Quartus stops at the first values of the parameters, take them from the file, which is of the\n"
        "# same design as rtl/cfg.sv; never mix two folders:\n"
        '# set_parameter -name ParameterFile "rtl/parameters.mem"\n'
    )
    outputs.write_whole(output / f"{BOARD}.qsf", settings)
    for path in (f"{BOARD}.qpf", f"{BOARD}.sdc", "build.tcl"):
        shutil.copyfile(board / path, output / path)
    crc = re.search(r"DESIGN_CRC = 32'h(\w+);", text)
    words = f"design {name}" + (f", design_crc 0x{crc.group(1)}" if crc else "")
    outputs.write_whole(output / MARK, f"{words}; written by feltgate product board\n")
    return output
