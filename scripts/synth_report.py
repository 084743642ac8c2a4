# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Tables of `feltgate synth`: on the terminal, and the page of all figures that `feltgate docs` writes."""

from reports.columns import aligned, markdown

HEADS = ("", "LUT4", "CCU2C", "LUT4 eq", "FF", "MULT18", "BRAM", "Fmax MHz", "C4E cells", "C4E FF")


def speed(row):
    if "fmax_mhz" not in row:
        return "-"
    return f"{row['fmax_mhz']:.0f} [{row['fmax_min_mhz']:.0f}-{row['fmax_max_mhz']:.0f}]"


def cells(name, row):
    keys = ("lut4", "ccu2c", "lut4_equivalents", "ff", "mult18", "bram")
    late = ("cyclone_cells", "cyclone_ff")
    return [name, *(str(row[k]) for k in keys), speed(row), *(str(row.get(k, "-")) for k in late)]


def total(rows, blocks):
    """What these blocks have together, each as often as it is named; without wiring between them."""
    often = {name: blocks.count(name) for name in rows}
    keys = {key for row in rows.values() for key, value in row.items() if isinstance(value, int)}
    return {key: sum(often[name] * row.get(key, 0) for name, row in rows.items()) for key in keys}


def text_table(design, rows, blocks=()):
    """`blocks`: those asked for; two and more have a sum where each is one row."""
    lines = [[f"design {design}", *HEADS[1:]], *(cells(n, r) for n, r in rows.items())]
    if len(blocks) > 1 and set(blocks) == set(rows):
        lines.append(cells(f"sum of {len(blocks)}", total(rows, list(blocks))))
    paths = [f"  {n}: {r['critical_path']}" for n, r in rows.items() if "critical_path" in r]
    return "\n".join([aligned(lines), *(["critical paths:", *paths] if paths else [])])


def generated(budget):
    how = budget["measured"]
    lines = [
        f"Measured on {how['date']} with {how['yosys']} and {how['nextpnr']} ({how['machine']}).",
    ]
    for design, rows in budget["figures"].items():
        rows = {name: row for name, row in rows.items() if not name.startswith("board ")}
        lines += ["", f"### Design `{design}`", ""]
        lines += markdown(HEADS, [cells(name, row) for name, row in rows.items()])
        lines += ["", "Critical paths of the median seed:", ""]
        lines += [f"- {n}: `{r['critical_path']}`" for n, r in rows.items() if "critical_path" in r]
    return "\n".join(lines)
