# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A self-contained HTML page: no network, readable on a phone, in the dark and in print."""

from html import escape
from pathlib import Path

HERE = Path(__file__).resolve().parent

# Folded parts open themselves: for print, and when a link leads into them.
SCRIPT = """
function unfold(){document.querySelectorAll('details').forEach(d=>d.open=true)}
addEventListener('beforeprint',unfold);
function follow(){const t=location.hash&&document.getElementById(location.hash.slice(1));
if(!t)return;let d=t.querySelector('details')||t.closest('details');
for(;d;d=d.parentElement.closest('details'))d.open=true;t.scrollIntoView()}
addEventListener('hashchange',follow);addEventListener('load',follow);
"""


def document(title, body):
    """The whole file."""
    style = (HERE / "page.css").read_text(encoding="utf-8")
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width,initial-scale=1">'
        f"<title>{escape(title)}</title><style>{style}</style></head>\n<body>\n{body}\n"
        f"<script>{SCRIPT}</script></body></html>\n"
    )


def paragraph(text, soft=False):
    return f'<p{" class=soft" if soft else ""}>{escape(text)}</p>'


def bullets(texts):
    items = "".join(f"<li>{escape(text)}</li>" for text in texts)
    return f"<ul>{items}</ul>" if texts else ""


class Cell(str):
    """Markup that is already safe."""


def mark(good, text):
    """Words in the colour of what is well, or of what is not."""
    return Cell(f'<span class="{"good" if good else "bad"}">{text}</span>')


def good_or_bad(count):
    """A count that should be 0."""
    return mark(count == 0, f"{count:,}")


def link(target, text):
    return Cell(f'<a href="#{escape(target, quote=True)}">{escape(text)}</a>')


def table(head, rows, words=()):
    """`words` are the columns (numbers) that hold text and may wrap. Empty rows: nothing."""
    if not rows:
        return ""

    def cells(row, tag):
        for i, value in enumerate(row):
            inner = value if isinstance(value, Cell) else escape(str(value))
            yield f"<{tag}{' class=words' if i in words else ''}>{inner}</{tag}>"

    lines = ["<tr>" + "".join(cells(head, "th")) + "</tr>"]
    full = [[*row, *[""] * (len(head) - len(row))] for row in rows]
    lines += ["<tr>" + "".join(cells(row, "td")) + "</tr>" for row in full]
    return '<div class="scroll"><table>\n' + "\n".join(lines) + "\n</table></div>"


def verdict(faults, good_text):
    """The banner: green with `good_text`, or red with the list of what is wrong."""
    if not faults:
        return f'<div class="verdict good">{escape(good_text)}</div>'
    head = "1 thing is wrong" if len(faults) == 1 else f"{len(faults)} things are wrong"
    return f'<div class="verdict bad">{head}{bullets(faults)}</div>'


def pictures(drawn):
    """Pictures side by side where there is room, one below the other on a phone."""
    items = []
    for picture in drawn:
        caption = f"<figcaption>{escape(picture.caption)}</figcaption>" if picture.caption else ""
        alternative = escape(picture.caption or picture.name, quote=True)
        image = f'<img src="{picture.data_uri()}" alt="{alternative}">'
        items.append(f"<figure>{image}{caption}</figure>")
    return '<div class="pictures">' + "\n".join(items) + "</div>" if items else ""


def fold(summary, inside):
    """Closed until it is asked for, without JavaScript too; nothing where there is nothing."""
    return f"<details><summary>{escape(summary)}</summary>{inside}</details>" if inside else ""


def folded(anchor, summary, inside):
    """The same, as a place that a link leads to."""
    return f'<section id="{escape(anchor, quote=True)}">{fold(summary, inside)}</section>'


def section(anchor, title, inside):
    return f'<section id="{escape(anchor, quote=True)}"><h2>{escape(title)}</h2>{inside}</section>'


def number(value, digits=3):
    """Three significant digits, thousands parted, no exponent for what a reader meets here."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    size = abs(value)
    if size >= 1000:
        text = f"{size:,.0f}"
    elif size < 1e-6:
        return "≈ 0"
    elif size < 1e-4:  # where 'g' would turn to an exponent
        text = f"{size:.8f}".rstrip("0")
    else:
        text = f"{size:#.{digits}g}".rstrip(".")
    return "−" + text if value < 0 else text
