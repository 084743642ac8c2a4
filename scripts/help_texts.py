#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""scripts/help.txt: what --help prints, so that ./feltgate can print it before anything is built.

  ninja -C build feltgate feltgate_generate feltgate_bench feltgate_extremes \\
    feltgate_host feltgate_board feltgate_touch && scripts/help_texts.py --write
"""

import argparse
import difflib
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "scripts/help.txt"
HEAD = """# What --help prints of each command and verb; ./feltgate prints these texts before anything is built.
# Written by scripts/help_texts.py --write.
"""
# Layout differs between versions of argparse and CLI11; the committed texts are Debian 12's.
EXACT = (3, 11)
WIDTH = "100"
# As the launcher: Debian's goes before another, it has the modules.
PYTHON = "/usr/bin/python3" if os.access("/usr/bin/python3", os.X_OK) else sys.executable

sys.path.insert(0, str(ROOT / "scripts"))


def subcommands():
    """{name: how it starts}, as the launcher lists them."""
    table = (ROOT / "scripts/commands.txt").read_text(encoding="utf-8")
    return dict(re.findall(r"^([a-z]+)\|[^|]*\|[^|]*\|(\w+)\|", table, re.M))


def host_verbs():
    """As their table lists them."""
    table = (ROOT / "model/apps/commands/host_main.cpp").read_text(encoding="utf-8")
    return re.findall(r'^ +\{"([a-z]+)", "', table, re.M)


def commands(build):
    """{name of the text: command that prints it}."""
    from explore import VERBS

    own = {
        # Not by the launcher: that prints the text which this compares.
        "test": ["bash", "-c", 'source "$0"; tests_usage', ROOT / "scripts/run_tests.sh"],
        "generate": [build / "feltgate_generate", ROOT],
        "touch": [build / "feltgate_touch", "touch"],
    }
    found = {}
    for name, how in subcommands().items():
        ways = {"program": [build / "feltgate", name], "own": [build / f"feltgate_{name}"]}
        found[name] = own.get(name) or ways.get(how) or [PYTHON, "-B", ROOT / f"scripts/{name}.py"]
    for verb in host_verbs():
        found[f"host {verb}"] = [*found["host"], "PORT", verb]
    for verb in VERBS:
        found[f"explore {verb}"] = [build / "feltgate", "explore", verb]
    return found


def text_of(command):
    kept = {k: v for k, v in os.environ.items() if not k.startswith("FELTGATE_")}
    more = {"COLUMNS": WIDTH, "LC_ALL": "C.UTF-8", "FELTGATE_PYTHON": PYTHON}
    done = subprocess.run(
        [*map(str, command), "--help"],
        env=kept | more,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode or not done.stdout.strip():
        said = (done.stderr.strip() or "nothing").splitlines()[-1]
        raise ValueError(f"{' '.join(map(str, command))} --help: status {done.returncode}, {said}")
    return done.stdout


def words(text):
    """What is said, whatever the layout."""
    return {word.casefold() for word in re.findall(r"[\w.-]*\w", text)}


def same(committed, now, exact):
    return committed == now if exact else words(committed) == words(now)


def committed(page=PAGE):
    """{name of the text: text} of a page."""
    return {name: "".join(lines) for name, _, lines in lines_of(page)}


def lines_of(page=PAGE):
    """(name, number of the first line, lines with their ends) of each text of a page."""
    name, found = None, None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(True), 1):
        if line.startswith("```"):
            if found:
                yield found
            found = None if found else (name, number + 1, [])
        elif found:
            found[2].append(line)
        elif line.startswith("## "):
            name = line[3:].strip()


def page_of(texts):
    blocks = (f"\n## {name}\n\n```text\n{texts[name]}```\n" for name in sorted(texts))
    return HEAD + "".join(blocks)


def stale(page, texts, exact):
    """Complaints, one line each and the lines that differ."""
    there = committed(page)
    for name, now in texts.items():
        if not same(there.get(name, ""), now, exact):
            yield f"{page.name}, {name}: stale; scripts/help_texts.py --write"
            both = there.get(name, "").splitlines(), now.splitlines()
            yield from difflib.unified_diff(*both, "committed", "now", lineterm="", n=0)
    for name in there.keys() - texts.keys():
        yield f"{page.name}, {name}: there is no such command; scripts/help_texts.py --write"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="build folder")
    parser.add_argument("--write", action="store_true", help="write; without it: check")
    options = parser.parse_args()
    texts, wrong = {}, []
    for name, command in commands(options.build).items():
        try:
            texts[name] = text_of(command)
        except (OSError, ValueError) as error:
            wrong.append(str(error))
    if options.write:
        if not wrong:
            PAGE.write_text(page_of(texts), encoding="utf-8")
    elif not wrong:
        wrong += stale(PAGE, texts, sys.version_info[:2] == EXACT)
    print("\n".join(wrong) or f"{len(texts)} texts in {PAGE}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
