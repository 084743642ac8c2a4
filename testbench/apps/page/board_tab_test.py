#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's link to a board in Debian's Chromium: its frames against the examples of
docs/link.md; its tab with a port that leads to a simulated board; the server that Web Serial needs.

Documentation: docs/page.md
"""

import http.server
import os
import re
import select
import subprocess
import sys
import threading
import time
import tty
import unittest
import urllib.request

from board_process import need_terminals
from browsing import ROOT, PageTest
from host_program import ProgramTest


# A SerialPort of the browser over HTTP, which loses one of so many writes.
PORT = """
const [to, lost] = arguments;
let writes = 0;
window.opened_with = null;
const port = {
  open: async (how) => {
    window.opened_with = how;
    port.readable = new ReadableStream({ pull: async (into) => {
      const bytes = new Uint8Array(await (await fetch(to)).arrayBuffer());
      into.enqueue(bytes);
    } }, { highWaterMark: 0 });
    port.writable = new WritableStream({ write: (bytes) => ++writes % lost ? fetch(to, { method: "POST", body: bytes }) : null });
  },
  close: async () => { window.port_closed = true; },
};
Object.defineProperty(navigator, "serial", { configurable: true, value: { requestPort: async () => port } });
"""


class BoardTest(ProgramTest):
    def board(self, *words):
        """The terminal of a simulated board; the test's end ends it."""
        need_terminals()
        process = self.start_program("feltgate_board", *words, stderr=subprocess.STDOUT)
        return process.stdout.readline().strip()


class Bridge:
    """A terminal over HTTP: GET waits for bytes of it, POST writes to it."""

    def __init__(self, terminal):
        self.file = os.open(terminal, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.file)
        bridge = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def answer(self, data=b""):
                self.send_response(200)
                self.send_header("Access-Control-Allow-Origin", "*")
                self.send_header("Content-Length", str(len(data)))
                self.end_headers()
                self.wfile.write(data)

            def do_GET(self):  # noqa: N802
                ready, _, _ = select.select([bridge.file], [], [], 0.2)
                self.answer(os.read(bridge.file, 4096) if ready else b"")

            def do_POST(self):  # noqa: N802
                os.write(bridge.file, self.rfile.read(int(self.headers["Content-Length"])))
                self.answer()

            def log_message(self, *_):
                """Nothing."""

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def close(self):
        self.server.shutdown()
        self.server.server_close()
        os.close(self.file)


class Tab(PageTest, BoardTest):
    def setUp(self):
        BoardTest.setUp(self)
        PageTest.setUp(self)

    def said(self, words):
        self.until("return document.getElementById('board-said').textContent.startsWith(arguments[0])", words)

    def test_the_page_talks_to_a_board(self):
        bridge = Bridge(self.board("--hand", "swing"))
        self.addCleanup(bridge.close)
        self.js(PORT, f"http://127.0.0.1:{bridge.server.server_port}/", 5)
        self.open_tab("board")
        self.click("#board-connect")
        self.said("SIMULATED")
        self.assertIn("1000000 ticks a second", self.text("#board-said"))
        self.assertEqual(self.js("return window.opened_with"), {"baudRate": 1_000_000})
        # A hundred frames a second, whose positions move.
        streamed = "feltgate.board.trace.map(([position]) => position)"
        self.until(f"return new Set({streamed}).size > 2 && 'tau_ref' in feltgate.board.shown")
        ticks = [self.js("return feltgate.board.shown.tick") for _ in range(20)]
        self.assertEqual({(after - before) % 10_000 for before, after in zip(ticks, ticks[1:])}, {0})
        value = "document.getElementById('board-value').value"
        self.click("#board-read")
        self.until(f"return {value} === arguments[0]", str(0x46454C54))
        self.turn("#board-word", "watchdog_ticks")
        self.turn("#board-value", 60_000_000)
        self.click("#board-write")
        self.said("written")
        self.turn("#board-value", "")
        self.click("#board-read")
        self.until(f"return {value} === '60000000'")
        self.click("#board-arm")
        self.click("#board-arm")
        self.until(
            "if (!feltgate.board.armed) document.getElementById('board-read').click();"
            "return feltgate.board.armed"
        )
        self.click("#board-disarm")
        self.until("return !feltgate.board.armed")
        # A disarming or a stop in the same moment as an arming, whose kick is still on its way.
        for last in ("disarm", "stop"):
            self.js(
                "for (const name of ['arm', arguments[0]]) document.getElementById(`board-${name}`).click()",
                last,
            )
            time.sleep(1)
            self.assertFalse(self.js("return feltgate.board.armed"), last)
        self.turn("#board-word", "no word")
        self.click("#board-read")
        self.said("no word is")
        self.assertGreater(self.js("return feltgate.board.link.repeats"), 0)  # asked again, done once
        self.click("#board-connect")
        self.until("return window.port_closed && !feltgate.board.link")

    def test_frames_are_those_of_the_documentation(self):
        text = (ROOT / "docs/link.md").read_text(encoding="utf-8")
        lines = [bytes.fromhex(line) for line in re.findall(r"^[<>] ([0-9a-f ]+)$", text, re.M)]
        self.assertGreater(len(lines), 3)
        self.open_tab("board")
        read = (
            "const link = feltgate.board.map.link, reader = new FrameReader(link);"
            "const bodies = reader.take(Uint8Array.from(arguments[0])).map((body) => [...body]);"
            "return [bodies, bodies.map((b) => [...framed(Uint8Array.from(b), link)]), reader.bad]"
        )
        _, again, bad = self.js(read, list(b"".join(lines)))
        self.assertEqual(([bytes(frame) for frame in again], bad), (lines, 0))
        # Escapes there and back; a changed byte and a wrong escape are counted, the next is read.
        body = [0xC0, 0xDB, 0xDC, 0xDD]
        wire = self.js("return [...framed(Uint8Array.from(arguments[0]), feltgate.board.map.link)]", body)
        self.assertNotIn(0xC0, wire[1:-1])
        changed = [wire[0], wire[1] ^ 1, *wire[2:]]
        bodies, _, bad = self.js(read, [*changed, 0xC0, 0xDB, 0x01, 0xC0, *wire])
        self.assertEqual((bodies, bad), ([body], 2))


class Server(ProgramTest):
    def start(self, *words):
        environment = self.environment() | {"PYTHONPATH": str(ROOT / "scripts")}
        how = {"env": environment, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
        return self.started(sys.executable, "-B", ROOT / "scripts/page.py", *words, **how)

    def test_the_page_is_served_on_localhost(self):
        said = self.start("--serve", "0").stdout.readline()
        address = re.match(r"(http://localhost:(\d+)/page.html) until Ctrl-C$", said)
        with urllib.request.urlopen(address[1]) as found:
            self.assertEqual(found.read(), (ROOT / "docs/page.html").read_bytes())
        process = self.start("--serve", address[2])
        said = process.stdout.read()
        self.assertRegex(said, r"^page: port \d+ of localhost: .*in use.*; name another: --serve 8001\n$")
        self.assertEqual(process.wait(), 2)


if __name__ == "__main__":
    unittest.main()
