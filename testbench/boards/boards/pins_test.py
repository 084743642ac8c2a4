#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The pins of each board: the file that places its ports beside pins.csv, the ports of its top module and the table of
its page. Quartus is not here, and to nextpnr a wrong site is no error, so this stands in for a look at the board: each
port one pin, no pin twice, no unknown one, IO standard and pull on every pin, nothing driven that is an input on the
board, pulls on the safe side. Documentation: docs/boards/
"""

import csv
import re
import shlex
import unittest
from collections import Counter

from testing import ROOT


def texts_of(board, constraints):
    """{kind: text} of a board; `constraints` is the ending of the file that places its ports."""
    folder = ROOT / "rtl/boards" / board
    files = {constraints: folder / f"{board}.{constraints}", "sv": folder / f"{board}.sv", "pins": folder / "pins.csv"}
    files["doc"] = ROOT / f"docs/boards/{board}.md"
    return {kind: path.read_text(encoding="utf-8") for kind, path in files.items()}


def read_pins(text, key):
    """Rows of pins.csv by the FPGA's pin or site, each with its place."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    rows = csv.DictReader(lines)
    return {row[key]: {"place": row.get("header") or "on board"} | row for row in rows}


def device_pins(board):
    """The ports of all devices that a board may have, as device.svh has them."""
    text = (ROOT / "rtl/tops/device.svh").read_text(encoding="utf-8").replace("\\\n", "")
    groups = ["QUADRATURE(T)", "ABSOLUTE(T)", "TWO_LEGS(T)"]
    if board != "tang_nano_9k":  # three phases and a current loop do not fit it
        groups += ["THREE_LEGS(T) `TWO_LEGS(T),", "CURRENT(D)"]
    pins = [re.search(rf"^`define {re.escape(group)} (.*)$", text, re.M)[1] for group in groups]
    pins += ["input logic [2:0] hall_i"] * (board != "tang_nano_9k")
    return re.sub(r"\bT\b", "logic", ", ".join(pins)).replace("input D", "input logic [1:0]")


def read_ports(text, board):
    """Port bits of the top module, such as KEY[1], with their direction."""
    text = re.sub(r"//.*|/\*.*?\*/", "", text).replace("`PINS(logic)", device_pins(board))
    header = re.search(rf"module\s+{board}\b.*?\)\s*\((.*?)\)\s*;", text, re.S).group(1)
    ports = {}
    for port in header.split(","):
        way, _, msb, lsb, name = re.fullmatch(
            r"\s*(input|output)\s+logic\s*(\[(\d+):(\d+)\])?\s*(\w+)\s*", port
        ).groups()
        bits = [name] if msb is None else [f"{name}[{i}]" for i in range(int(lsb), int(msb) + 1)]
        ports.update((bit, way) for bit in bits)
    return ports


# Beginnings of the ports that have to be high while their wire is open: no edge, not plugged in, stop, data that stand.
PULLED_UP = ("enc_", "estop", "sw_n", "key_n", "reset_n", "ftdi_txd", "uart_rx")
PULLED_UP += ("encoder_data", "encoder_select_n", "current_data", "hall")
# What has to be low: gates, a driver that is not plugged in, a heart that does not beat.
PULLED_DOWN = {
    "gate_": "an open gate would be on",
    "driver_fault_i": "an unplugged driver would look healthy",
    "heartbeat": "an open line would not stand",
}


def placement(texts, board, kind, key, places, settings, sources=None, pull="", standard="LVCMOS33"):
    """One line for everything that is wrong with where the ports are and what their pins are set to, as
    'what; mend'. `kind` is the file that places them, `key` what it places them at, `places` and
    `settings` what it says: lists of (port, place) and (port, {name: value}); `pull` is the name of pulls.
    `sources` are the public files that pins.csv names, if any."""
    pins, ports = read_pins(texts["pins"], key), read_ports(texts["sv"], board)
    found = []
    for place, row in pins.items() if sources else ():
        named = row["sources"].split()
        if len(set(named)) < 2 or not set(named) <= sources:
            found.append(f"pins: {row['signal']}, {place} has the sources {named}; two are needed")
    for what, counts in (
        ("port", Counter(port for port, _ in places)),
        (key, Counter(place for _, place in places)),
    ):
        found += [f"{kind}: {what} {n} is used {c} times; once" for n, c in counts.items() if c > 1]
    for port in {port for port, _ in places} | {port for port, _ in settings}:
        if port not in ports:
            found.append(f"{kind}: {port} is no port of {board}.sv; remove it or name the port")
    where, how = dict(places), dict(settings)
    by_signal = {row["signal"]: place for place, row in pins.items()}
    for port, way in ports.items():
        row = pins.get(where.get(port))
        if row is None:
            found.append(f"{kind}: port {port} is at {where.get(port)}, which is not in pins.csv")
            continue
        if {"in": "input", "out": "output"}.get(row["direction"], way) != way:
            found.append(f"{kind}: {port} is an {way}, {row['signal']} is not; move it")
        if port in by_signal and by_signal[port] != row[key]:
            found.append(f"{kind}: {port} is at {row[key]}, the board has it at {by_signal[port]}")
        if port not in by_signal and row["place"] == "on board":
            found.append(f"{kind}: {port} is at {row['signal']}, which is on the board; use a header")
        setting, wanted = how.get(port, {}), row.get("io", standard)
        if setting.get("IO_TYPE") != wanted:
            found.append(f"{kind}: {port} has IO_TYPE {setting.get('IO_TYPE')}; {wanted}")
        if pull and port.startswith(PULLED_UP) and setting.get(pull) != "UP":
            found.append(f"{kind}: {port} is not pulled up; open, it has to read high")
        for begins, why in PULLED_DOWN.items():
            if pull and port.startswith(begins) and setting.get(pull) != "DOWN":
                found.append(f"{kind}: {port} is not pulled down; {why}")
        line = f"| `{port}` | {row['signal']} | {row[key]} | {row['place']} |"
        if line not in texts["doc"]:
            found.append(f"doc: no row '{line}'; correct the table")
    return found


