#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""netlist_test.py YOSYS ROOT PACKAGE: Yosys elaborates the chip with the package of a design for the membrane
alone, and with lever's. The first has no divider, which only a charge needs, and at most half the cells in its scene; no
other block is gone. docs/designs.md
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def modules(yosys, root, package):
    """{module under lever_top, without parameters: its cells}."""
    listed = (root / "rtl/feltgate_core.f").read_text(encoding="utf-8").splitlines()
    files = [package, *(root / "rtl" / line for line in listed if line and not line.startswith("//"))]
    with tempfile.TemporaryDirectory(prefix="feltgate-netlist-") as folder:
        script = [f'read_verilog -sv "{file}"' for file in files]
        script += ["prep -top lever_top", "write_json cells.json"]
        Path(folder, "list.ys").write_text("\n".join(script) + "\n", encoding="utf-8")
        subprocess.run([yosys, "-q", "-s", "list.ys"], cwd=folder, check=True)
        found = json.loads(Path(folder, "cells.json").read_text(encoding="utf-8"))["modules"]
    names = {name: re.sub(r"^\$paramod(\$[0-9a-f]+)?\\(\w+).*", r"\2", name) for name in found}
    return {names[name]: len(module["cells"]) for name, module in found.items()}


def main():
    yosys, root, package = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    least = modules(yosys, root, package)
    whole = modules(yosys, root, root / "rtl/generated/lever/cfg.sv")
    errors = []
    if whole.keys() - least.keys() != {"divider"}:
        errors.append(f"gone are {sorted(whole.keys() - least.keys())}, not the divider")
    if least["scene"] * 2 > whole["scene"]:
        errors.append(f"the scene has {least['scene']} cells of {whole['scene']}")
    print("\n".join(errors) if errors else f"scene: {least['scene']} cells of {whole['scene']}; no divider")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
