# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Reads a page as a browser would: its elements in order, its tables, its scripts."""

from html.parser import HTMLParser

EMPTY = {"br", "circle", "input", "link", "meta", "path", "rect", "wbr", "img"}  # nothing inside
# 13.6 px text: mean width of a digit or letter, and what a cell adds at its sides.
LETTER_PX, CELL_PX = 7.3, 16


class Markup(HTMLParser):
    """`complaints` are elements that are closed wrongly or never; `elements` [(tag, attributes)];
    `tables` [rows of [(text, may wrap)]]; `scripts` [(attributes, text)]; `text` all that is read.
    """

    def __init__(self, page):
        super().__init__()
        self.open, self.complaints, self.elements = [], [], []
        self.tables, self.scripts, self.text, self.ids = [], [], "", []
        self.feed(page)
        self.close()
        self.complaints += [f"<{tag}> is never closed" for tag in self.open]

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.elements.append((tag, attributes))
        if "id" in attributes:
            self.ids.append(attributes["id"])
        if tag not in EMPTY:
            self.open.append(tag)
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("th", "td"):
            wraps = tag == "th" or attributes.get("class") == "words"
            self.tables[-1][-1].append(["", wraps])
        elif tag == "wbr":
            self.handle_data("\u200b")
        elif tag == "svg" and self.cell():
            # A picture in a cell is as wide as so many letters.
            self.handle_data("w" * round(float(attributes["width"]) / LETTER_PX))
        elif tag == "script":
            self.scripts.append((attributes, ""))

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in EMPTY:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open[-1] != tag:
            self.complaints.append(f"</{tag}> inside <{self.open[-1] if self.open else '-'}>")
        else:
            self.open.pop()

    def cell(self):
        inside = any(tag in self.open for tag in ("th", "td"))
        return self.tables[-1][-1][-1] if inside else None

    def handle_data(self, data):
        if self.open and self.open[-1] == "script":
            attributes, text = self.scripts[-1]
            self.scripts[-1] = (attributes, text + data)
            return
        self.text += data
        if self.cell():
            self.cell()[0] += data

    def classes(self, name):
        """Attributes of the elements of a class."""
        return [a for _, a in self.elements if name in (a.get("class") or "").split()]


def width_px(table):
    """Least width of a table: no cell wraps but those that may."""
    widest = {}
    for row in table:
        for i, (text, wraps) in enumerate(row):
            pieces = text.replace("\u200b", " ").split() if wraps else [text]
            longest = max((len(piece) for piece in pieces), default=0)
            widest[i] = max(widest.get(i, 0), longest * LETTER_PX + CELL_PX)
    return sum(widest.values())
