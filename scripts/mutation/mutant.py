# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A mutant of the RTL in words: what is changed, and in which lines."""

from pathlib import Path

from command_line import Refused

MODES = {
    "inv": "inverted",
    "const0": "stuck at 0",
    "const1": "stuck at 1",
    "cnot0": "inverted while another bit of the pin is 0",
    "cnot1": "inverted while another bit of the pin is 1",
}


class MutateError(Refused):
    """What is missing or wrong, for the user."""


def place(root, source):
    """rtl/x.sv:12.3-14.9 as (file, first line, its text)."""
    path, _, span = source.rpartition(":")
    line = int(span.split(".")[0])
    full = Path(root, path)
    lines = full.read_text(encoding="utf-8").splitlines() if full.exists() else []
    return path, line, lines[line - 1].strip() if 0 < line <= len(lines) else ""


def pin(mutant):
    return f"{mutant['type']}.{mutant['port']}"


def says(mutant):
    """One line."""
    register = (
        f" of {mutant['register']}"
        if mutant["port"] not in ("D", "Q") and "register" in mutant
        else ""
    )
    wire = f"{register}, {mutant['wire']}[{mutant['wire_bit']}]" if "wire" in mutant else register
    by = f" ({mutant['by_bit']})" if "by_bit" in mutant else ""
    mode = MODES.get(mutant["mode"], mutant["mode"])
    return f"bit {mutant['bit']} of {pin(mutant)}{wire} {mode}{by}"


def where(root, mutant):
    """The source lines, most precise first."""
    found = sorted({place(root, source) for source in mutant["sources"]})
    return [f"{path}:{line}: {text}" for path, line, text in found]
