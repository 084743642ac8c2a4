# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The results of a sweep as a table, points.csv, and such a table read again.

Documentation: docs/speed-for-accuracy.md
"""

import csv
import io
import json
import math
import tempfile
import tomllib
from pathlib import Path

import interrupts
import outputs
from exploration import design_text, front, point, space
from exploration.sweep import ROUTED, SweepError

PLANT = "p24"
TABLE = "points.csv"


def count_ripple_rad_s(design):
    """How far one encoder count that enters and leaves the window moves the filtered velocity."""
    window_s = design["velocity.m1"] / design["clock.tick_hz"]
    step_rad_s = 2 * math.pi / (4 * design["encoder.lines"]) / window_s
    return step_rad_s * -math.expm1(-design["velocity.cutoff_rad_s"] * window_s)


def is_stable(design):
    """Whether the loop round the plant is stable with the lever free: docs/designs.md."""
    command = [point.BUILD / "feltgate", "design", design, "--plant", PLANT]
    done = interrupts.run(command, **interrupts.CAPTURED)
    if done.returncode and "unstable" not in done.stderr:
        raise SweepError(f"feltgate design failed: {done.stderr.strip()}")
    return done.returncode == 0


def proven(text, result):
    """Bounds as they are proven now, whenever the point was measured, and for a design for use
    whether it is stable."""
    with tempfile.TemporaryDirectory(prefix="feltgate-table-") as folder:
        design = Path(folder) / "point.toml"
        design.write_text(text, encoding="utf-8")
        found = point.bounds(design, result)
        return found if result["coarse"] else found | {"stable": is_stable(design)}


def finished(root, row):
    """A row with what follows from its design alone."""
    if front.good(row):
        text = design_text.design_text(root, row)
        design = space.flattened(tomllib.loads(text))
        row["result"]["count_ripple_rad_s"] = count_ripple_rad_s(design)
        if "raw_velocity_max_rad_s" in row["result"]:
            row["result"] |= proven(text, row["result"])
    return row


def write(sweep, points, root):
    """Writes points.csv in the order of the space; the rows."""
    rows, gaps = [], 0
    for point in points:
        result = sweep.result(point)
        gaps += result is None
        if not gaps:
            result |= sweep.result(point, ROUTED) or {}
            rows.append(finished(root, {"id": space.point_id(point), **point, "result": result}))
    if gaps:
        raise SweepError(f"{sweep.folder}: {gaps} of {len(points)} points have no result; run the sweep on")
    outputs.write_whole(sweep.folder / TABLE, table(rows))
    return rows


def shown(value):
    """Six digits are more than any figure here deserves."""
    if isinstance(value, float):
        return f"{value:.6g}"
    return value if isinstance(value, (int, str)) else space.canonical(value)


def table(rows):
    """CSV: id, f where the point is on the front, what is set, the figures."""
    on_front = {row["id"] for row in front.find(rows)}
    keys = sorted({key for row in rows for key in row["set"]})
    figures = sorted(
        {k for r in rows for k, v in r["result"].items() if isinstance(v, (int, float, str))}
    )
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["id", "front", *keys, *figures])
    for row in rows:
        values = [row["set"].get(key, "") for key in keys]
        values += [row["result"].get(key, "") for key in figures]
        flag = "f" if row["id"] in on_front else ""
        writer.writerow([row["id"], flag, *map(shown, values)])
    return text.getvalue()


def value_of(text):
    """What shown() made a text of."""
    if text in ("True", "False"):
        return text == "True"
    try:
        return json.loads(text)
    except ValueError:
        return text


# Columns of numbers, by how their names end.
FIGURES = ("_nm", "_rad_s", "_v", "_s", "_us", "_mhz", "_clocks", "mult18", "ff", "lut4_equivalents")


def read_table(path):
    """The rows of a points.csv, whose base is that of the space file beside it."""
    path = Path(path)
    beside = path.with_suffix(".toml")
    try:
        base = tomllib.loads(beside.read_text(encoding="utf-8"))["base"]
        with path.open(encoding="utf-8", newline="") as file:
            lines = list(csv.DictReader(file))
    except (OSError, ValueError, KeyError) as error:
        what = getattr(error, "strerror", None) or error
        where = getattr(error, "filename", None) or path
        raise SweepError(
            f"{where}: {what}; wanted a table and {beside.name} beside it"
        ) from None
    rows = []
    for number, line in enumerate(lines, 2):
        if None in line or None in line.values():
            raise SweepError(
                f"{path}:{number}: not as many fields as in line 1; make the table again"
            )
        known = {key: value_of(text) for key, text in line.items() if text and key != "id"}
        changed = {key: value for key, value in known.items() if "." in key}
        result = {key: value for key, value in known.items() if "." not in key and key != "front"}
        for key, value in result.items():
            if key.endswith(FIGURES) and not isinstance(value, int | float):
                raise SweepError(
                    f"{path}:{number}: {key} = {value!r} is not a number; make the table again"
                )
        rows.append({"id": line["id"], "base": base, "set": changed, "result": result})
    return rows
