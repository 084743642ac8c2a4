#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Talks to feltgate over its link, with pyserial alone: link.py PORT [BAUD]. docs/link.md"""

import struct
import sys
import zlib

END, ESCAPE = b"\xc0", b"\xdb"
READ, WRITE, REPLY = 1, 2, 0x80


def pack(body):
    body += struct.pack("<I", zlib.crc32(body))
    return END + body.replace(ESCAPE, b"\xdb\xdd").replace(END, b"\xdb\xdc") + END


def unpack(raw):
    """What is between two ENDs, without its CRC; None where that does not hold."""
    body = raw.replace(b"\xdb\xdc", END).replace(b"\xdb\xdd", ESCAPE)
    good = len(body) > 4 and struct.unpack("<I", body[-4:])[0] == zlib.crc32(body[:-4])
    return body[:-4] if good else None


class Link:
    def __init__(self, port):
        self.port = port  # a serial.Serial with a time-out
        self.sequence = 0
        self.sequence = (self.read(0x1008)[0] + 1) & 0xFF  # not that of the last write

    def ask(self, kind, address, value):
        """The words of the reply; the same request again where none comes."""
        self.sequence = (self.sequence + 1) & 0xFF
        head = struct.pack("<BBH", kind | REPLY, self.sequence, address)
        for _ in range(4):
            self.port.write(pack(struct.pack("<BBHI", kind, self.sequence, address, value)))
            while raw := self.port.read_until(END):
                body = unpack(raw.rstrip(END)) or b""
                if body[:4] == head:  # not a frame of the stream, nor a late reply
                    return struct.unpack(f"<{len(body[4:]) // 4}I", body[4:])
        raise TimeoutError(f"no reply from 0x{address:04x}")

    def read(self, address, words=1):
        return self.ask(READ, address, words)

    def write(self, address, value):
        return self.ask(WRITE, address, value)[0]  # the status word


if __name__ == "__main__":
    import serial

    link = Link(serial.Serial(sys.argv[1], int((sys.argv + ["1000000"])[2]), timeout=0.2))
    identity, version, crc, clock_hz, clocks_per_tick = link.read(0x1000, 5)
    print(f"{struct.pack('<I', identity)} design {crc:08x}, {clock_hz / clocks_per_tick:.0f} ticks/s")
    print(f"status after set_zero: {link.write(0x201, 1):#010x}")
