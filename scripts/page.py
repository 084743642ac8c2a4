#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Writes one HTML file in which the twin runs: devices to feel with a mouse, without a network.

Documentation: docs/page.md
"""

import base64
import functools
import gzip
import hashlib
import http.server
import json
import os
import re
import sys
import tempfile
import tomllib
from pathlib import Path

import command_line
import interrupts
import outputs
from web_page.compile import CompileError, compile_core
from reports.progress import Steps

EPILOG = """examples:
  feltgate page                           page.html: lever, paper and fast; open it in a browser
  feltgate page --design mine -o my.html  the page with rtl/designs/mine.toml first
  feltgate page --update                  docs/page.html anew, after a change of twin or page
  feltgate page --check                   is docs/page.html of this tree?
  feltgate page --serve                   http://localhost:8000/page.html, for Web Serial

It compiles for a minute or two. Exit code: 0 written or current, 1 --check found the page stale,
2 a design or a tool cannot be used."""
DESIGNS = ("lever", "paper", "fast", "lever_law", "gimbal_motor")
LEVER_SCRIPTS = ("core.js", "drawing.js", "objects.js", "device.js", "inside.js", "law.js")
PENS = ("pen.js", "game.js", "stylus.js", "mesh.js")
TABS = (*PENS, "drums.js", "materials.js", "coupled.js", "string.js", "gimbal.js", "knob.js", "board.js")
SCRIPTS = (*LEVER_SCRIPTS, *TABS, "address.js", "page.js")
COMMITTED = "docs/page.html"
STAMP = re.compile(r'<meta name="feltgate-sources" content="(\w+)">')


class PageError(command_line.Refused):
    """The page cannot be made; the message is for the user."""


def arguments_of(argv):
    parser = command_line.parser("page", __doc__.splitlines()[0], EPILOG)
    what = "a design of rtl/designs that the page shall have besides, first; may be repeated"
    parser.add_argument("--design", action="append", metavar="DESIGN", help=what)
    output = {"default": Path("page.html"), "what": "default page.html"}
    command_line.add_path(parser, "-o", "--output", **output)
    command_line.add_flags(
        parser,
        update=f"write {COMMITTED}",
        check=f"compare {COMMITTED} with this tree; compiles nothing",
    )
    what = f"serve {COMMITTED} on localhost at this port until Ctrl-C; 0: a free one; default: 8000"
    add = {"type": command_line.whole(0), "nargs": "?", "const": 8000, "metavar": "PORT"}
    parser.add_argument("--serve", help=what, **add)
    options = parser.parse_args(argv)
    outputs.check(parser, output=options.output)
    return options


def packed(data):
    """For a script element: gzip without a time, base64."""
    return base64.b64encode(gzip.compress(data, 9, mtime=0)).decode()


def unpacked(page, name):
    """What packed() put into the script element `name` of a page."""
    found = re.search(rf'<script id="{name}"[^>]*>([^<]*)</script>', page)
    return gzip.decompress(base64.b64decode(found[1])) if found else b""


def stamp_of(root):
    """Hash of what the page says and how it calls the core; the core's bits have their own."""
    digest = hashlib.sha256()
    paths = sorted((root / "scripts/web_page").glob("*.*"))
    paths += sorted((root / "model/apps/page").glob("*"))
    for path in paths:
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


def numbers_of(root, designs):
    """What the native programs found: recorded inputs with their hashes, and closed loops."""
    program = os.environ.get("FELTGATE_PAGE_DATA", str(root / "build/feltgate_page_data"))
    if not Path(program).is_file():
        raise PageError("the native twin is not built; run this as ./feltgate page")
    done = interrupts.run([program, *designs], **interrupts.CAPTURED)
    if done.returncode:
        raise PageError(done.stderr.strip())
    project = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    version = re.search(r"VERSION (\d+\.\d+\.\d+)", project)[1]
    ours = {"laws": laws_of(root), "registers": registers_of(root), "version": version}
    return {**json.loads(done.stdout), **ours}


def laws_of(root):
    """The shipped laws that a lever can render: name to text."""
    texts = {path.stem: path.read_text(encoding="utf-8") for path in root.glob("rtl/laws/*.law")}
    return {name: text for name, text in sorted(texts.items()) if "[1]" not in text}


