# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A counter-example as text: the last clocks of a VCD, for the wrapper's signals that matter."""

import re

CLOCKS = 4
WIDEST = 14


def read(text):
    """{signal of the top: [value of each step]}, as unsigned integers, with their widths."""
    names, depth = {}, 0
    head, _, body = text.partition("$enddefinitions")
    for line in head.splitlines():
        if line.startswith("$scope"):
            depth += 1
        elif line.startswith("$upscope"):
            depth -= 1
        elif line.startswith("$var") and depth == 1:
            _, _, width, code, name = line.split()[:5]
            names[code] = (name, int(width))
    values, now, steps = {}, {}, 0
    for line in body.splitlines():
        if re.fullmatch(r"#\d*0", line):
            steps += 1
            for code in now:
                values.setdefault(code, [0] * (steps - 1)).append(now[code])
        match = re.fullmatch(r"b([01xz]+) (\S+)", line)
        if match and match.group(2) in names:
            code, value = match.group(2), int(re.sub("[xz]", "0", match.group(1)), 2)
            now[code] = value
            if steps:
                row = values.setdefault(code, [0] * steps)
                row[steps - 1] = value
    return {names[c]: v for c, v in values.items()}


def table(signals, show):
    """(last step, text): a column for each of the last clocks, the failing one last."""
    chosen = {n: (w, v) for (n, w), v in sorted(signals.items()) if not show or n in show}
    chosen = {n: chosen[n] for n in (show or chosen) if n in chosen}
    chosen.pop("clk_i", None)
    if not signals:
        return 0, ""
    last = max(len(v) for v in signals.values()) - 2  # the last time stamp ends the last clock
    first = max(0, last - CLOCKS + 1)
    lines = ["    clock".ljust(28) + "".join(f"{n:>{WIDEST}}" for n in range(first, last + 1))]
    for name, (width, row) in chosen.items():
        shown = [value_text(value, width) for value in row[first : last + 1]]
        lines.append(f"    {name}".ljust(28) + "".join(f"{text:>{WIDEST}}" for text in shown))
    return last, "\n".join(lines)


def value_text(value, width):
    """Decimal where it is a small one, also as a signed number; else hexadecimal."""
    if width == 1:
        return str(value)
    if width > 40:
        return f"{value:x}"[-WIDEST + 2 :].rjust(1, "0")
    signed = value - (1 << width) if value >> (width - 1) else value
    return str(signed)
