# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Meanings of words on the pages, shown when the pointer rests on one.

The only source is the table of docs/glossary.md. Documentation: docs/figures.md
"""

import re
from functools import lru_cache
from html import escape
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2] / "docs" / "glossary.md"
# Plain words too, which would underline half of every sentence.
PLAIN = frozenset({"clock", "count", "counts", "design", "fixed", "float", "hand", "position"})


@lru_cache
def meanings():
    """{term: meaning} of the table; none where the file is missing, for a page does without."""
    try:
        text = SOURCE.read_text(encoding="utf-8")
    except OSError:
        return {}
    rows = re.findall(r"^\| *(.+?) *\| *(.+?) *\|$", text, re.M)
    return {term: meaning for terms, meaning in rows[2:] for term in terms.split(", ")}


@lru_cache
def pattern():
    """Any term as a whole word, the longest first; a first letter may be a capital."""
    terms = sorted((t for t in meanings() if t not in PLAIN), key=len, reverse=True)
    either = "|".join(
        f"[{t[0]}{t[0].upper()}]{re.escape(t[1:])}" if t[0].islower() else re.escape(t)
        for t in terms
    )
    return re.compile(rf"(?<![\w.-])(?:{either})(?![\w-])") if terms else re.compile(r"(?!)")


def meaning(word):
    known = meanings()
    return known.get(word) or known[word[:1].lower() + word[1:]]


def marked(text, seen=None):
    """Text as markup, each term with its meaning the first time. `seen` keeps the meanings that
    need no repetition from one text to the next."""
    seen, parts, end = set() if seen is None else seen, [], 0
    for found in pattern().finditer(text):
        told = meaning(found[0])
        if told in seen:
            continue
        seen.add(told)
        parts.append(escape(text[end : found.start()]))
        parts.append(f'<abbr title="{escape(told, quote=True)}">{escape(found[0])}</abbr>')
        end = found.end()
    return "".join(parts) + escape(text[end:])


def used(markup):
    """[(word, meaning)] of what a page's markup explains, in the order of the alphabet."""
    found = re.findall(r'<abbr title="([^"]*)">([^<]*)</abbr>', markup)
    words = {
        told: word[:1].lower() + word[1:] if word[1:].islower() else word for told, word in found
    }
    return sorted(((word, told) for told, word in words.items()), key=lambda pair: pair[0].lower())


def section(markup):
    """All the words that a page explains, folded: for a phone and for print. Already markup."""
    words = used(markup)
    if not words:
        return ""
    rows = "".join(f"<dt>{word}</dt><dd>{told}</dd>" for word, told in words)
    return (
        '<section id="words"><details><summary>Words on this page</summary>'
        f"<dl>{rows}</dl></details></section>"
    )
