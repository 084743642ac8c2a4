# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The first part of a run's page: one sentence, the moving lever, angle and torque.

Documentation: docs/figures.md
"""

from html import escape

from reports import glossary, lever, moments, sentences, time_chart

LEGEND = (("angle", "angle"), ("asked", "asked for by the core"), ("motor", "felt: the motor's"))
PUSHES = (("hand", "push of the hand"), ("motor", "push of the motor"))


def swatches(kinds):
    return "".join(
        f'<span><i class="swatch {kind}"></i>{escape(words)}</span>' for kind, words in kinds
    )


def legend(m):
    kinds = LEGEND if m.felt is not None else LEGEND[:2]
    if time_chart.touched(m, time_chart.angle_panel(m)):
        kinds += (("zone", "while torque is asked for"),)
    return f'<p class="legend">{swatches(kinds)}</p>'


def readings(m):
    """A table of one column that lever.js keeps up to date; it begins at the largest torque."""
    at = m.peak
    rows = [("time", "time", f"{m.time[at]:.3f} s"), ("angle", "angle", f"{m.angle[at]:.1f}°")]
    for name, words, values in (
        ("asked", "asked for", m.asked),
        ("felt", "felt", m.felt),
        ("hand", "hand", m.hand),
    ):
        if values is not None:
            rows.append((name, words, f"{values[at]:.3f} Nm"))
    cells = "".join(
        f'<div><dt>{words}</dt><dd class="tell-{name}">{value.replace("-", "−")}</dd></div>'
        for name, words, value in rows
    )
    return f'<dl class="readings">{cells}</dl>'


def controls(m):
    """Hidden until a script is there to answer them."""
    return (
        '<div class="controls" hidden><button type="button" aria-label="Play">▶</button>'
        '<input type="range" min="0" max="1" value="0" aria-label="Moment shown">'
        f"<small>{escape(lever.slower(m)[1])}</small></div>"
    )


def html(anchor, summary, csv):
    """The card of a run with rows of its CSV."""
    m = moments.of_run(summary, csv)
    subject = summary.get("scene") or summary.get("trace") or "run"
    name = sentences.title(subject)
    pushes = PUSHES if m.hand is not None else (("motor", "torque asked for"),)
    part = f"{m.time[0]:.2f} to {m.time[-1]:.2f} s of {m.whole_s:.2f} s".replace("-", "−")
    data = lever.data(m, time_chart.span())
    return (
        f'<section class="card" id="{escape(anchor, quote=True)}"><h3>{escape(name)}</h3>'
        f'<p class="said">{glossary.marked(sentences.said(summary, m))}</p>'
        f'<div class="moving"><figure><p class="legend">{swatches(pushes)}</p>'
        f"{lever.drawing(m)}{controls(m)}</figure>"
        f"<figure>{legend(m)}{time_chart.svg(m, name)}{readings(m)}"
        f"<figcaption>{escape(part)}</figcaption></figure>"
        f'<script type="application/json">{data}</script></div></section>'
    )
