# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Reads a page as a browser would: its elements in order, its tables, its scripts."""

from html.parser import HTMLParser

EMPTY = {"br", "link", "meta", "wbr", "img"}  # nothing inside


class Markup(HTMLParser):
    """`complaints` are elements that are closed wrongly or never; `elements` [(tag, attributes)];
    `tables` [rows of [text]]; `scripts` [(attributes, text)]; `text` all that is read.
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
            self.tables[-1][-1].append("")
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

    def handle_data(self, data):
        if self.open and self.open[-1] == "script":
            attributes, text = self.scripts[-1]
            self.scripts[-1] = (attributes, text + data)
            return
        self.text += data
        if {"th", "td"} & set(self.open):
            self.tables[-1][-1][-1] += data

    def classes(self, name):
        """Attributes of the elements of a class."""
        return [a for _, a in self.elements if name in (a.get("class") or "").split()]

