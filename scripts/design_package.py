# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The package of a design, given by a name in rtl/designs or by the user's own file."""

import os
from pathlib import Path

import interrupts
from synth_tools import ToolError


def package_of(root, design, folder):
    """What synth_measure.copy_sources() takes: a name, or the path of a package made in FOLDER."""
    if (root / f"rtl/generated/{design}/feltgate_pkg.sv").is_file():
        return design
    path = Path(design)
    if not path.is_file():
        packages = root.glob("rtl/generated/*/feltgate_pkg.sv")
        known = ", ".join(sorted(package.parent.name for package in packages))
        raise ToolError(f"{design} is neither a design ({known}) nor a file; check the path")
    if "FELTGATE_PROGRAM" not in os.environ:
        raise ToolError("your own design needs the built generator: start it by ./feltgate")
    generator = Path(os.environ["FELTGATE_PROGRAM"]).with_name("feltgate_generate")
    command = [generator, root, "--design", path, "--output", folder]
    done = interrupts.run(command, **interrupts.CAPTURED)
    if done.returncode:
        raise ToolError(done.stderr.strip())
    return folder / "feltgate_pkg.sv"
