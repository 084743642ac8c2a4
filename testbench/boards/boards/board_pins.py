# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the checks of the boards' pins share: their files, ports and tables, and the tests, whose
mistakes are seeded into a copy one at a time.
"""

import csv
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]


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
    """Rows of pins.csv by the FPGA's pin or site."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return {row[key]: row for row in csv.DictReader(lines)}


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


class PinsTests:
    """The tests of a board's TestCase. FILES are those of files_of(); `findings(texts)` says what is
    wrong, a line for each; MISTAKES are (file, what stands in it once, what instead, words that a
    finding then has)."""

    FILES, MISTAKES = {}, ()

    def texts(self):
        return {name: path.read_text(encoding="utf-8") for name, path in self.FILES.items()}

    def test_board_files_agree(self):
        self.assertEqual(self.findings(self.texts()), [])

    def test_seeded_mistakes(self):
        for name, old, new, words in self.MISTAKES:
            with self.subTest(words):
                texts = self.texts()
                self.assertEqual(texts[name].count(old), 1, f"{old!r} once in {self.FILES[name]}")
                texts[name] = texts[name].replace(old, new)
                found = self.findings(texts)
                self.assertTrue(any(words in line for line in found), found)
