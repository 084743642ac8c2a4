# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The files of the RTL, in an order that every tool can read: packages first, then each module
after the modules that it instantiates. scripts/check_blocks.py writes the lists."""

import re

CORE = "lever_top"  # the default device
CORE_FOLDERS = ("core", "safety", "host", "tops")  # what it is made of
CORE_PACKAGES = ("generated/map.sv", "core/fx.sv")  # behind the design's cfg.sv
INCLUDE = "tops/device.svh"  # which device stands in axes, link and boards
# Folders beside the core: the list of all files up to them, and the package that they add.
FOLDERS = {"options": "feltgate_options", "link": "feltgate_linked", "bus": "feltgate_bus",
           "engine": "feltgate_engine", "axes": "feltgate_axes"}
PACKAGES = {"link": "feltgate_link_pkg", "engine": "feltgate_engine_pkg"}
NEEDS = {"axes": "engine", "link": "axes"}  # a folder whose blocks instantiate those of another
# Modules that connect blocks, with little of their own: the core's test is theirs.
WIRED_ROOMS = ("axis", "host", "safety", "quadrature", "h_bridge")
# The options that a device has, by the constants of its package; without one it is the lever.
DEVICES = (
    ("FELTGATE_GIMBAL_CURRENT", {"ABSOLUTE_ENCODER": 1, "PHASES": 3, "CURRENT_LOOP": 1}),
    ("FELTGATE_GIMBAL_MOTOR", {"ABSOLUTE_ENCODER": 1, "PHASES": 3}),
    ("FELTGATE_LEVER_ABSOLUTE", {"ABSOLUTE_ENCODER": 1}),
    ("FELTGATE_HALL_MOTOR", {"PHASES": 3}),
    ("FELTGATE_LEVER_CURRENT", {"CURRENT_LOOP": 1}),
)


def device_of(package):
    """The define by which device.svh chooses the device of a design, of whose package this is the text; "": the lever."""
    def has(option, value):
        return re.search(rf"\bint {option} = {value};", package)

    return next((name for name, options in DEVICES if all(has(*option) for option in options.items())), "")


def device_text(root, package):
    """device.svh with the device of the design, of whose package this is the text."""
    define = device_of(package)
    return (f"`define {define}\n" if define else "") + (root / "rtl" / INCLUDE).read_text(encoding="utf-8")


def top_of(package):
    """The top of rtl/tops of a design, of whose package this is the text."""
    return (device_of(package).removeprefix("FELTGATE_").lower() or "lever") + "_top"


def of_design(names, package):
    """The files of rtl/ in names for a design, of whose package this is the text: by M/T another velocity estimator."""
    if re.search(r"\bint MT_COUNTS = 0;", package):
        return list(names)
    by_mt = ["options/mt/span_meter.sv", "options/mt/velocity_estimator.sv"]
    return [file for name in names for file in (by_mt if name == "core/velocity_estimator.sv" else [name])]


def code_only(text):
    """SystemVerilog without comments."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def instantiated(text, names):
    """Those of the names that the text instantiates, as they appear."""
    found = re.findall(r"\b([a-z]\w*)\s*(?:#\s*\(|\s[a-z]\w*\s*\()", code_only(text))
    return [name for name in dict.fromkeys(found) if name in names]


def measured_as(module):
    """The block whose results, coverage and mutants those of a module's own lines are: of wires the core."""
    return CORE if module in WIRED_ROOMS else module


def room_of(path):
    """The room of a file below rtl/: of core/x.sv core, of link/x.sv link."""
    return path.split("/")[-2]


def tests_of(root, block):
    """testbench/ROOM/BLOCK, or testbench/BLOCK, which is not there, without one."""
    return next(iter(sorted(root.glob(f"testbench/*/{block}"))), root / "testbench" / block)


def module_files(root):
    """{name: path below rtl/} of all modules, those of the core first."""
    rtl = root / "rtl"
    files = [path for folder in (*CORE_FOLDERS, *FOLDERS) for path in sorted(rtl.glob(f"{folder}/*.sv"))]
    names = {p.stem: str(p.relative_to(rtl)) for p in files}
    return {name: path for name, path in names.items() if path not in CORE_PACKAGES}


def modules(root):
    """{name: path below rtl/} of the modules, each after those that it instantiates; those that no top reaches."""
    paths = module_files(root)
    texts = {name: (root / "rtl" / path).read_text(encoding="utf-8") for name, path in paths.items()}
    ordered = {}

    def visit(name, above):
        if name in ordered or name in above:
            return
        for below in instantiated(texts[name], paths.keys() - {name}):
            visit(below, above | {name})
        ordered[name] = paths[name]

    tops = [name for name, path in paths.items() if path.startswith("tops/")]
    for name in (CORE, *tops):
        visit(name, frozenset())
    lost = [name for name, path in paths.items() if path.split("/")[0] in (*CORE_FOLDERS, "options") and name not in ordered]
    for name in paths:
        visit(name, frozenset())
    return ordered, lost


def core_files(root):
    """Files of the default device below rtl/ that are equal in all designs, in order."""
    ordered, _ = modules(root)
    return [*CORE_PACKAGES, *list(ordered.values())[: list(ordered).index(CORE) + 1]]


def folder_files(root, folder):
    """Files below rtl/ that the blocks of a folder add to the core's, in order."""
    of = ("options", "tops") if folder == "options" else (folder,)
    core = core_files(root)
    files = [path for path in modules(root)[0].values() if path.split("/")[0] in of and path not in core]
    package = [f"generated/{PACKAGES[folder]}.sv"] if folder in PACKAGES else []
    needed = folder_files(root, NEEDS[folder]) if folder in NEEDS else []
    return [*needed, *package, *files]
