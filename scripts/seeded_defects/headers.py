# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""C++ files that hold the statements of all patches; one patch is chosen at run time."""

import difflib
import re

from .patches import NONE, ROOT, patched


def regions(old, new):
    """What differs, as (start, end, lines) of `old`, which are whole statements."""
    found = []
    matcher = difflib.SequenceMatcher(None, old, new, autojunk=False)
    for kind, i1, i2, j1, j2 in matcher.get_opcodes():
        if kind == "equal":
            continue
        start, end = i1, i2
        while start > 0 and not re.search(r"([;{}:]|//.*|^\s*)$", old[start - 1]):
            start -= 1
        text = old[start:i1] + new[j1:j2]
        while end < len(old) and not whole(text + old[i2:end]):
            end += 1
        while end < len(old) and end > start and not whole(old[start:end]):
            end += 1
        found.append((start, end, i1, i2, new[j1:j2]))
    return found


def whole(lines):
    """Do these lines end with a statement, and close what they open?"""
    text = re.sub(r"//.*", "", "\n".join(lines)).strip()
    balanced = all(text.count(a) == text.count(b) for a, b in ("()", "{}", "[]"))
    return not text or (balanced and text[-1] in ";}")


def with_choice(old, changed):
    """C++ lines that hold those of `old` and of {number: lines}, chosen when they are executed."""
    parts = {number: regions(old, new) for number, new in changed.items()}
    spans = []
    for start, end in sorted((r[0], r[1]) for rs in parts.values() for r in rs):
        if spans and start < spans[-1][1]:
            spans[-1][1] = max(end, spans[-1][1])
        elif not spans or [start, end] != spans[-1]:
            spans.append([start, end])
    out, at = [], 0
    for start, end in spans:
        out += old[at:start]
        for number, its in parts.items():
            # An insertion where a span ends is not part of it.
            inside = [r for r in its if start <= r[0] <= r[1] <= end]
            inside = [r for r in inside if r[0] < end or start == end]
            if inside:
                text, k = [], start
                for _, _, i1, i2, lines in inside:
                    text += old[k:i1] + lines
                    k = i2
                out += [f"if (feltgate_seeded::is({number})) {{", *text, *old[k:end], "} else"]
        out += ["{", *old[start:end], "}"]
        at = end
    return out + old[at:]


CHOICE = """#pragma once
extern "C" int feltgate_chosen_defect(const char* names);
namespace feltgate_seeded {{
inline const int chosen = feltgate_chosen_defect("{names}");
/// A constant expression is that of the product.
constexpr bool is(int number) {{ return !__builtin_is_constant_evaluated() && chosen == number; }}
}}
"""


def write_headers(patches, output, root=ROOT):
    """Writes the changed files, each with every patch's statements, beside links to all others."""
    for header in root.glob("model/**/*.hpp"):
        link = output / header.relative_to(root)
        link.parent.mkdir(parents=True, exist_ok=True)
        link.unlink(missing_ok=True)
        link.symlink_to(header)
    changes = {patch.name: patched(patch, root) for patch in patches}
    choice = output / "seeded_choice.hpp"
    choice.parent.mkdir(parents=True, exist_ok=True)
    choice.write_text(CHOICE.format(names=" ".join([NONE, *changes])), encoding="utf-8")
    for path in sorted({path for change in changes.values() for path in change}):
        changed = {
            number: change[path].splitlines()
            for number, change in enumerate(changes.values(), 1)
            if path in change
        }
        lines = with_choice((root / path).read_text(encoding="utf-8").splitlines(), changed)
        (output / path).unlink(missing_ok=True)
        text = "\n".join([f'#include "{choice.resolve()}"', *lines, ""])
        (output / path).write_text(text, encoding="utf-8")
