#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Checks de0_nano.qsf against the board's pin table, the ports of de0_nano.sv and the wiring page.

Quartus is not available here, so this stands in for its pin checks: each port one pin, no pin
twice, no unknown pin or port, the IO standard on every pin, no output on an input-only pin. The
second half breaks a copy in every one of these ways and wants to see it found.
Documentation: docs/boards/de0_nano.md
"""

import shlex
import unittest

from board_pins import PinsTests, placement

IO_STANDARD = "3.3-V LVTTL"
GLOBALS = {"FAMILY": "Cyclone IV E", "DEVICE": "EP4CE22F17C6", "TOP_LEVEL_ENTITY": "de0_nano"}
# Open: no edge, not plugged in, stop, an idle line, data that stand, a fault of the driver.
PULLED_UP = ("ENC_A", "ENC_B", "ENC_Z", "ENC_LOOP", "ESTOP", "UART_RX", "ENCODER_DATA", "CURRENT_DATA", "DRIVER_FAULT",
             "CURRENT_DATA_B", "HALL[0]", "HALL[1]", "HALL[2]")


def read_qsf(text):
    """(locations, standards, globals): lists of (port, pin), (port, {"IO_TYPE": value}) and (name, value)."""
    locations, standards, settings = [], [], []
    for line in text.splitlines():
        words = shlex.split(line, comments=True)
        if words[:1] == ["set_location_assignment"]:
            locations.append((words[words.index("-to") + 1], words[1].removeprefix("PIN_")))
        elif words[:3] == ["set_instance_assignment", "-name", "IO_STANDARD"]:
            standards.append((words[words.index("-to") + 1], {"IO_TYPE": words[3]}))
        elif words[:2] == ["set_global_assignment", "-name"]:
            settings.append((words[2], words[3]))
    return locations, standards, settings


def findings(texts):
    """One line for everything that is wrong, as 'what; mend'."""
    locations, standards, settings = read_qsf(texts["qsf"])
    found = placement(texts, "de0_nano", "qsf", "pin", locations, standards, standard=IO_STANDARD)
    for port in PULLED_UP:
        if f"set_instance_assignment -name WEAK_PULL_UP_RESISTOR ON -to {port}\n" not in texts["qsf"]:
            found.append(f"qsf: {port} is not pulled up; open, it has to read high")
    for name, value in GLOBALS.items():
        if (name, value) not in settings:
            found.append(f"qsf: {name} is not {value}; set it")
    return found


STANDARD_OF = 'set_instance_assignment -name IO_STANDARD "3.3-V LVTTL" -to ESTOP\n'
ENC_A = "set_location_assignment PIN_A5 -to ENC_A\n"


class De0Nano(PinsTests, unittest.TestCase):
    BOARD, KIND, KEY, COUNTS = "de0_nano", "qsf", "pin", (87, 41, 21)
    WORDS = ("PIN_",)
    MISTAKES = (
        ("qsf", ENC_A, "", "port ENC_A is at None"),
        ("qsf", ENC_A, ENC_A + ENC_A.replace("A5", "A6"), "port ENC_A is used 2 times"),
        ("qsf", "PIN_D9 -to GATE_A_LO", "PIN_C9 -to GATE_A_LO", "pin C9 is used 2 times"),
        ("qsf", "PIN_D9 -to", "PIN_Z99 -to", "Z99, which is not in pins.csv"),
        ("qsf", "PIN_D9 -to GATE_A_LO", "PIN_D9 -to GATE_D_LO", "GATE_D_LO is no port"),
        ("qsf", STANDARD_OF, "", "ESTOP has IO_TYPE None"),
        ("qsf", '"3.3-V LVTTL" -to KEY[1]', '"2.5-V LVTTL" -to KEY[1]',
         "KEY[1] has IO_TYPE 2.5-V LVTTL"),
        ("qsf", "PIN_D9 -to", "PIN_A8 -to", "GATE_A_LO is an output, GPIO_0_IN[0] is not"),
        ("qsf", "PIN_J15 -to KEY[0]", "PIN_A2 -to KEY[0]", "the board has it at J15"),
        ("qsf", "PIN_D9 -to", "PIN_L3 -to", "use a header"),
        ("sv", "output logic       GATE_B_LO,\n", "output logic GATE_B_LO,\n  input logic NEW,\n",
         "port NEW is at None"),
        ("sv", "[3:0] SW,", "[4:0] SW,", "port SW[4] is at None"),
        ("qsf", "EP4CE22F17C6", "EP4CE10F17C8", "DEVICE is not"),
        ("qsf", "WEAK_PULL_UP_RESISTOR ON -to DRIVER_FAULT\n", "WEAK_PULL_UP_RESISTOR OFF -to DRIVER_FAULT\n",
         "DRIVER_FAULT is not pulled up"),
        ("qsf", "WEAK_PULL_UP_RESISTOR ON -to HALL[1]\n", "WEAK_PULL_UP_RESISTOR OFF -to HALL[1]\n", "HALL[1] is not pulled up"),
        ("doc", "GPIO_0[9] | D5 | JP1 pin 14", "GPIO_0[9] | D5 | JP1 pin 15", "doc: no row"),
    )
    read, findings = staticmethod(read_qsf), staticmethod(findings)


if __name__ == "__main__":
    unittest.main()
