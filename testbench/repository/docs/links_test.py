#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The pages hang together: links, anchors and paths lead to something, every page is reached from
docs/index.md."""

import os
import re
import sys
import unittest
from pathlib import Path

import pages

LINK = re.compile(r"\]\(([^)\s]+)\)")
PATH = re.compile(r"^(?:rtl|model|testbench|scripts|vectors|docs|\.ci)/[\w./+-]+$")
# Files that a page tells the reader to make, and words in capitals that stand for a name.
TO_BE_MADE = re.compile(r"[A-Z]{3,}|/foo\b|detent|/mine\.")


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


class Pages(unittest.TestCase):
    maxDiff = None

    def test_links_and_anchors(self):
        self.assertEqual(list(wrong_links(pages.ROOT)), [])

    def test_paths(self):
        self.assertEqual(list(wrong_paths(pages.ROOT)), [])

    def test_reached_from_the_index(self):
        self.assertEqual(unreached(pages.ROOT), [])


if __name__ == "__main__":
    sys.exit(unittest.main())
