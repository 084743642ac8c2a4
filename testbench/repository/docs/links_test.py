#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The pages hang together: links, anchors and paths lead to something, every page is reached from
docs/index.md, and a few phrases that no page needs stay out."""

import os
import re
import sys
import unittest
from pathlib import Path

import pages
from testing import Scratch

LINK = re.compile(r"\]\(([^)\s]+)\)")
PATH = re.compile(r"^(?:rtl|model|testbench|scripts|vectors|docs|\.ci)/[\w./+-]+$")
# Files that a page tells the reader to make, and words in capitals that stand for a name.
TO_BE_MADE = re.compile(r"[A-Z]{3,}|/foo\b|detent|/mine\.")
# Archaic, or translated word by word.
UNWANTED = (
    "was not to be had", "not to be had", "for ever", "which see", "is told in", "told apart",
    "bears for", "motor bears", "to be had", "mend it", "nought", "whilst", "thereof", "therein",
    "hitherto", "shared/reference",
)  # fmt: skip


def slug(heading):
    """The anchor that GitHub makes of a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors(page, root):
    code, found, seen = False, set(), {}
    for line in (root / page).read_text(encoding="utf-8").splitlines():
        code ^= pages.FENCE.match(line) is not None
        found |= set(re.findall(r'<a (?:name|id)="([^"]+)"', line))
        heading = None if code else re.match(r"#{1,6} +(.+?) *#*$", line)
        if heading:
            name = slug(heading[1])
            seen[name] = seen.get(name, -1) + 1
            found.add(name if seen[name] == 0 else f"{name}-{seen[name]}")
    return found


def links(page, root):
    """(line, path relative to the root, anchor) of each link that stays in the repository."""
    _, prose = pages.parts(page, root)
    for number, line in enumerate(prose, 1):
        for target in LINK.findall(line):
            if "://" in target or target.startswith("mailto:"):
                continue
            path, _, anchor = target.partition("#")
            there = Path(os.path.normpath(page.parent / path)) if path else page
            yield number, there, anchor


def wrong_links(root):
    for page in pages.pages(root):
        for number, path, anchor in links(page, root):
            if not (root / path).exists():
                yield f"{page}:{number}: {path} is not there"
            elif anchor and path.suffix == ".md" and anchor not in anchors(path, root):
                yield f"{page}:{number}: {path} has no heading #{anchor}"


def wrong_paths(root):
    for page in pages.pages(root):
        code, _ = pages.parts(page, root)
        for one in code:
            inline = one.language is None
            if inline and PATH.match(one.text) and not TO_BE_MADE.search(one.text):
                if not (root / one.text).exists():
                    yield f"{page}:{one.line}: {one.text} is not there"


def unreached(root):
    index = Path("docs/index.md")
    reached, new = {index}, [index]
    while new:
        page = new.pop()
        for _, path, _ in links(page, root):
            if path.suffix == ".md" and path not in reached and (root / path).exists():
                reached.add(path)
                new.append(path)
    return sorted(set(pages.pages(root)) - reached)


def unwanted(root):
    for page in pages.pages(root):
        _, prose = pages.parts(page, root)
        text = "\n".join(prose)
        for phrase in UNWANTED:
            pattern = r"\s+".join(map(re.escape, phrase.split()))
            for match in re.finditer(rf"\b{pattern}\b", text, re.I):
                yield f"{page}:{text.count(chr(10), 0, match.start()) + 1}: '{phrase}'"


class Pages(unittest.TestCase):
    maxDiff = None

    def test_links_and_anchors(self):
        self.assertEqual(list(wrong_links(pages.ROOT)), [])

    def test_paths(self):
        self.assertEqual(list(wrong_paths(pages.ROOT)), [])

    def test_reached_from_the_index(self):
        self.assertEqual(unreached(pages.ROOT), [])

    def test_glossary(self):
        """The report reads this table: two columns of plain text, in order, each term once."""
        text = (pages.ROOT / "docs/glossary.md").read_text(encoding="utf-8")
        rows = [line for line in text.splitlines() if line.startswith("|")]
        self.assertEqual(rows[:2], ["| term | meaning |", "|---|---|"])
        cells = [re.fullmatch(r"\| ([^|]+) \| ([^|]+\.) \|", row) for row in rows[2:]]
        self.assertNotIn(None, cells)
        self.assertFalse([c[0] for c in cells if re.search(r"[`*\]]\(|[`*]", c[0])])
        lines = [c[1] for c in cells]
        self.assertEqual(lines, sorted(lines, key=str.lower))
        terms = [term for line in lines for term in line.split(", ")]
        self.assertEqual(len(terms), len(set(terms)))

    def test_plain_words(self):
        self.assertEqual(list(unwanted(pages.ROOT)), [])


class Checks(Scratch):
    """Each check finds what it promises, on a small tree."""

    def test_each(self):
        root = self.folder
        (root / "docs").mkdir()
        (root / "README.md").write_text("[index](docs/index.md#a-word) `docs/gone.md`\n")
        (root / "docs/index.md").write_text("# A `word`\n## Two, three\n[up](../README.md)\n")
        self.assertEqual(list(wrong_links(root)), [])
        self.assertEqual(list(wrong_paths(root)), ["README.md:1: docs/gone.md is not there"])
        self.assertEqual(unreached(root), [])
        (root / "docs/lost.md").write_text(
            "[a](index.md#two-three) [b](gone.md) [c](index.md#x)\n"
            "It was not\nto be had; `for ever`.\n"
        )
        self.assertEqual(
            list(wrong_links(root)),
            ["docs/lost.md:1: docs/gone.md is not there",
             "docs/lost.md:1: docs/index.md has no heading #x"],
        )  # fmt: skip
        self.assertEqual(unreached(root), [Path("docs/lost.md")])
        self.assertIn("docs/lost.md:2: 'was not to be had'", list(unwanted(root)))
        self.assertNotIn("docs/lost.md:3: 'for ever'", list(unwanted(root)))


if __name__ == "__main__":
    sys.exit(unittest.main())
