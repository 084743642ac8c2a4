# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Every page of documentation, taken apart into prose and code."""

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
FENCE = re.compile(r"^ {0,3}```\s*(\S*)")
SPAN = re.compile(r"(?<!`)`([^`]+)`(?!`)")


@dataclass(frozen=True)
class Code:
    """A line of a fenced block, or an inline span with its line breaks as blanks."""

    page: Path  # relative to the root
    line: int
    text: str
    language: str  # of a fenced block, may be ""; None: inline

    def __str__(self):
        return f"{self.page}:{self.line}: {self.text}"


def pages(root=ROOT):
    """Paths of every page, relative to the root."""
    found = set(root.glob("*.md"))
    for folder in ("docs", "vectors", "rtl"):
        found |= set(root.glob(f"{folder}/**/*.md"))
    return sorted(path.relative_to(root) for path in found)


def parts(page, root=ROOT):
    """(code, prose): fenced lines and inline spans as Code; prose with both blanked out, a line
    for each line of the page."""
    code, prose, language, paragraph = [], [], None, []
    for number, line in enumerate((root / page).read_text(encoding="utf-8").splitlines(), 1):
        fence = FENCE.match(line)
        inside = language is not None
        if fence:
            language = None if inside else fence[1]
        elif inside:
            code.append(Code(page, number, line, language))
        prose.append("" if fence or inside else line)
        if fence or inside or not line.strip() or line.startswith("|"):
            code += spans(page, paragraph, prose)
            paragraph = []
        if not fence and not inside and line.strip():
            paragraph.append(number)
            if line.startswith("|"):
                code += spans(page, paragraph, prose)
                paragraph = []
    code += spans(page, paragraph, prose)
    return code, prose


def spans(page, numbers, prose):
    """The inline code of a paragraph, which may run over its line ends; blanked in `prose`."""
    if not numbers:
        return []
    text, found = "\n".join(prose[n - 1] for n in numbers), []
    for match in SPAN.finditer(text):
        line = numbers[0] + text.count("\n", 0, match.start())
        found.append(Code(page, line, " ".join(match[1].split()), None))
    blank = SPAN.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)
    for n, line in zip(numbers, blank.split("\n"), strict=True):
        prose[n - 1] = line
    return found
