# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""explore.html: every point is a dot; point at it for its figures and design file. No network.

Documentation: docs/speed-for-accuracy.md
"""

import difflib
from html import escape
from pathlib import Path

import outputs
from reports import page

from exploration import design_text, front, presets, space
from exploration.design_text import toml_value

NAME = "explore.html"
HERE = Path(__file__).resolve().parent
# Figure, what it is, unit, factor to that unit. The first two are the first axes.
FIGURES = (
    ("lut4_equivalents", "LUT4 equivalents", "", 1),
    ("torque_error_rms_nm", "rms torque error", "µNm", 1e6),
    ("torque_error_max_nm", "worst torque error", "µNm", 1e6),
    ("bound_torque_nm", "proven bound of the torque error", "µNm", 1e6),
    ("velocity_error_max_rad_s", "worst velocity error", "mrad/s", 1e3),
    ("bound_velocity_rad_s", "proven bound of the velocity error", "mrad/s", 1e3),
    ("velocity_error_rms_rad_s", "rms velocity error", "mrad/s", 1e3),
    ("tau_hat_error_max_nm", "worst error of the observed torque", "µNm", 1e6),
    ("delay_s", "estimator delay", "ms", 1e3),
    ("latency_us", "latency", "µs", 1),
    ("count_ripple_rad_s", "velocity ripple of one count", "rad/s", 1),
    ("torque_settling_s", "torque settling", "ms", 1e3),
    ("ff", "flip-flops", "", 1),
    ("mult18", "MULT18", "", 1),
    ("bram", "block RAM", "", 1),
    ("fmax_mhz", "Fmax", "MHz", 1),
)


def changes(base, text):
    """[(first line, lines away, lines instead)] that make `text` of `base`."""
    old, new = base.split("\n"), text.split("\n")
    matcher = difflib.SequenceMatcher(None, old, new, autojunk=False)
    return [[a, b - a, new[c:d]] for tag, a, b, c, d in matcher.get_opcodes() if tag != "equal"]


def words(point):
    """What sets the point apart from its base, in few words."""
    if not point["set"]:
        return f"{point['base']} as it is"
    return ", ".join(f"{key} {toml_value(v)}" for key, v in point["set"].items())


def data_of(rows, root):
    """What the script of the page needs."""
    on_front = {row["id"] for row in front.find(rows)}
    named = {row["id"]: name for name, row in presets.choose(rows).items()}
    bases = {row["base"]: "" for row in rows}
    for base in bases:
        bases[base] = design_text.design_text(root, {"base": base, "set": {}})
    dots = []
    for row in rows:
        text = design_text.design_text(root, row)
        dots.append(
            {
                "id": row["id"],
                "base": row["base"],
                "what": words(row),
                "front": row["id"] in on_front,
                "preset": named.get(row["id"], ""),
                "scenes": space.canonical(row["set"].get(front.SCENES)),
                "y": [row["result"].get(key) for key, *_ in FIGURES],
                "text": changes(bases[row["base"]], text),
            }
        )
    figures = [{"what": w, "unit": u, "factor": f} for _, w, u, f in FIGURES]
    return {"figures": figures, "bases": bases, "dots": dots}


def front_table(rows):
    head = ["design", *(f"{what} {unit}".strip() for _, what, unit, _ in FIGURES)]
    lines, told = [], set()
    for row in front.find(rows):
        alike = (row["set"].get(front.SCENES) is None, front.vector(row))
        if alike in told:
            continue  # differs in nothing that the front is about
        told.add(alike)
        values = [row["result"].get(key) for key, *_ in FIGURES]
        scaled = [
            page.number(None if v is None else v * f)
            for v, (*_, f) in zip(values, FIGURES, strict=True)
        ]
        lines.append([words(row), *scaled])
    return page.table(head, lines, words=(0,))


def body(plan, rows, root):
    refused = [row for row in rows if not front.good(row)]
    data = page.embedded(data_of(rows, root))
    script = (HERE / "explore_page.js").read_text(encoding="utf-8")
    style = (HERE / "explore_page.css").read_text(encoding="utf-8")
    options = "".join(
        f'<option value="{i}">{escape(what)}{f" ({unit})" if unit else ""}</option>'
        for i, (_, what, unit, _) in enumerate(FIGURES)
    )
    return f"""<style>{style}</style>
<h1>{escape(plan.name)}: {escape(plan.description)}</h1>
{page.paragraph(INTRODUCTION.format(points=len(rows), refused=len(refused)))}
<p class="choice"><label>across <select id="across">{options}</select></label>
<label>up <select id="up">{options}</select></label>
<label><input type="checkbox" id="only"> the front only</label></p>
<div class="sides">
<svg id="chart" viewBox="0 0 640 460" role="img" aria-label="design points"></svg>
<div id="told" aria-live="polite"></div></div>
{page.section("front", "The front", front_table(rows))}
<script type="application/json" id="data">{data}</script>
<script>{script}</script>"""


INTRODUCTION = (
    "{points} designs, each built, run beside its twin and found equal to it bit for bit, or "
    "refused ({refused}). Filled dots are on the front: no other design with the same scenes is at "
    "least as good in rms torque error, LUT4 equivalents, MULT18 and delay and better in one. "
    "Errors are against the same chain in 113-bit floating point on the same encoder counts. Hover "
    "a dot, or go to it with Tab, and its figures and its design file appear; a click keeps them. "
    "Simulation and synthesis: nothing ran on a board."
)


def write(plan, rows, root):
    """Writes the page of a merged plan; its path."""
    path = plan.folder / NAME
    text = page.document(f"feltgate explore: {plan.name}", body(plan, rows, root))
    outputs.write_whole(path, text)
    return path