def registers_of(root):
    """What the page needs of the map to talk to a board: addresses of words, numbers of bits."""
    table = tomllib.loads((root / "rtl/registers.toml").read_text(encoding="utf-8"))
    rows = (root / "rtl/generated/lever/csr.csv").read_text(encoding="utf-8")
    bytes_of = re.findall(r"^csr_register,feltgate_(?:link_)?(\w+),(\w+)", rows, re.M)
    words = {name: int(address, 16) // 4 for name, address in bytes_of}
    every = table["control"] + table["snapshot"] + table["link_word"]
    return {
        "words": words,
        "bits": {f"{w['name']}.{f['name']}": f["bit"] for w in every for f in w.get("fields", ())},
        "snapshot": sorted((word["name"] for word in table["snapshot"]), key=words.get),
        "scenes": {scene["name"]: scene["number"] for scene in table["scene"]},
        "link": {constant["name"]: constant["value"] for constant in table["link_constant"]},
    }


def served(folder, port):
    """Serves docs/ to this computer alone. Web Serial needs more than file://."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=folder)
    try:
        server = http.server.ThreadingHTTPServer(("127.0.0.1", port), handler)
    except (OSError, OverflowError) as error:
        raise PageError(f"port {port} of localhost: {error}; name another: --serve 8001") from None
    with server:
        print(f"http://localhost:{server.server_port}/page.html until Ctrl-C", file=sys.stderr, flush=True)
        server.serve_forever()


def assembled(root, numbers, script, wasm):
    folder = root / "scripts/web_page"
    read = lambda name: (folder / name).read_text(encoding="utf-8")  # noqa: E731
    parts = {
        "page.css": read("page.css"),
        "numbers": packed(json.dumps(numbers).encode()),
        "engine": packed(script),
        "wasm": packed(wasm),
        "scripts": "\n".join(read(name) for name in SCRIPTS),
    }
    text = re.sub(r"/\*\{([\w.]+)\}\*/", lambda match: parts[match[1]], read("page.html"))
    stamp = f'<meta name="feltgate-sources" content="{stamp_of(root)}">'
    return text.replace("<title>", f"{stamp}\n<title>", 1)


def stale(root):
    """Why docs/page.html is not of this tree; nothing when it is."""
    path = root / COMMITTED
    if not path.is_file():
        return f"{COMMITTED} is not there"
    page = path.read_text(encoding="utf-8")
    found = STAMP.search(page)
    if not found or found[1] != stamp_of(root):
        return "scripts/web_page or model/apps/page has changed since"
    if json.loads(unpacked(page, "numbers")) != numbers_of(root, DESIGNS):
        return "the core's bits, or a scene, have changed since"
    return ""


def checked_designs(root, wished):
    designs = list(dict.fromkeys([*(wished or []), *DESIGNS]))
    for design in designs:
        path = root / f"rtl/designs/{design}.toml"
        if not path.is_file():
            raise PageError(
                f'design "{design}" is not in rtl/designs; put your file there'
            )
    return designs


def page_of(root, designs):
    numbers = numbers_of(root, designs)
    with tempfile.TemporaryDirectory(prefix="feltgate-page-") as folder, Steps(
        "compiling", None
    ) as steps:

        def progress(done, total):
            steps.total = total
            steps.step("the core", done)

        script, wasm = compile_core(root, designs, Path(folder), progress)
    return assembled(root, numbers, script, wasm)


def run(options):
    """The exit code."""
    root = command_line.root()
    if options.serve is not None:
        path = root / COMMITTED
        if not path.is_file():
            raise PageError(f"{COMMITTED} is not there; write it with feltgate page --update")
        served(path.parent, options.serve)
        return 0
    if options.check:
        if why := stale(root):
            print(f"page: {COMMITTED} is stale: {why}; run feltgate page --update", file=sys.stderr)
            return 1
        print(f"{COMMITTED} is of this tree", file=sys.stderr)
        return 0
    target = root / COMMITTED if options.update else options.output
    text = page_of(root, checked_designs(root, options.design))
    outputs.write_whole(target, text)
    print(f"wrote {target}, {len(text) / 1e6:.1f} MB; open it in a browser", file=sys.stderr)
    return 0


def main(argv=None):
    options = arguments_of(argv)
    return command_line.ended("page", lambda: run(options), CompileError)


if __name__ == "__main__":
    sys.exit(main())
