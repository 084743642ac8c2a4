#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The gates in the ECP5 netlists of pwm and pwm_three_phase: flip-flops whose outputs go to the pins and nowhere
else, with one asynchronous clear between them, so that they fit into the I/O cells.
docs/blocks/pwm.md
"""

import json
import unittest

from testing import ROOT, Scratch, ran


def gates(legs):
    return [f"gate_{leg}_{side}_o" for leg in legs for side in ("hi", "lo")]


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


class GateRegisters(Scratch):
    def test_they_fit_the_cells(self):
        for folder, name, legs in (("core", "pwm", "ab"), ("options", "pwm_three_phase", "abc")):
            source = ROOT / f"rtl/{folder}/{name}.sv"
            made = self.folder / f"{name}.json"
            script = f"read_verilog -sv {source}; synth_ecp5 -top {name} -json {made}"
            self.ended(ran("yosys", "-q", "-p", script))
            self.assertEqual(findings(json.loads(made.read_text(encoding="utf-8"))["modules"][name], legs), [])


if __name__ == "__main__":
    unittest.main()
