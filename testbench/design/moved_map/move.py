#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A test-only root for feltgate_generate, in which words have other slots than in the shipped map.

  move.py ROOT FOLDER WORD=SLOT... [product:NAME=SLOT] [read:WORD=SLOT] [step:NAME=CLOCK]
          [wave=CLOCKS]

FOLDER/rtl/registers.toml and schedule.toml are those of ROOT with other slots for these parameters,
squares and snapshot words, other clocks for steps that follow nothing, and another length of the
wave. all+=CLOCKS moves every word and square that is not named. The caller puts designs beside
them.
"""

import re
import shutil
import sys
from pathlib import Path


def moved(text, section, name, key, value):
    """The text with another value for a key of the entry [[section]] with this name."""
    pattern = rf'(\[\[{section}\]\]\nname = "{name}"\n(?:[^\[\n][^\n]*\n)*?{key} = )\d+'
    text, count = re.subn(pattern, rf"\g<1>{value}", text)
    if count != 1:
        raise SystemExit(f"{section} {name} has no {key} of its own")
    return text


def main():
    root, folder = Path(sys.argv[1]), Path(sys.argv[2])
    registers = (root / "rtl/registers.toml").read_text(encoding="utf-8")
    schedule = (root / "rtl/schedule.toml").read_text(encoding="utf-8")
    moves = [move.split("=") for move in sys.argv[3:]]
    for later in [int(slot) for name, slot in moves if name == "all+"]:
        registers = re.sub(
            r"(\[\[(?:parameter|snapshot)\]\]\n(?:[^\[\n][^\n]*\n)*?slot = )(\d+)",
            lambda found: f"{found[1]}{int(found[2]) + later}",
            registers,
        )
        schedule = re.sub(
            r"(?<=\nslot = )\d+", lambda found: str(int(found[0]) + later), schedule
        )
    for name, slot in moves:
        kind, _, word = name.rpartition(":")
        if name == "wave":
            schedule = re.sub(r"(\[wave\]\nclocks = )\d+", rf"\g<1>{slot}", schedule)
        elif kind == "product":
            schedule = moved(schedule, "product", word, "slot", slot)
        elif kind == "step":
            schedule = moved(schedule, "step", word, "clock", slot)
        elif name == "all+":
            continue
        elif kind == "read":
            registers = moved(registers, "snapshot", word, "slot", slot)
        else:
            registers = moved(registers, "parameter", word, "slot", slot)
    (folder / "rtl/designs").mkdir(parents=True, exist_ok=True)
    shutil.copytree(root / "rtl/engine", folder / "rtl/engine")
    (folder / "rtl/registers.toml").write_text(registers, encoding="utf-8")
    (folder / "rtl/schedule.toml").write_text(schedule, encoding="utf-8")


if __name__ == "__main__":
    main()
