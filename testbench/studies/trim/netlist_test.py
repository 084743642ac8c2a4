#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""netlist_test.py YOSYS ROOT PACKAGE: Yosys elaborates the core with the package of a design for
the membrane alone, and with lever's. The first has no module that only other scenes need; the
second has them all, or the test would pass on anything. docs/designs.md
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def modules(yosys, root, package):
    """Names of the modules under feltgate_core, without parameters."""
    with tempfile.TemporaryDirectory(prefix="feltgate-netlist-") as name:
        folder = Path(name)
        listed = (root / "rtl/feltgate_core.f").read_text(encoding="utf-8").splitlines()
        sources = [line for line in listed if line and not line.startswith("//")]
        shutil.copy(package, folder / "cfg.sv")
        for source in sources:
            shutil.copy(root / "rtl" / source, folder)
        names = ("cfg.sv", *(Path(source).name for source in sources))
        script = [f"read_verilog -sv {name}" for name in names]
        script += ["hierarchy -check -top feltgate_core", "proc", "tee -q -o modules.txt ls"]
        (folder / "list.ys").write_text("\n".join(script) + "\n", encoding="utf-8")
        subprocess.run([yosys, "-q", "-s", "list.ys"], cwd=folder, check=True)
        text = (folder / "modules.txt").read_text(encoding="utf-8")
    return {re.sub(r"^\$paramod(\$[0-9a-f]+)?\\(\w+).*", r"\2", w) for w in text.split()[2:]}


def main():
    yosys, root, package = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    scenes = {p.stem for p in (root / "rtl/core/scenes").glob("scene_*.sv")}
    least = modules(yosys, root, package)
    whole = modules(yosys, root, root / "rtl/generated/lever/cfg.sv")
    kept = {m for m in least if m.startswith("scene_")}
    errors = []
    if kept != {"scene_membrane"}:
        errors.append(f"the membrane alone has {sorted(kept)}")
    if not scenes <= whole:
        errors.append(f"lever has no {sorted(scenes - whole)}")
    if whole - least != scenes - {"scene_membrane"}:
        errors.append(f"gone are {sorted(whole - least)}")
    print("\n".join(errors) if errors else f"gone: {' '.join(sorted(whole - least))}")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
