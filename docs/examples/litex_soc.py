#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A LiteX SoC with the core at 0x30000000. docs/other-tools.md

  python docs/examples/litex_soc.py OUT     writes the SoC's Verilog into OUT; needs LiteX 2024.12

Its bus has no processor but another Wishbone bus at the pins as master: put your own, or a CPU.
"""

import argparse
import os
from pathlib import Path

from litex.build.generic_platform import Pins, Subsignal
from litex.build.lattice.platform import LatticeECP5Platform
from litex.soc.integration.builder import Builder
from litex.soc.integration.soc import SoCRegion
from litex.soc.integration.soc_core import SoCCore
from litex.soc.interconnect import wishbone
from migen import ClockDomain, ClockSignal, Instance, Module, ResetSignal

ROOT = Path(os.environ.get("FELTGATE_ROOT", Path(__file__).resolve().parents[2]))
DESIGN = "lever"
BASE = 0x30000000

IO = [
    ("clk", 0, Pins(1)),
    ("rst", 0, Pins(1)),
    ("lever", 0, Subsignal("a", Pins(1)), Subsignal("b", Pins(1)), Subsignal("z", Pins(1)),
     Subsignal("stop", Pins(1)), Subsignal("gates", Pins(4)), Subsignal("armed", Pins(1))),
    ("host", 0, *[Subsignal(name, Pins(width)) for name, width in (
        ("adr", 30), ("dat_w", 32), ("dat_r", 32), ("sel", 4), ("cyc", 1), ("stb", 1), ("we", 1),
        ("ack", 1), ("err", 1), ("cti", 3), ("bte", 2))]),
]  # fmt: skip


class Feltgate(Module):
    """The core as a Wishbone slave of 4096 words. The bus counts words."""

    def __init__(self, platform, pads):
        self.bus = bus = wishbone.Interface(data_width=32, address_width=32, addressing="word")
        self.specials += Instance(
            "wishbone_core",
            p_Pipelined=0,
            i_clk_i=ClockSignal(),
            i_rst_ni=~ResetSignal(),
            i_enc_a_i=pads.a,
            i_enc_b_i=pads.b,
            i_enc_z_i=pads.z,
            i_stop_i=pads.stop,
            o_gates_o=pads.gates,
            o_armed_o=pads.armed,
            i_cyc_i=bus.cyc,
            i_stb_i=bus.stb,
            i_we_i=bus.we,
            i_adr_i=bus.adr[:12],
            i_sel_i=bus.sel,
            i_dat_i=bus.dat_w,
            o_dat_o=bus.dat_r,
            o_ack_o=bus.ack,
            o_err_o=bus.err,
        )
        for path in sources():
            platform.add_source(str(path))


def sources():
    """Files of core and bus slave, in reading order."""
    rtl = ROOT / "rtl"
    listed = (rtl / "feltgate_bus.f").read_text(encoding="utf-8").splitlines()
    files = [rtl / line for line in listed if line and not line.startswith("//")]
    package = rtl / "generated" / DESIGN / "cfg.sv"
    return [package, *files, ROOT / "docs/examples/wishbone_core.sv"]


class SoC(SoCCore):
    def __init__(self, platform, clock_hz):
        SoCCore.__init__(
            self, platform, clock_hz, cpu_type=None, integrated_rom_size=0, integrated_sram_size=0,
            with_uart=False, with_timer=False, ident="", ident_version=False,
        )  # fmt: skip
        self.clock_domains.cd_sys = ClockDomain()
        self.comb += [
            self.cd_sys.clk.eq(platform.request("clk")),
            self.cd_sys.rst.eq(platform.request("rst")),
        ]
        self.submodules.feltgate = Feltgate(platform, platform.request("lever"))
        region = SoCRegion(origin=BASE, size=0x4000, cached=False)
        self.bus.add_slave("feltgate", self.feltgate.bus, region)

        master = wishbone.Interface(data_width=32, address_width=32, addressing="word")
        self.comb += master.connect_to_pads(platform.request("host"), mode="slave")
        self.bus.add_master("host", master)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output", type=Path)
    output = parser.parse_args().output
    platform = LatticeECP5Platform("LFE5U-85F-6BG381C", IO, toolchain="trellis")
    soc = SoC(platform, clock_hz=50_000_000)
    builder = Builder(
        soc, output_dir=str(output), compile_software=False, compile_gateware=False,
        csr_csv=str(output / "csr.csv"),
    )  # fmt: skip
    builder.build(run=False, build_name="soc")
    print(f"SoC in {output}/gateware, the core at 0x{BASE:08x}")


if __name__ == "__main__":
    main()
