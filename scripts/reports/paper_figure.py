# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""One figure of the paper redrawn: pictures, a table with the paper's numbers and our results,
notes on what cannot be the same. Documentation: docs/figures.md
"""

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from reports import page

WORDS = tomllib.loads(Path(__file__).with_name("figures.toml").read_text(encoding="utf-8"))


@dataclass
class Row:
    """One quantity. The key carries the unit and is the name in figures.json."""

    key: str
    what: str
    published: str = ""
    values: dict = field(default_factory=dict)  # column: number


class PaperFigure:
    """`columns` are (key, title); words and notes are those of figures.toml."""

    def __init__(self, number, columns):
        self.number, self.columns = number, columns
        self.words = WORDS[str(number)]
        self.title, self.said = self.words["title"], self.words["said"]
        self.notes = list(self.words["notes"])
        self.rows, self.pictures = [], []

    def add(self, key, values, words=None, filled=("", "")):
        """One row: {column: number}, of which None is no value; in the words of another key, where
        one is given, with these filled in."""
        said = self.words["rows"].get(words or key, "")
        what, published = (WORDS["rows"][key], said) if isinstance(said, str) else said
        what, published = what.format(filled[0]), published.format(filled[1])
        present = {k: float(v) for k, v in values.items() if v is not None}
        self.rows.append(Row(key, what, published, present))

    def name(self):
        return f"figure-{self.number:02d}"

    def html(self):
        used = [c for c in self.columns if any(c[0] in row.values for row in self.rows)]
        head = ["quantity", "the paper"] + [title for _, title in used]
        rows = [
            [row.what, row.published or "–"] + [page.number(row.values.get(key)) for key, _ in used]
            for row in self.rows
        ]
        inside = page.paragraph(f"The paper: {self.said}") + page.pictures(self.pictures)
        inside += page.fold("Numbers: the paper and ours", page.table(head, rows, words=(0, 1)))
        inside += page.bullets(self.notes)
        return page.section(self.name(), f"Figure {self.number}: {self.title}", inside)

    def summary(self):
        """For figures.json."""
        numbers = {}
        for row in self.rows:
            entry = dict(row.values)
            if row.published:
                entry["published"] = row.published
            numbers[row.key] = entry
        return {
            "figure": self.number,
            "title": self.title,
            "paper_says": self.said,
            "numbers": numbers,
            "notes": self.notes,
            "pictures": [p.name for p in self.pictures],
        }
