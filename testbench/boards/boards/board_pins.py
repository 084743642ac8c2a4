# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the checks of the boards' pins share: their files, ports and tables, and the tests, whose
mistakes are seeded into a copy one at a time.
"""

import csv
import re
from collections import Counter

from testing import ROOT


def files_of(board, constraints):
    """{kind: path} of a board; `constraints` is the ending of the file that places its ports."""
    folder = ROOT / "rtl/boards" / board
    return {
        constraints: folder / f"{board}.{constraints}",
        "sv": folder / f"{board}.sv",
        "pins": folder / "pins.csv",
        "doc": ROOT / f"docs/boards/{board}.md",
    }


def read_pins(text, key):
    """Rows of pins.csv by the FPGA's pin or site, each with its place."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    rows = csv.DictReader(lines)
    return {row[key]: {"place": row.get("header") or "on board"} | row for row in rows}


def read_ports(text, board):
    """Port bits of the top module, such as KEY[1], with their direction."""
    text = re.sub(r"//.*|/\*.*?\*/", "", text)
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
    "driver_fault_n": "an unplugged driver would look healthy",
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
        if port.startswith(PULLED_UP) and setting.get(pull) != "UP":
            found.append(f"{kind}: {port} is not pulled up; open, it has to read high")
        for begins, why in PULLED_DOWN.items():
            if port.startswith(begins) and setting.get(pull) != "DOWN":
                found.append(f"{kind}: {port} is not pulled down; {why}")
        line = f"| `{port}` | {row['signal']} | {row[key]} | {row['place']} |"
        if line not in texts["doc"]:
            found.append(f"doc: no row '{line}'; correct the table")
    return found


def settings_in(text, pattern):
    """Of each port that the pattern finds beside its words: (port, {key: value})."""
    return [(port, dict(w.split("=") for w in words.split())) for port, words in re.findall(pattern, text)]


class PinsTests:
    """The tests of a BOARD's TestCase, whose ports the file of KIND places at a KEY of pins.csv.
    `read(text)` of that file gives its lists, whose lines have the WORDS; `findings(texts)` says what is
    wrong, a line for each; MISTAKES are (file, what stands in it once, what instead, words that a
    finding then has). COUNTS are the rows of pins.csv, the ports and the outputs."""

    def texts(self):
        files = files_of(self.BOARD, self.KIND)
        return {name: path.read_text(encoding="utf-8") for name, path in files.items()}

    def test_the_parsers_saw_the_whole_files(self):
        texts = self.texts()
        ports = read_ports(texts["sv"], self.BOARD)
        outputs = sum(way == "output" for way in ports.values())
        self.assertEqual((len(read_pins(texts["pins"], self.KEY)), len(ports), outputs), self.COUNTS)
        for found, words in zip(self.read(texts[self.KIND]), self.WORDS):
            self.assertEqual(len(found), texts[self.KIND].count(words))

    def test_board_files_agree(self):
        self.assertEqual(self.findings(self.texts()), [])

    def test_seeded_mistakes(self):
        for name, old, new, words in self.MISTAKES:
            with self.subTest(words):
                texts = self.texts()
                self.assertEqual(texts[name].count(old), 1, f"{old!r} once in {name}")
                texts[name] = texts[name].replace(old, new)
                found = self.findings(texts)
                self.assertTrue(any(words in line for line in found), found)
