#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Checks tang_nano_9k.cst against the board's pins, the ports of tang_nano_9k.sv and the wiring page.

As ulx3s_pins_test.py, with two rules more: what is on the board is named in the vendor's own files, and
so are the stop, the encoder's A, B, loop and data, and the gates; and a pin of bank 3 has 1.8 V.
Documentation: docs/boards/tang_nano_9k.md
"""

import re
import unittest

from board_pins import PinsTests, placement, read_pins, read_ports, settings_in

SOURCES = set("VALRMH")
BY_VENDOR = ("estop", "enc_a", "enc_b", "enc_loop", "gate_", "encoder_data")


def read_cst(text):
    """(pins, settings): lists of (port, pin) and (port, {key: value})."""
    text = re.sub(r"//.*", "", text)
    pins = re.findall(r'IO_LOC\s+"([^"]+)"\s+([^;]+);', text)
    return pins, settings_in(text, r'IO_PORT\s+"([^"]+)"\s+([^;]+);')


def findings(texts):
    """One line for everything that is wrong, as 'what; mend'."""
    places, settings = read_cst(texts["cst"])
    found = placement(texts, "tang_nano_9k", "cst", "pin", places, settings, SOURCES, "PULL_MODE")
    for pin, row in read_pins(texts["pins"], "pin").items():
        users = [port for port, place in places if place == pin and port.startswith(BY_VENDOR)]
        if (users or row["place"] == "on board") and "V" not in row["sources"].split():
            found.append(f"pins: {users or row['signal']} at {pin} is in no file of the vendor; move it")
        # Pins 3 to 16 and 79 to 88 are of bank 3, which the PSRAM in the package holds at 1.8 V.
        if (row["io"] == "LVCMOS18") != (int(pin) <= 16 or int(pin) >= 79):
            found.append(f"pins: {pin} has {row['io']}, which is not its bank's")
    return found


GATE = 'IO_PORT "gate_a_hi" IO_TYPE=LVCMOS33 PULL_MODE=DOWN'


class TangNano9k(PinsTests, unittest.TestCase):
    BOARD, KIND, KEY, COUNTS = "tang_nano_9k", "cst", "pin", (28, 28, 14)
    WORDS = ("IO_LOC", "IO_PORT")
    MISTAKES = (
        ("cst", 'IO_LOC "enc_a" 33', 'IO_LOC "enc_a" 34', "pin 34 is used 2"),
        ("cst", 'IO_LOC "enc_a" 33', 'IO_LOC "enc_b" 33', "port enc_b is used 2"),
        ("cst", 'IO_LOC "enc_a" 33', 'IO_LOC "enc_a" 89', "89, which is not in"),
        ("cst", 'IO_LOC "gate_a_hi"', 'IO_LOC "gate_d_hi"', "gate_d_hi is no port"),
        ("cst", 'IO_LOC "gate_a_hi" 41', 'IO_LOC "gate_a_hi" 3', "is an output, key_n is not"),
        ("cst", 'IO_LOC "enc_a" 33', 'IO_LOC "enc_a" 18', "use a header"),
        ("cst", 'IO_LOC "uart_tx" 17', 'IO_LOC "uart_tx" 29', "the board has it at 17"),
        ("cst", 'IO_LOC "gate_a_hi" 41', 'IO_LOC "gate_a_hi" 29', "in no file of the vendor"),
        ("cst", GATE, GATE.replace("DOWN", "UP"), "not pulled down"),
        ("cst", 'IO_PORT "estop" IO_TYPE=LVCMOS33 PULL_MODE=UP',
         'IO_PORT "estop" IO_TYPE=LVCMOS33 PULL_MODE=NONE', "not pulled up"),
        ("cst", GATE, GATE.replace("33", "18"), "IO_TYPE LVCMOS18"),
        ("cst", 'IO_PORT "key_n" IO_TYPE=LVCMOS18', 'IO_PORT "key_n" IO_TYPE=LVCMOS33', "; LVCMOS18"),
        ("pins", "key_n,3,on board,in,LVCMOS18", "key_n,3,on board,in,LVCMOS33", "not its bank's"),
        ("pins", "pin 25,25,J6 place 5,inout,LVCMOS33,A L R M H", "pin 25,25,J6 place 5,inout,LVCMOS33,A",
         "two are needed"),
        ("pins", "uart_tx,17,on board,out,LVCMOS33,V L R", "uart_tx,17,on board,out,LVCMOS33,L R",
         "in no file of the vendor"),
        ("sv", "output logic       gate_b_lo,\n", "output logic gate_b_lo, input logic new,\n", "port new"),
        ("doc", "| `enc_b` | pin 34 | 34 |", "| `enc_b` | pin 34 | 35 |", "doc: no row"),
    )

    read, findings = staticmethod(read_cst), staticmethod(findings)


if __name__ == "__main__":
    unittest.main()
