# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A self-contained HTML page: no network, readable on a phone, in the dark and in print."""

from html import escape

STYLE = """
:root{color-scheme:light dark;--back:#fff;--text:#1d2329;--soft:#5a6570;--line:#d8dee4;
--tint:#f4f6f8;--good:#116329;--good-back:#dcf5e3;--bad:#a40e26;--bad-back:#ffe3e3;--link:#0550ae}
@media(prefers-color-scheme:dark){:root{--back:#15191e;--text:#e4e9ee;--soft:#9aa6b2;--line:#343c45;
--tint:#1e242b;--good:#6fdd8b;--good-back:#12301c;--bad:#ff9492;--bad-back:#3d1418;--link:#6cb6ff}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:84rem;padding:1rem;background:var(--back);color:var(--text);
font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Liberation Sans",sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:.5rem 0}
h2{font-size:1.3rem;margin:2.2rem 0 .6rem;border-bottom:1px solid var(--line);padding-bottom:.2rem}
h3{font-size:1.05rem;margin:1.4rem 0 .4rem}
a{color:var(--link)}
p,ul{max-width:46rem}
.soft{color:var(--soft);font-size:.9rem}
.verdict{padding:.7rem 1rem;border-radius:.5rem;margin:1rem 0;font-weight:600}
.good{color:var(--good)}.bad{color:var(--bad);font-weight:600}
.verdict.good{background:var(--good-back)}.verdict.bad{background:var(--bad-back)}
.verdict ul{font-weight:400;margin:.4rem 0 0;padding-left:1.2rem}
.scroll{overflow-x:auto;margin:.6rem 0}
table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums}
th,td{padding:.25rem .5rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}
th{background:var(--tint);font-weight:600;vertical-align:bottom;white-space:normal;line-height:1.25;
min-width:3.2rem}
th:first-child,td:first-child,th.words,td.words{text-align:left}
td:first-child{position:sticky;left:0;background:var(--back)}
td.words,th.words{white-space:normal;min-width:9rem}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,26rem),1fr));gap:.8rem}
figure{margin:0;break-inside:avoid}
figure img{width:100%;height:auto;background:#fff;border:1px solid var(--line);border-radius:.4rem;
display:block}
figcaption{font-size:.85rem;color:var(--soft);margin-top:.2rem}
details{margin:.5rem 0;border:1px solid var(--line);border-radius:.4rem;padding:.4rem .8rem}
summary{cursor:pointer;font-weight:600}
section{break-inside:auto}
@media print{body{font-size:11px;max-width:none;padding:0}a{color:inherit;text-decoration:none}
.scroll{overflow:visible}th,td{padding:.1rem .3rem}table{font-size:9px}
details{border:none;padding:0}h2,h3{break-after:avoid}}
"""

# Folded parts open themselves: for print, and when a link leads into them.
SCRIPT = """
function unfold(){document.querySelectorAll('details').forEach(d=>d.open=true)}
addEventListener('beforeprint',unfold);
function follow(){const t=location.hash&&document.getElementById(location.hash.slice(1));
if(t){const d=t.closest('details')||t.querySelector('details');if(d)d.open=true;t.scrollIntoView()}}
addEventListener('hashchange',follow);addEventListener('load',follow);
"""


def document(title, body):
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width,initial-scale=1">'
        f"<title>{escape(title)}</title><style>{STYLE}</style></head>\n<body>\n{body}\n"
        f"<script>{SCRIPT}</script></body></html>\n"
    )


def paragraph(text, soft=False):
    return f'<p{" class=soft" if soft else ""}>{escape(text)}</p>'


def bullets(texts):
    return "<ul>" + "".join(f"<li>{escape(text)}</li>" for text in texts) + "</ul>" if texts else ""


class Cell(str):
    """Markup that is already safe."""


def good_or_bad(count):
    """A count that should be 0."""
    return Cell(f'<span class="{"good" if count == 0 else "bad"}">{count:,}</span>')


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


def folded(anchor, summary, inside):
    return (
        f'<section id="{escape(anchor, quote=True)}"><details><summary>{escape(summary)}</summary>'
        f"{inside}</details></section>"
    )


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
