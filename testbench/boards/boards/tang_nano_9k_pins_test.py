#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Checks tang_nano_9k.cst against the board's pins, the ports of tang_nano_9k.sv and the wiring page.

As ulx3s_pins_test.py, with two rules more: what is on the board is named in the vendor's own files, and
so are the stop, the encoder's A, B, loop and data, the driver's fault, the heartbeat and the gates; and a pin of bank 3 has 1.8 V.
The top level has two faces, with and without a third leg, and the constraints place the ports of both. All rules hold for each;
and a pin that is a gate in one is pulled down in the other, so that no bitstream turns on what is wired for the other.
Documentation: docs/boards/tang_nano_9k.md
"""

import re
import unittest

from board_pins import PinsTests, placement, read_pins, read_ports, settings_in

SOURCES = set("VALRMH")
BY_VENDOR = ("estop", "enc_a", "enc_b", "enc_loop", "gate_", "driver_fault_n", "heartbeat", "encoder_data")


def read_cst(text):
    """(pins, settings): lists of (port, pin) and (port, {key: value})."""
    text = re.sub(r"//.*", "", text)
    pins = re.findall(r'IO_LOC\s+"([^"]+)"\s+([^;]+);', text)
    return pins, settings_in(text, r'IO_PORT\s+"([^"]+)"\s+([^;]+);')


FACES = ((), ("FELTGATE_THIRD_LEG",))


def findings(texts):
    """One line for everything that is wrong, as 'what; mend'."""
    places, settings = read_cst(texts["cst"])
    faces = [set(read_ports(texts["sv"], "tang_nano_9k", defined)) for defined in FACES]
    found = []
    for defined, ports, others in zip(FACES, faces, reversed(faces)):
        # A port of the other face alone is not there; one of neither is a mistake.
        here, these = ([row for row in rows if row[0] in ports or row[0] not in others] for rows in (places, settings))
        found += placement(texts, "tang_nano_9k", "cst", "pin", here, these, SOURCES, "PULL_MODE", defined=defined)
    how = dict(settings)
    for gate, pin in places:
        beside = [port for port, place in places if place == pin and port != gate and gate.startswith("gate_")]
        found += [f"cst: {port} at {pin} would pull {gate} up with another bitstream; move {gate}"
                  for port in beside if how.get(port, {}).get("PULL_MODE") != "DOWN"]
    for pin, row in read_pins(texts["pins"], "pin").items():
        users = [port for port, place in places if place == pin and port.startswith(BY_VENDOR)]
        if (users or row["place"] == "on board") and "V" not in row["sources"].split():
            found.append(f"pins: {users or row['signal']} at {pin} is in no file of the vendor; move it")
        # Pins 3 to 16 and 79 to 88 are of bank 3, which the PSRAM in the package holds at 1.8 V.
        if (row["io"] == "LVCMOS18") != (int(pin) <= 16 or int(pin) >= 79):
            found.append(f"pins: {pin} has {row['io']}, which is not its bank's")
    return found


GATE = 'IO_PORT "gate_a_hi" IO_TYPE=LVCMOS33 PULL_MODE=DOWN'
GATE_C = GATE.replace("_a_", "_c_")


class TangNano9k(PinsTests, unittest.TestCase):
    BOARD, KIND, KEY, COUNTS = "tang_nano_9k", "cst", "pin", (32, 32, 16)
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
        ("cst", 'IO_PORT "driver_fault_n" IO_TYPE=LVCMOS33 PULL_MODE=DOWN',
         'IO_PORT "driver_fault_n" IO_TYPE=LVCMOS33 PULL_MODE=UP', "an unplugged driver would look healthy"),
        ("cst", 'IO_LOC "driver_fault_n" 48', 'IO_LOC "driver_fault_n" 31', "in no file of the vendor"),
        ("cst", GATE, GATE.replace("33", "18"), "IO_TYPE LVCMOS18"),
        ("cst", 'IO_PORT "key_n" IO_TYPE=LVCMOS18', 'IO_PORT "key_n" IO_TYPE=LVCMOS33', "; LVCMOS18"),
        ("pins", "key_n,3,on board,in,LVCMOS18", "key_n,3,on board,in,LVCMOS33", "not its bank's"),
        ("pins", "pin 25,25,J6 place 5,inout,LVCMOS33,A L R M H", "pin 25,25,J6 place 5,inout,LVCMOS33,A",
         "two are needed"),
        ("pins", "uart_tx,17,on board,out,LVCMOS33,V L R", "uart_tx,17,on board,out,LVCMOS33,L R",
         "in no file of the vendor"),
        ("sv", "output logic       gate_b_lo,\n", "output logic gate_b_lo, input logic new,\n", "port new"),
        # Of the third leg: shoot-through with the other bitstream, two gates at a pin, a gate that nobody holds low.
        ("cst", 'IO_LOC "gate_c_hi" 48', 'IO_LOC "gate_c_hi" 33', "enc_a at 33 would pull gate_c_hi up"),
        ("cst", 'IO_LOC "gate_c_lo" 49', 'IO_LOC "gate_c_lo" 48', "pin 48 is used 2"),
        ("cst", 'IO_LOC "gate_c_lo" 49', 'IO_LOC "gate_c_lo" 35', "pin 35 is used 2"),
        ("cst", GATE_C, GATE_C.replace("DOWN", "UP"), "gate_c_hi is not pulled down"),
        ("sv", "  output logic       gate_c_lo\n", "  input  logic       gate_c_lo, input logic other\n", "port other"),
        ("doc", "| `gate_c_lo` | pin 49 | 49 |", "| `gate_c_lo` | pin 49 | 48 |", "doc: no row"),
        ("doc", "| `enc_b` | pin 34 | 34 |", "| `enc_b` | pin 34 | 35 |", "doc: no row"),
    )
    def test_the_third_leg_takes_two_pins_and_leaves_the_others(self):
        two, three = (read_ports(self.texts()["sv"], self.BOARD, defined) for defined in FACES)
        self.assertEqual(set(two) - set(three), {"driver_fault_n", "heartbeat"})
        self.assertEqual({port: three[port] for port in set(three) - set(two)},
                         dict.fromkeys(("gate_c_hi", "gate_c_lo"), "output"))

    read, findings = staticmethod(read_cst), staticmethod(findings)


if __name__ == "__main__":
    unittest.main()
