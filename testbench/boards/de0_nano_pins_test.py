#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Checks de0_nano.qsf against the board's pin table, the ports of de0_nano.sv and the wiring page.

Quartus is not available here, so this stands in for its pin checks: each port one pin, no pin
twice, no unknown pin or port, the IO standard on every pin, no output on an input-only pin. The
second half breaks a copy in every one of these ways and wants to see it found.
Documentation: docs/boards/de0_nano.md
"""

import csv
import re
import shlex
import unittest
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BOARD = ROOT / "rtl/boards/de0_nano"
FILES = {
    "qsf": BOARD / "de0_nano.qsf",
    "sv": BOARD / "de0_nano.sv",
    "pins": BOARD / "pins.csv",
    "doc": ROOT / "docs/boards/de0_nano.md",
}
IO_STANDARD = "3.3-V LVTTL"
GLOBALS = {"FAMILY": "Cyclone IV E", "DEVICE": "EP4CE22F17C6", "TOP_LEVEL_ENTITY": "de0_nano"}


def read_pins(text):
    """Rows of pins.csv by FPGA pin."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return {row["pin"]: row for row in csv.DictReader(lines)}


def read_ports(text):
    """Port bits of the top module, such as KEY[1], with their direction."""
    text = re.sub(r"//.*|/\*.*?\*/", "", text)
    header = re.search(r"module\s+de0_nano\b.*?\)\s*\((.*?)\)\s*;", text, re.S).group(1)
    ports = {}
    for port in header.split(","):
        direction, _, msb, name = re.fullmatch(
            r"\s*(input|output)\s+logic\s*(\[(\d+):0\])?\s*(\w+)\s*", port
        ).groups()
        bits = [name] if msb is None else [f"{name}[{i}]" for i in range(int(msb) + 1)]
        ports.update((bit, direction) for bit in bits)
    return ports


def read_qsf(text):
    """(locations, standards, globals): lists of (port, value), in the order of the file."""
    locations, standards, settings = [], [], []
    for line in text.splitlines():
        words = shlex.split(line, comments=True)
        if words[:1] == ["set_location_assignment"]:
            locations.append((words[words.index("-to") + 1], words[1].removeprefix("PIN_")))
        elif words[:3] == ["set_instance_assignment", "-name", "IO_STANDARD"]:
            standards.append((words[words.index("-to") + 1], words[3]))
        elif words[:2] == ["set_global_assignment", "-name"]:
            settings.append((words[2], words[3]))
    return locations, standards, settings


def findings(texts):
    """One line for everything that is wrong, as 'what; mend'."""
    pins, ports = read_pins(texts["pins"]), read_ports(texts["sv"])
    locations, standards, settings = read_qsf(texts["qsf"])
    found = []

    for name, value in GLOBALS.items():
        if (name, value) not in settings:
            found.append(f"qsf: {name} is not {value}; set it")

    for port, count in Counter(port for port, _ in locations).items():
        if port not in ports:
            found.append(f"qsf: {port} is no port of de0_nano.sv; remove it or name the port")
        if count > 1:
            found.append(f"qsf: {port} has {count} pins; leave one")
    for pin, count in Counter(pin for _, pin in locations).items():
        if pin not in pins:
            found.append(f"qsf: pin {pin} is not in pins.csv; take one that is")
        if count > 1:
            found.append(f"qsf: pin {pin} is used {count} times; give each port its own")

    where, standard = dict(locations), dict(standards)
    by_signal = {row["signal"]: pin for pin, row in pins.items()}
    for port, direction in ports.items():
        if port not in where:
            found.append(f"qsf: port {port} has no pin; add set_location_assignment")
            continue
        if standard.get(port) != IO_STANDARD:
            found.append(f"qsf: {port} has IO standard {standard.get(port)}; set {IO_STANDARD}")
        row = pins.get(where[port])
        if row is None:
            continue
        allowed = {"in": "input", "out": "output"}.get(row["direction"], direction)
        if direction != allowed:
            found.append(
                f"qsf: {port} is an {direction}, pin {row['pin']} is {allowed} only; move it"
            )
        # A port named as the board names a signal belongs on that signal, all others on a header.
        if port in by_signal and by_signal[port] != row["pin"]:
            found.append(
                f"qsf: {port} is on pin {row['pin']}, the board has it on {by_signal[port]}"
            )
        if port not in by_signal and not row["header"]:
            found.append(
                f"qsf: {port} is on {row['signal']}, which is on the board; use a header pin"
            )
        place = row["header"] or "on board"
        if f"| `{port}` | {row['signal']} | {row['pin']} | {place} |" not in texts["doc"]:
            found.append(
                f"doc: no row '{port}, {row['signal']}, {row['pin']}, {place}'; correct the table"
            )
    for port in {port for port, _ in standards} - set(ports):
        found.append(f"qsf: IO standard for {port}, which is no port; remove it")
    return found


