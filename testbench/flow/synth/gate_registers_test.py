#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The gates in the ECP5 netlists of pwm and pwm_three_phase: flip-flops whose outputs go to the pins and nowhere
else, with one asynchronous clear between them, so that they fit into the I/O cells.
docs/blocks/pwm.md, docs/blocks/pwm.md
"""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ["FELTGATE_ROOT"])


def gates(legs):
    return [f"gate_{leg}_{side}_o" for leg in legs for side in ("hi", "lo")]


def netlist(text, name="pwm"):
    """The module of this source, as Yosys maps it."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / f"{name}.sv"
        source.write_text(text, encoding="utf-8")
        script = f"read_verilog -sv {source}; synth_ecp5 -top {name} -json {folder}/{name}.json"
        subprocess.run(["yosys", "-q", "-p", script], check=True, capture_output=True, text=True)
        return json.loads((Path(folder) / f"{name}.json").read_text())["modules"][name]


def findings(module, legs="ab"):
    drivers, loads = {}, {}
    for cell in module["cells"].values():
        for port, bits in cell["connections"].items():
            for bit in bits:
                if cell["port_directions"][port] == "output":
                    drivers[bit] = cell
                else:
                    loads.setdefault(bit, []).append(port)
    found, clears = [], set()
    for gate in gates(legs):
        bit = module["ports"][gate]["bits"][0]
        cell = drivers.get(bit)
        if cell is None or cell["type"] != "TRELLIS_FF":
            found.append(f"{gate} does not come from a flip-flop")
            continue
        if bit in loads:
            found.append(f"{gate} goes to {loads[bit]} too")
        if cell["parameters"].get("SRMODE") != "ASYNC" or cell["parameters"]["REGSET"] != "RESET":
            found.append(f"{gate} has no asynchronous clear")
        if cell["parameters"]["CEMUX"].strip() != "1":
            found.append(f"{gate} has a clock enable")
        clears.add(tuple(cell["connections"]["LSR"]))
    if len(clears) != 1:
        found.append(f"the gates have {len(clears)} clears")
    return found


class GateRegisters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = (ROOT / "rtl/core/actuation/pwm.sv").read_text(encoding="utf-8")

    def test_they_fit_the_cells(self):
        self.assertEqual(findings(netlist(self.source)), [])
        source = (ROOT / "rtl/core/actuation/pwm_three_phase.sv").read_text(encoding="utf-8")
        self.assertEqual(findings(netlist(source, "pwm_three_phase"), "abc"), [])


if __name__ == "__main__":
    unittest.main()
