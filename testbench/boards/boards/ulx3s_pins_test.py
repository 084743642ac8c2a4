#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Checks ulx3s.lpf against the board's sites, the ports of ulx3s.sv and the wiring page.

nextpnr places what it is told: a wrong site is no error there. So: each port one site, no site
twice, each site one that at least two public files agree on, IO standard and pull on every pin,
nothing driven that is an input on the board, pulls on the safe side, and the table of the page. The
second half breaks a copy in each of these ways and wants to see it found.
Documentation: docs/boards/ulx3s.md
"""

import re
import unittest

from board_pins import PinsTests, placement, settings_in

SOURCES = set("ABCD")


def read_lpf(text):
    """(sites, settings): lists of (port, site) and (port, {key: value})."""
    text = re.sub(r"#.*", "", text)
    sites = re.findall(r'LOCATE COMP "([^"]+)" SITE "([^"]+)"', text)
    return sites, settings_in(text, r'IOBUF PORT "([^"]+)" ([^;]+);')


def findings(texts):
    """One line for everything that is wrong, as 'what; mend'."""
    sites, settings = read_lpf(texts["lpf"])
    found = placement(texts, "ulx3s", "lpf", "site", sites, settings, SOURCES, "PULLMODE")
    if 'FREQUENCY PORT "clk_25mhz" 25 MHZ;' not in texts["lpf"]:
        found.append("lpf: clk_25mhz has not its 25 MHz; nextpnr takes the PLL's clock from it")
    return found


GATE = 'IOBUF PORT "gate_a_hi" PULLMODE=DOWN'


class Ulx3s(PinsTests, unittest.TestCase):
    BOARD, KIND, KEY, COUNTS = "ulx3s", "lpf", "site", (79, 42, 22)
    WORDS = ("LOCATE COMP", "IOBUF PORT")
    MISTAKES = (
        ("lpf", 'LOCATE COMP "enc_a" SITE "B11"', 'LOCATE COMP "enc_a" SITE "A10"',
         "site A10 is used 2"),
        ("lpf", 'LOCATE COMP "enc_a" SITE "B11"', 'LOCATE COMP "enc_b" SITE "B11"',
         "port enc_b is used 2"),
        ("lpf", 'LOCATE COMP "enc_a" SITE "B11"', 'LOCATE COMP "enc_a" SITE "Z99"',
         "Z99, which is not in"),
        ("lpf", 'LOCATE COMP "gate_a_hi"', 'LOCATE COMP "gate_d_hi"', "gate_d_hi is no port"),
        ("lpf", 'SITE "B15"', 'SITE "V1"', "is an output, btn[4] is not"),
        ("lpf", 'SITE "B11"', 'SITE "U1"', "use a header"),
        ("lpf", 'LOCATE COMP "sw[0]" SITE "E8"', 'LOCATE COMP "sw[0]" SITE "C6"',
         "the board has it at E8"),
        ("lpf", GATE, GATE.replace("DOWN", "UP"), "not pulled down"),
        ("lpf", 'IOBUF PORT "estop" PULLMODE=UP', 'IOBUF PORT "estop" PULLMODE=DOWN',
         "not pulled up"),
        ("lpf", 'IOBUF PORT "driver_fault_n" PULLMODE=DOWN', 'IOBUF PORT "driver_fault_n" PULLMODE=UP',
         "an unplugged driver would look healthy"),
        ("lpf", 'IOBUF PORT "current_data" PULLMODE=UP', 'IOBUF PORT "current_data" PULLMODE=NONE',
         "current_data is not pulled up"),
        ("lpf", 'IOBUF PORT "hall[1]" PULLMODE=UP', 'IOBUF PORT "hall[1]" PULLMODE=DOWN', "hall[1] is not pulled up"),
        ("lpf", 'LOCATE COMP "hall[2]" SITE "B8"', 'LOCATE COMP "hall[2]" SITE "C8"', "site C8 is used 2"),
        ("lpf", 'IOBUF PORT "current_data_b" PULLMODE=UP', 'IOBUF PORT "current_data_b" PULLMODE=NONE',
         "current_data_b is not pulled up"),
        ("doc", "| `current_data_b` | gn[20] | E17 |", "| `current_data_b` | gn[20] | D18 |", "doc: no row"),
        ("lpf", f"{GATE} IO_TYPE=LVCMOS33", f"{GATE} IO_TYPE=LVCMOS25", "IO_TYPE LVCMOS25"),
        ("lpf", "25 MHZ", "50 MHZ", "not its 25 MHz"),
        ("pins", "gp[0],B11,J1 pin 5+,inout,A B C", "gp[0],B11,J1 pin 5+,inout,A",
         "two are needed"),
        ("sv", "output logic       gate_b_lo,\n", "output logic gate_b_lo, input logic new,\n",
         "port new"),
        ("doc", "| `enc_b` | gp[1] | A10 |", "| `enc_b` | gp[1] | A11 |", "doc: no row"),
    )
    read, findings = staticmethod(read_lpf), staticmethod(findings)


if __name__ == "__main__":
    unittest.main()
