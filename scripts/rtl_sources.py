# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The files of the RTL, in an order that every tool can read: packages first, then each module
after the modules that it instantiates. scripts/check_blocks.py writes the lists."""

import re

CORE = "feltgate_core"
CELL_WRAPPERS = ("mult18_ecp5",)  # one cell of one vendor: no other vendor's source
# Folders of blocks beside the core: the list of all files up to them, and the package that they add.
FOLDERS = {"link": "feltgate_linked", "bus": "feltgate_bus", "engine": "feltgate_engine", "axes": "feltgate_axes"}
PACKAGES = {"link": "feltgate_link_pkg", "engine": "feltgate_engine_pkg"}
NEEDS = {"axes": "engine", "link": "axes"}  # a folder whose blocks instantiate those of another
BESIDE = ("safety", "host", "options", "tops")  # the core's own folders beside rtl/core
# Rooms of the core below rtl/core, in the order of the data; the tests have the same: testbench/ROOM/BLOCK.
ROOMS = ("encoder", "estimators", "scenes", "actuation", "safety", "wave")
# Modules that connect blocks, with little of their own: rooms, of which scenes is a block itself, and a part of actuation.
WIRED_ROOMS = (*(room for room in ROOMS if room != "scenes"), "current_loop")
# Without a twin and a test of their own: one is elaborated, never clocked; a room is tested by the core's test.
NO_BLOCKS = ("feltgate_checks", *WIRED_ROOMS)
# Blocks that the core has only in some designs.
DROP_INS = ("absolute_encoder", "current_sense", "current_control", "current_check", "commutation", "pwm_three_phase",
            "field_oriented")


def code_only(text):
    """SystemVerilog without comments."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def instantiated(text, names):
    """Those of the names that the text instantiates, as they appear."""
    found = re.findall(r"\b([a-z]\w*)\s*(?:#\s*\(|\s[a-z]\w*\s*\()", code_only(text))
    return [name for name in dict.fromkeys(found) if name in names]


def measured_as(module):
    """The block whose results, coverage and mutants those of a module's own lines are: of a room the core."""
    return CORE if module in WIRED_ROOMS else module


def room_of(path):
    """The room of a file below rtl/: of core/scenes/x.sv scenes, of core/x.sv core, of link/x.sv link."""
    return path.split("/")[-2]


def tests_of(root, block):
    """testbench/ROOM/BLOCK, or testbench/BLOCK, which is not there, without one."""
    return next(iter(sorted(root.glob(f"testbench/*/{block}"))), root / "testbench" / block)


def module_files(root):
    """{name: path below rtl/} of the core's modules, by rooms, and of those of FOLDERS."""
    rtl = root / "rtl"
    rooms = sorted({p.parent.name for p in rtl.glob("core/*/*.sv")} - set(ROOMS))  # not in the order yet
    folders = [*(f"core/{room}" for room in (*ROOMS, *rooms)), "core", *BESIDE, *FOLDERS]
    files = [path for folder in folders for path in sorted(rtl.glob(f"{folder}/*.sv"))]
    return {p.stem: str(p.relative_to(rtl)) for p in files if p.stem not in CELL_WRAPPERS}


def modules(root):
    """{name: path below rtl/} of the modules in order, and those of the core's that it does not reach."""
    paths = module_files(root)
    texts = {name: (root / "rtl" / path).read_text(encoding="utf-8") for name, path in paths.items()}
    ordered = {}

    def visit(name, above):
        if name in ordered or name in above:
            return
        for below in instantiated(texts[name], paths.keys() - {name}):
            visit(below, above | {name})
        ordered[name] = paths[name]

    if CORE in paths:
        visit(CORE, frozenset())
    reached = set(ordered)
    for name in paths:
        visit(name, frozenset())
    lost = [name for name, path in paths.items()
            if CORE in paths and name not in {*reached, *DROP_INS} and path.startswith("core/")]
    return ordered, lost


def core_files(root):
    """Files of the core below rtl/ that are equal in all designs, in order."""
    beside = {f"{package}.sv" for package in PACKAGES.values()}
    packages = sorted(path.name for path in root.glob("rtl/generated/*_pkg.sv"))
    listed = [f"generated/{name}" for name in packages if name not in beside]
    return [*listed, *(path for path in modules(root)[0].values() if path.startswith("core/"))]


def folder_files(root, folder):
    """Files below rtl/ that the blocks of a folder add to the core's, in order."""
    files = [path for path in modules(root)[0].values() if path.startswith(f"{folder}/")]
    package = [f"generated/{PACKAGES[folder]}.sv"] if folder in PACKAGES else []
    needed = folder_files(root, NEEDS[folder]) if folder in NEEDS else []
    return [*needed, *package, *files] if files else []


def cell_files(root):
    """Files below rtl/ that a vendor's cells need beside them."""
    rtl = root / "rtl"
    found = [path for name in CELL_WRAPPERS for path in rtl.glob(f"core/*/{name}.sv")]
    return [str(path.relative_to(rtl)) for path in found]
