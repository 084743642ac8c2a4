# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Tables of `feltgate synth`: on the terminal, and the page of all figures that `feltgate docs` writes."""

import synth_measure
from reports.columns import aligned, markdown

# (repository, module, LUT4 equivalents, FF, MULT18, BRAM, Fmax [min-max]); measured for this
# project's planning with Yosys 0.52 and nextpnr 0.7 from the repositories' public sources.
PEERS = (
    ("jhu-cisst/mechatronics-firmware", "decoder with period estimator", 287, 240, 0, 0, "126 [125-132]"),
    ("jhu-cisst/mechatronics-firmware", "PI current controller (HLS)", 711, 454, 5, 0, "82 [82-90]"),
    ("jhu-cisst/mechatronics-firmware", "MotorChannelDRAC: current loop, PWM, faults", 1090, 774, 5, 0, "88 [88-88]"),
    ("WangXuan95/FPGA-FOC", "foc_top: the whole core", 2717, 1391, 19, 6, "52 [52-55]"),
    ("WangXuan95/FPGA-FOC", "pi_controller", 667, 275, 6, 0, "56 [56-56]"),
    ("f32c/f32c", "ctrlpid (and 32 DPR16X4)", 2977, 19, 0, 0, "44 [43-45]"),
    ("f32c/f32c", "rotary_decoder, 24 bits", 120, 30, 0, 0, "177 [175-184]"),
    ("multigcs/riocore", "quadencoder, 32 bits", 97, 38, 0, 0, "199 [198-205]"),
    ("multigcs/riocore", "pwmout, 32 bits", 142, 47, 0, 0, "187 [170-194]"),
    ("RAPcores/rapcores", "quad_enc, 32 bits, with period", 196, 103, 0, 0, "197 [195-197]"),
)

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


SCENE_HEADS = ("scenes", "LUT4 eq", "FF", "MULT18", "BRAM", "Fmax MHz", "LUT4 eq less")


def scene_set_rows(rows, whole):
    """One line for each set of scenes; the last column is against the whole design."""
    for name, row in rows.items():
        less = "-"
        if whole is not None:
            less = f"{1 - row['lut4_equivalents'] / whole['lut4_equivalents']:.0%}"
        figures = [str(row[key]) for key in ("lut4_equivalents", "ff", "mult18", "bram")]
        yield [name, *figures, speed(row), less]


def scene_set_lines(budget):
    if not budget.get("scene_sets"):
        return []
    how = budget["scene_sets_measured"]
    lines = ["", '### <a name="scene-sets"></a>Scene sets', ""]
    lines += [f"{synth_measure.SCENE_ROW[0].upper()}{synth_measure.SCENE_ROW[1:]}, of the design"]
    lines += ["that `feltgate design DESIGN --for SCENE...` writes, measured by"]
    lines += [f"`feltgate synth --for SCENE...` on {how['date']} with {how['yosys']} and"]
    lines += [f"{how['nextpnr']} ({how['machine']})."]
    for design, rows in budget["scene_sets"].items():
        whole = budget["figures"].get(design, {}).get(synth_measure.SCENE_ROW)
        sets = dict(sorted(rows.items(), key=lambda item: item[1]["lut4_equivalents"]))
        if whole is not None:
            sets["all scenes"] = whole
        heads = (f"`{design}`: {SCENE_HEADS[0]}", *SCENE_HEADS[1:])
        lines += ["", *markdown(heads, scene_set_rows(sets, whole))]
    return lines


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
    lines += scene_set_lines(budget)
    lines += ["", "### Peers", ""]
    peers = [[f"`{r}`", m, *(str(x) for x in rest)] for r, m, *rest in PEERS]
    heads = ("repository", "module", "LUT4 eq", "FF", "MULT18", "BRAM", "Fmax MHz")
    lines += markdown(heads, peers)
    return "\n".join(lines)