def committed():
    return {name: path.read_text(encoding="utf-8") for name, path in FILES.items()}


class Committed(unittest.TestCase):
    def test_board_files_agree(self):
        self.assertEqual(findings(committed()), [])

    def test_the_parsers_saw_the_whole_files(self):
        texts = committed()
        ports = read_ports(texts["sv"])
        self.assertEqual(len(read_pins(texts["pins"])), 87)
        self.assertEqual(len(ports), 26)
        self.assertEqual(sum(d == "output" for d in ports.values()), 13)
        self.assertEqual(len(read_qsf(texts["qsf"])[0]), texts["qsf"].count("PIN_"))


class SeededMistakes(unittest.TestCase):
    """Each breaks one file in one way; the named words must then stand in a finding."""

    def expect(self, name, old, new, words):
        texts = committed()
        self.assertEqual(texts[name].count(old), 1, f"{old!r} must stand once in {FILES[name]}")
        texts[name] = texts[name].replace(old, new)
        found = findings(texts)
        self.assertTrue(any(words in line for line in found), found)

    def test_port_without_pin(self):
        self.expect(
            "qsf", "set_location_assignment PIN_A5 -to ENC_A\n", "", "port ENC_A has no pin"
        )

    def test_port_with_two_pins(self):
        line = "set_location_assignment PIN_A5 -to ENC_A\n"
        self.expect("qsf", line, line + line.replace("A5", "A6"), "ENC_A has 2 pins")

    def test_pin_used_twice(self):
        self.expect("qsf", "PIN_D9 -to GATE_A_LO", "PIN_C9 -to GATE_A_LO", "pin C9 is used 2 times")

    def test_unknown_pin(self):
        self.expect("qsf", "PIN_D9 -to", "PIN_Z99 -to", "pin Z99 is not in pins.csv")

    def test_unknown_port(self):
        self.expect("qsf", "PIN_D9 -to GATE_A_LO", "PIN_D9 -to GATE_C_LO", "GATE_C_LO is no port")

    def test_missing_io_standard(self):
        line = f'set_instance_assignment -name IO_STANDARD "{IO_STANDARD}" -to ESTOP\n'
        self.expect("qsf", line, "", "ESTOP has IO standard None")

    def test_wrong_io_standard(self):
        line = f'"{IO_STANDARD}" -to KEY[1]'
        self.expect("qsf", line, line.replace("3.3", "2.5"), "KEY[1] has IO standard 2.5-V LVTTL")

    def test_output_on_input_only_pin(self):
        self.expect("qsf", "PIN_D9 -to", "PIN_A8 -to", "pin A8 is input only")

    def test_board_signal_on_foreign_pin(self):
        self.expect("qsf", "PIN_J15 -to KEY[0]", "PIN_A2 -to KEY[0]", "the board has it on J15")

    def test_gate_on_a_lamp(self):
        self.expect("qsf", "PIN_D9 -to", "PIN_L3 -to", "use a header pin")

    def test_new_port_in_the_top_level(self):
        old = "output logic       GATE_B_LO\n"
        self.expect(
            "sv", old, "output logic       GATE_B_LO,\n  input logic NEW\n", "port NEW has no"
        )

    def test_wider_port_in_the_top_level(self):
        self.expect("sv", "[3:0] SW,", "[4:0] SW,", "port SW[4] has no pin")

    def test_other_device(self):
        self.expect("qsf", "EP4CE22F17C6", "EP4CE10F17C8", "DEVICE is not")

    def test_stale_wiring_page(self):
        self.expect(
            "doc", "GPIO_0[9] | D5 | JP1 pin 14", "GPIO_0[9] | D5 | JP1 pin 15", "doc: no row"
        )


if __name__ == "__main__":
    unittest.main()
