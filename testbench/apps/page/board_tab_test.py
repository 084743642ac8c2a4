#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page's link to a board: its protocol in node against the examples of docs/link.md and a
simulated board; its tab in Debian's Chromium with a port that leads to that board; and the server
that Web Serial needs.

board_tab_test.py --pictures FOLDER keeps a screenshot.
Documentation: docs/page.md
"""

import http.server
import json
import os
import re
import select
import shutil
import socket
import subprocess
import sys
import threading
import time
import tty
import unittest
import urllib.error
import urllib.request

from board_process import need_terminals
from browsing import ROOT, By, PageTest, main, taking
from host_program import BUILD, ProgramTest

sys.path.insert(0, str(ROOT / "scripts"))
import page  # noqa: E402

NODE = shutil.which("node")
# The page's script in node; `port` is what navigator.serial gives, on a terminal.
IN_NODE = """
const fs = require("fs"), tty = require("tty"), vm = require("vm");
vm.runInThisContext(fs.readFileSync(process.argv[1], "utf8") +
  ";globalThis.board = { framed, FrameReader, BoardLink, crc32 };");
const map = JSON.parse(process.argv[2]), hex = (bytes) => Buffer.from(bytes).toString("hex");
const opened = (name, lose = () => false) => {
  const file = fs.openSync(name, fs.constants.O_RDWR | fs.constants.O_NOCTTY), heard = new tty.ReadStream(file);
  heard.setRawMode(true);
  return {
    readable: new ReadableStream({ start: (to) => { heard.on("data", (bytes) => to.enqueue(Uint8Array.from(bytes))); } }),
    writable: new WritableStream({ write: (bytes) => { if (!lose(bytes)) fs.writeSync(file, bytes); } }),
    close: async () => {},
  };
};
(async () => { %s })().then((said) => { console.log(JSON.stringify(said)); process.exit(0); }, (error) => { console.error(error); process.exit(1); });
"""
# A SerialPort of the browser over HTTP.
PORT = """
const to = arguments[0];
window.opened_with = null;
const port = {
  open: async (how) => {
    window.opened_with = how;
    port.readable = new ReadableStream({ pull: async (into) => {
      const bytes = new Uint8Array(await (await fetch(to)).arrayBuffer());
      into.enqueue(bytes);
    } }, { highWaterMark: 0 });
    port.writable = new WritableStream({ write: (bytes) => fetch(to, { method: "POST", body: bytes }) });
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


@unittest.skipUnless(NODE or os.environ.get("CI"), "no node")
class Protocol(BoardTest):
    def node(self, script, *words):
        program = [NODE, "-e", IN_NODE % script, ROOT / "scripts/web_page/board.js"]
        registers = json.dumps(page.registers_of(ROOT))
        done = subprocess.run(
            [*program, registers, *words], capture_output=True, text=True, timeout=100, check=False
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_frames_are_those_of_the_documentation(self):
        text = (ROOT / "docs/link.md").read_text(encoding="utf-8")
        lines = [bytes.fromhex(line) for line in re.findall(r"^[<>] ([0-9a-f ]+)$", text, re.M)]
        self.assertGreater(len(lines), 3)
        whole = b"".join(lines).hex()
        bodies = self.node(
            "const reader = new board.FrameReader(map.link);"
            "const bodies = reader.take(Buffer.from(process.argv[3], 'hex'));"
            "return [bodies.map((b) => hex(board.framed(b, map.link))), reader.bad]",
            whole,
        )
        self.assertEqual(bodies, [[line.hex() for line in lines], 0])
        # Escapes there and back; a changed byte and a wrong escape are counted, the next is read.
        found = self.node(
            "const reader = new board.FrameReader(map.link), body = Uint8Array.from([0xc0, 0xdb, 0xdc, 0xdd]);"
            "const wire = board.framed(body, map.link), bad = Uint8Array.from(wire); bad[1] ^= 1;"
            "const strange = Uint8Array.from([0xc0, 0xdb, 0x01, 0xc0]);"
            "const all = [bad, strange, wire].flatMap((bytes) => reader.take(bytes));"
            "return [hex(wire), all.map(hex), reader.bad]"
        )
        self.assertEqual(found[1:], [["c0dbdcdd"], 2])
        self.assertEqual(found[0][2:-2].count("c0"), 0)

    def test_words_are_read_written_streamed_and_the_motor_arms(self):
        found = self.node(
            """
const streamed = [], port = opened(process.argv[3]), { words, bits, snapshot } = map;
const link = new board.BoardLink(port, map.link, (frame) => streamed.push(frame));
const about = await link.begin(map), bit = (name) => 1 << bits[name];
await link.write(words.watchdog_ticks, 1000000);
const [watchdog] = await link.read(words.watchdog_ticks);
await link.write(words.stream_words, 1 << snapshot.indexOf("position") | 1 << snapshot.indexOf("tick"));
await link.write(words.stream_period, Math.round(about.tick_hz / 100));
await new Promise((after) => setTimeout(after, 400));
await link.write(words.stream_period, 0);
await link.write(words.command, bit("command.kick"));
await link.write(words.control, bit("control.host") | bit("control.arm"));
const armed = [];
for (let n = 0; n < 20 && !armed.includes(true); ++n) armed.push(!!((await link.read(words.status))[0] & bit("status.armed")));
await link.write(words.control, bit("control.host"));
await link.read(words.tick);
const after = (await link.read(words.status))[0] & bit("status.armed");
return { about, watchdog, streamed: streamed.slice(0, 30), armed: armed.includes(true), after, bad: link.frames.bad };
""",
            self.board("--hand", "swing"),
        )
        about = found["about"]
        self.assertEqual((about["identity"], about["version"] >> 16), (0x46454C54, 1))
        self.assertEqual(about["features"] & 1, 1)
        self.assertEqual(found["watchdog"], 1_000_000)
        self.assertEqual((found["armed"], found["after"], found["bad"]), (True, 0, 0))
        frames = found["streamed"]
        self.assertGreater(len(frames), 5)
        period = round(about["tick_hz"] / 100)
        for before, after in zip(frames, frames[1:]):
            missed = (after["number"] - before["number"]) % 256
            self.assertEqual(after["words"], 0b110)
            self.assertEqual((after["values"][1] - before["values"][1]) % 2**32, missed * period)
        self.assertGreater(len({frame["values"][0] for frame in frames}), 2)

    def test_what_is_lost_is_asked_again_and_done_once(self):
        found = self.node(
            """
let sent = 0;
const port = opened(process.argv[3], () => ++sent % 3 === 1), link = new board.BoardLink(port, map.link), { words } = map;
await link.begin(map);
const before = await link.read(words.frames_good);
for (let n = 1; n <= 5; ++n) await link.write(words.watchdog_ticks, 200000 + n);
return [await link.read(words.watchdog_ticks), link.repeats > 2];
""",
            self.board(),
        )
        self.assertEqual(found, [[200_005], True])
        silent = self.node(
            "const link = new board.BoardLink(opened(process.argv[3], () => true), map.link);"
            "return link.begin(map).catch((error) => error.message)",
            self.board(),
        )
        self.assertIn("no answer for 2 s; is the board on", silent)


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

    def press(self, name):
        self.driver.find_element(By.ID, f"board-{name}").click()

    def said(self):
        return self.js("return document.getElementById('board-said').textContent")

    def test_the_page_talks_to_a_board(self):
        bridge = Bridge(self.board("--hand", "swing"))
        self.addCleanup(bridge.close)
        self.js(PORT, f"http://127.0.0.1:{bridge.server.server_port}/")
        self.open_tab("board")
        self.press("connect")
        self.until("return document.getElementById('board-said').textContent.startsWith('SIMULATED')")
        self.assertIn("1000000 ticks a second", self.said())
        self.assertEqual(self.js("return window.opened_with"), {"baudRate": 1_000_000})
        self.until("return feltgate.board.trace.length > 5 && 'tau_ref' in feltgate.board.shown")
        word = self.driver.find_element(By.ID, "board-word")
        value = "return document.getElementById('board-value').value"
        self.press("read")
        self.until(f"{value} === arguments[0]", str(0x46454C54))
        word.clear()
        word.send_keys("watchdog_ticks")
        self.js("document.getElementById('board-value').value = 60000000")
        self.press("write")
        self.until("return document.getElementById('board-said').textContent === 'written'")
        self.press("arm")
        self.press("arm")
        self.until(
            "if (!feltgate.board.armed) document.getElementById('board-read').click();"
            "return feltgate.board.armed"
        )
        self.press("disarm")
        self.until("return !feltgate.board.armed")
        # A disarming or a stop in the same moment as an arming, whose kick is still on its way.
        for last in ("disarm", "stop"):
            self.js(
                "for (const name of ['arm', arguments[0]]) document.getElementById(`board-${name}`).click()",
                last,
            )
            time.sleep(1)
            self.assertFalse(self.js("return feltgate.board.armed"), last)
        word.clear()
        word.send_keys("no word")
        self.press("read")
        self.until("return document.getElementById('board-said').textContent.startsWith('no word is')")
        self.press("connect")
        self.until("return window.port_closed && !feltgate.board.link")


class Server(ProgramTest):
    def start(self, *words):
        environment = self.environment() | {"PYTHONPATH": str(ROOT / "scripts")}
        how = {"env": environment, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
        return self.started(sys.executable, "-B", ROOT / "scripts/page.py", *words, **how)

    def test_the_page_is_served_on_localhost(self):
        said = self.start("--serve", "0").stdout.readline()
        address = re.match(r"(http://localhost:\d+/) until Ctrl-C$", said)[1]
        with urllib.request.urlopen(address) as found:
            self.assertEqual(found.read(), (ROOT / "docs/page.html").read_bytes())
            self.assertIn("text/html", found.headers["Content-Type"])
        for other in ("README.md", "../README.md", "scripts/page.py"):
            with self.assertRaises(urllib.error.HTTPError):
                urllib.request.urlopen(address + other)

    def test_a_port_that_is_taken_is_refused_in_one_line(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            process = self.start("--serve", str(taken.getsockname()[1]))
            said = process.stdout.read()
            self.assertEqual(process.wait(), 2)
        self.assertRegex(said, r"^page: port \d+ of localhost: .*in use.*; name another: --serve 8001\n$")
        self.assertEqual(self.start("--serve", "70000").wait(), 2)


if __name__ == "__main__":
    main(taking({"board": "document.getElementById('tab-board').click()"}))
