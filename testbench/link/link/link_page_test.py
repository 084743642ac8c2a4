#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The frames that docs/link.md shows, computed again; what docs/examples/link.py sends and
takes."""

import re
import struct
import sys
import unittest
import zlib

from testing import ROOT, text_of

sys.path.insert(0, str(ROOT / "docs/examples"))
import link  # noqa: E402

PAGE = text_of("docs/link.md")


def decoded(raw):
    """The body of one whole frame, byte by byte as the page says it; None where it is spoiled."""
    body, escaped = bytearray(), False
    for byte in raw[1:-1]:
        if escaped:
            if byte not in (0xDC, 0xDD):
                return None
            body.append({0xDC: 0xC0, 0xDD: 0xDB}[byte])
        elif byte != 0xDB:
            body.append(byte)
        escaped = not escaped and byte == 0xDB
    crc = int.from_bytes(body[-4:], "little")
    return bytes(body[:-4]) if crc == zlib.crc32(body[:-4]) else None


def shown():
    """(who, bytes) of each line of an example."""
    lines = re.findall(r"^([<>]) ((?:[0-9a-f]{2} ?)+)$", PAGE, re.M)
    return [(who, bytes.fromhex(text)) for who, text in lines]


class Page(unittest.TestCase):
    def test_frames(self):
        kinds = set()
        for who, raw in shown():
            with self.subTest(raw.hex(" ")):
                self.assertEqual((raw[0], raw[-1]), (0xC0, 0xC0))
                body = decoded(raw)
                self.assertIsNotNone(body)
                self.assertEqual(link.pack(body), raw)
                self.assertEqual(link.unpack(raw[1:-1]), body)
                self.assertIn(body[0], (1, 2) if who == ">" else (0x81, 0x82, 0x40))
                kinds.add(body[0])
                if who == ">":
                    self.assertEqual(len(body), 8)
        self.assertEqual(kinds, {1, 2, 0x81, 0x82, 0x40})
        self.assertTrue(any(b"\xdb\xdc" in raw and b"\xdb\xdd" in raw for _, raw in shown()))


class Line:
    """A port with a board at its other end that loses every second request and streams between."""

    def __init__(self):
        self.words, self.sent, self.asked, self.acted = {0x1008: 0x100}, b"", 0, []

    def write(self, raw):
        self.asked += 1
        kind, sequence, address, value = struct.unpack("<BBHI", decoded(raw))
        stream = link.pack(struct.pack("<BBHI", 0x40, self.asked & 255, 4, self.asked))
        self.sent += stream + link.pack(bytes([kind | 0x80, sequence ^ 1, 0, 0]))
        if kind == 2 and self.words[0x1008] != sequence:
            self.words[address], self.words[0x1008] = value, sequence
            self.acted.append((address, value))
        if self.asked % 2 == 0:
            return
        words = [self.words.get(address + k, 0) for k in range(value)] if kind == 1 else [0x700080]
        head = struct.pack("<BBH", kind | 0x80, sequence, address)
        self.sent += link.pack(head + struct.pack(f"<{len(words)}I", *words))

    def read_until(self, end):
        until = self.sent.find(end) + 1 or len(self.sent)
        raw, self.sent = self.sent[:until], self.sent[until:]
        return raw


class Example(unittest.TestCase):
    def test_lost_requests_act_once(self):
        line = Line()
        host = link.Link(line)
        for value in (5, 0xC0DB, 0xDBDC, 7):
            self.assertEqual(host.write(0x18, value), 0x700080)
            self.assertEqual(host.read(0x18), (value,))
        self.assertEqual(line.acted, [(0x18, 5), (0x18, 0xC0DB), (0x18, 0xDBDC), (0x18, 7)])

    def test_spoiled_frames_are_none(self):
        whole = link.pack(struct.pack("<BBHI", 1, 2, 3, 4))[1:-1]
        for byte in range(len(whole)):
            changed = bytes(b ^ (1 if n == byte else 0) for n, b in enumerate(whole))
            self.assertIsNone(link.unpack(changed))
        self.assertIsNone(link.unpack(b"\0\0\0"))


if __name__ == "__main__":
    unittest.main()
