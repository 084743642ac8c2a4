# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""cocotb: the core behind its AXI4-Lite slave. docs/other-tools.md

  python docs/examples/cocotb/test_axi.py     all tests in Icarus; needs cocotb 1.9 and Yosys
"""

import csv
import os
import subprocess
import sys
from pathlib import Path

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge, Timer

ROOT = Path(os.environ.get("FELTGATE_ROOT", Path(__file__).resolve().parents[3]))
DESIGN = ROOT / "rtl/generated/lever"


def addresses():
    """{name: byte address}, from the file that LiteX's tools read too."""
    with open(DESIGN / "csr.csv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.reader(file) if row[0] == "csr_register"]
    return {row[1].removeprefix("feltgate_"): int(row[2], 16) for row in rows}


class Manager:
    """One access at a time; inputs change at the falling edge."""

    def __init__(self, dut):
        self.dut = dut
        for name in ("awvalid", "wvalid", "bready", "arvalid", "rready", "awaddr", "wdata",
                     "wstrb", "araddr"):
            getattr(dut, f"{name}_i").value = 0

    async def hand_over(self, valid, ready):
        valid.value = 1
        while not ready.value:
            await FallingEdge(self.dut.clk_i)
        await FallingEdge(self.dut.clk_i)
        valid.value = 0

    async def take(self, valid, ready):
        """Waits for valid; the clock after takes it."""
        while not valid.value:
            await FallingEdge(self.dut.clk_i)
        ready.value = 1

    async def write(self, address, word, strobes=15):
        """The response: 0 OKAY, 2 SLVERR."""
        dut = self.dut
        await FallingEdge(dut.clk_i)
        dut.awaddr_i.value = address
        dut.wdata_i.value = word
        dut.wstrb_i.value = strobes
        data = cocotb.start_soon(self.hand_over(dut.wvalid_i, dut.wready_o))
        await self.hand_over(dut.awvalid_i, dut.awready_o)
        await data
        await self.take(dut.bvalid_o, dut.bready_i)
        response = int(dut.bresp_o.value)
        await FallingEdge(dut.clk_i)
        dut.bready_i.value = 0
        return response

    async def read(self, address):
        """(response, word)."""
        dut = self.dut
        await FallingEdge(dut.clk_i)
        dut.araddr_i.value = address
        await self.hand_over(dut.arvalid_i, dut.arready_o)
        await self.take(dut.rvalid_o, dut.rready_i)
        response, word = int(dut.rresp_o.value), int(dut.rdata_o.value)
        await FallingEdge(dut.clk_i)
        dut.rready_i.value = 0
        return response, word


async def begin(dut):
    for name in ("enc_a_i", "enc_b_i", "enc_z_i", "stop_i"):
        getattr(dut, name).value = 0
    manager = Manager(dut)
    dut.rst_ni.value = 0
    await Timer(1, units="ns")  # the reset comes before the first edge of the clock
    cocotb.start_soon(Clock(dut.clk_i, 20, units="ns").start())
    await ClockCycles(dut.clk_i, 5)
    dut.rst_ni.value = 1
    return manager


@cocotb.test()
async def words_are_kept(dut):
    manager, at = await begin(dut), addresses()
    assert await manager.write(at["torque_limit"], 6554) == 0
    assert await manager.write(at["hold_time"], 77) == 0
    await ClockCycles(dut.clk_i, 120)
    assert await manager.read(at["torque_limit"]) == (0, 6554)
    assert await manager.read(at["hold_time"]) == (0, 77)
    assert await manager.write(at["hold_time"], 1, strobes=1) == 2
    assert await manager.read(0x3000) == (2, 0)


@cocotb.test()
async def an_edge_counts(dut):
    manager, at = await begin(dut), addresses()
    await ClockCycles(dut.clk_i, 200)
    _, before = await manager.read(at["position"])
    for a, b in ((1, 0), (1, 1), (0, 1), (0, 0)):
        dut.enc_a_i.value = a
        dut.enc_b_i.value = b
        await ClockCycles(dut.clk_i, 50)
    await ClockCycles(dut.clk_i, 200)
    _, after = await manager.read(at["position"])
    moved = (after - before + 2**31) % 2**32 - 2**31
    assert abs(moved) == 4, moved


@cocotb.test()
async def a_disarm_passes_a_write_that_waits(dut):
    manager, at = await begin(dut), addresses()
    await manager.write(at["control"], 0b11)
    while not dut.armed_o.value:
        await RisingEdge(dut.clk_i)
    await manager.write(at["ramp_step"], 1)  # waits for the end of the tick
    disarm = cocotb.start_soon(manager.write(at["control"], 0b01))
    await ClockCycles(dut.clk_i, 60)
    assert not dut.armed_o.value
    assert await disarm == 0


def main():
    from cocotb.runner import get_results, get_runner

    listed = (ROOT / "rtl/feltgate_bus.f").read_text(encoding="utf-8").splitlines()
    files = [ROOT / "rtl" / line for line in listed if line and not line.startswith("//")]
    files = [DESIGN / "cfg.sv", *files, Path(__file__).with_name("axi_core.sv")]
    build = os.environ.get("COCOTB_BUILD", "sim_build")
    # Icarus does not take structs in packages: Yosys makes plain Verilog of the chip.
    netlist = Path(build, "axi_core.v").resolve()
    netlist.parent.mkdir(parents=True, exist_ok=True)
    script = f"read_verilog -sv {' '.join(map(str, files))}; prep -flatten -top axi_core; write_verilog -noattr {netlist}"
    subprocess.run(["yosys", "-q", "-p", script], check=True)
    runner = get_runner("icarus")
    runner.build(
        verilog_sources=[netlist],
        hdl_toplevel="axi_core",
        timescale=("1ns", "1ns"),
        build_dir=build,
        always=True,
    )
    results = runner.test(
        hdl_toplevel="axi_core", test_module="test_axi", build_dir=build, test_dir=build,
        extra_env={"PYTHONPATH": str(Path(__file__).parent), "FELTGATE_ROOT": str(ROOT)},
        results_xml=str(Path(build).resolve() / "results.xml"),
    )
    tests, failed = get_results(results)
    print(f"{tests} tests, {failed} failed")
    return 1 if failed or not tests else 0


if __name__ == "__main__":
    sys.exit(main())