def settings_in(text, pattern):
    """Of each port that the pattern finds beside its words: (port, {key: value})."""
    return [(port, dict(w.split("=") for w in words.split())) for port, words in re.findall(pattern, text)]

# Of the DE0-Nano.
GLOBALS = {"FAMILY": "Cyclone IV E", "DEVICE": "EP4CE22F17C6", "TOP_LEVEL_ENTITY": "de0_nano"}
WEAK_PULL_UP = ("enc_a_i", "enc_b_i", "enc_z_i", "enc_loop", "estop", "uart_rx", "encoder_data_i", "current_data_i[0]",
                "current_data_i[1]", "driver_fault_i", "hall_i[0]", "hall_i[1]", "hall_i[2]")
# Of the Tang Nano: what the vendor's own files have to name.
BY_VENDOR = ("estop", "enc_a", "enc_b", "enc_loop", "gate_", "encoder_data")


def read_qsf(text):
    """(locations, standards, globals): lists of (port, pin), (port, {"IO_TYPE": value}) and (name, value)."""
    locations, settings = [], []
    for line in text.splitlines():
        words = shlex.split(line, comments=True)
        if words[:1] == ["set_location_assignment"]:
            locations.append((words[words.index("-to") + 1], words[1].removeprefix("PIN_")))
        elif words[:2] == ["set_global_assignment", "-name"]:
            settings.append((words[2], words[3]))
    standard = dict(settings).get("STRATIX_DEVICE_IO_STANDARD")  # of all pins
    return locations, [(port, {"IO_TYPE": standard}) for port, _ in locations], settings


def read_cst(text):
    """(pins, settings): lists of (port, pin) and (port, {key: value})."""
    text = re.sub(r"//.*", "", text)
    pins = re.findall(r'IO_LOC\s+"([^"]+)"\s+([^;]+);', text)
    return pins, settings_in(text, r'IO_PORT\s+"([^"]+)"\s+([^;]+);')


def read_lpf(text):
    """(sites, settings): lists of (port, site) and (port, {key: value})."""
    text = re.sub(r"#.*", "", text)
    sites = re.findall(r'LOCATE COMP "([^"]+)" SITE "([^"]+)"', text)
    return sites, settings_in(text, r'IOBUF PORT "([^"]+)" ([^;]+);')


class Pins(unittest.TestCase):
    def check(self, texts, read, words, counts, **how):
        """What read(text) makes of the file that places the ports; the counts are rows of pins.csv, ports and outputs."""
        board, kind, key = how["board"], how["kind"], how["key"]
        ports = read_ports(texts["sv"], board)
        outputs = sum(way == "output" for way in ports.values())
        self.assertEqual((len(read_pins(texts["pins"], key)), len(ports), outputs), counts)
        found = read(texts[kind])
        for rows, word in zip(found, words):
            self.assertEqual(len(rows), texts[kind].count(word))
        self.assertEqual(placement(texts, places=found[0], settings=found[1], **how), [])
        return found

    def test_de0_nano(self):
        texts = texts_of("de0_nano", "qsf")
        how = {"board": "de0_nano", "kind": "qsf", "key": "pin", "standard": "3.3-V LVTTL"}
        _, _, settings = self.check(texts, read_qsf, ("PIN_",), (87, 40, 20), **how)
        for port in WEAK_PULL_UP:
            self.assertIn(f"set_instance_assignment -name WEAK_PULL_UP_RESISTOR ON -to {port}\n", texts["qsf"])
        for setting in GLOBALS.items():
            self.assertIn(setting, settings)

    def test_ulx3s(self):
        texts = texts_of("ulx3s", "lpf")
        how = {"board": "ulx3s", "kind": "lpf", "key": "site", "sources": set("ABCD"), "pull": "PULLMODE"}
        self.check(texts, read_lpf, ("LOCATE COMP", "IOBUF PORT"), (79, 41, 21), **how)
        self.assertIn('FREQUENCY PORT "clk_25mhz" 25 MHZ;', texts["lpf"])  # nextpnr takes the PLL's clock from it

    def test_tang_nano_9k(self):
        texts = texts_of("tang_nano_9k", "cst")
        how = {"board": "tang_nano_9k", "kind": "cst", "key": "pin", "sources": set("VALRMH"), "pull": "PULL_MODE"}
        places, _ = self.check(texts, read_cst, ("IO_LOC", "IO_PORT"), (28, 28, 14), **how)
        for pin, row in read_pins(texts["pins"], "pin").items():
            users = [port for port, place in places if place == pin and port.startswith(BY_VENDOR)]
            if users or row["place"] == "on board":
                self.assertIn("V", row["sources"].split(), pin)
            # Pins 3 to 16 and 79 to 88 are of bank 3, which the PSRAM in the package holds at 1.8 V.
            self.assertEqual(row["io"] == "LVCMOS18", int(pin) <= 16 or int(pin) >= 79, pin)


if __name__ == "__main__":
    unittest.main()
