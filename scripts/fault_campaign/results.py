# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What a campaign says: rows of classes per group, what was promised, and the rows per block of the
RTL."""

import re

from reports.columns import aligned

CLASSES = ("masked", "latent", "transient", "off", "detected", "silent", "unsafe")
POINTS = ("state", "two bits", "pins", "words")
SILENT_SHARE = 0.01
FLAGGED_SHARE = 0.99


def bound(count, of):
    """A share as a percentage; beside a zero its 95 % bound, about 3/N where N is large."""
    if not of:
        return "-"
    return f"{100 * count / of:.2g} %" if count else f"0 (< {100 * (1 - 0.05 ** (1 / of)):.2g} %)"


class Row:
    """Faults of one group."""

    def __init__(self, point, group):
        self.point, self.group = point, group
        self.count = dict.fromkeys(CLASSES, 0)
        self.peaks, self.integrals, self.motor_peaks, self.off_us = [], [], [], []

    def add(self, fault):
        self.count[fault["class"]] += 1
        self.peaks.append(fault["peak_nm"])
        self.integrals.append(fault["integral_nm_s"])
        if "motor_peak_nm" in fault:  # lines of an earlier campaign have none
            self.motor_peaks.append(fault["motor_peak_nm"])
        if "off_after_us" in fault:
            self.off_us.append(fault["off_after_us"])

    def total(self):
        return sum(self.count.values())

    def as_json(self):
        """Counts, and the largest of the deviations."""
        return {
            "point": self.point,
            "group": self.group,
            "faults": self.total(),
            **self.count,
            "peak_nm": max(self.peaks),
            "integral_nm_s": max(self.integrals),
            "motor_peak_nm": max(self.motor_peaks, default=None),
            "off_after_us": max(self.off_us, default=None),
        }


def rows_of(faults):
    """A row for each group, in the order of the points."""
    rows = {}
    for fault in faults:
        key = (fault["point"], fault["group"])
        rows.setdefault(key, Row(*key)).add(fault)
    return sorted(rows.values(), key=lambda row: (POINTS.index(row.point), row.group))


def is_safety(fault):
    return fault["point"] == "state" and fault["safety"]


def changes_count(fault):
    """A short may leave the count where it is: all of its edges are illegal, and where they are
    few nothing finds it."""
    return (
        fault["group"] != "channels shorted"
        or fault["count_changed"]
        or fault["class"] == "detected"
    )


def promises(faults):
    """[(what, reached, of, kept)]."""
    seen = [f for f in faults if not f.get("unseen")]
    unsafe = sum(f["class"] == "unsafe" for f in seen)
    found = [("unsafe, of all faults that a core can see", unsafe, len(seen), unsafe == 0)]
    for group in dict.fromkeys(f["group"] for f in faults if f.get("unseen")):
        its = [f for f in faults if f["group"] == group]
        unsafe = sum(f["class"] == "unsafe" for f in its)
        found.append((f"unsafe, of '{group}', which nothing need see", unsafe, len(its), True))
    safety = [f for f in faults if is_safety(f)]
    if safety:
        silent = sum(f["class"] in ("silent", "unsafe") for f in safety)
        found.append(
            (
                "silent wrong, of single flips in the safety state",
                silent,
                len(safety),
                silent <= SILENT_SHARE * len(safety),
            )
        )
    for group in dict.fromkeys(f["group"] for f in faults if f.get("must_flag")):
        its = [
            f for f in faults if f["group"] == group and f["point"] == "pins" and changes_count(f)
        ]
        missed = sum(f["class"] != "detected" for f in its)
        found.append(
            (
                f"not flagged, of '{group}'",
                missed,
                len(its),
                missed <= (1 - FLAGGED_SHARE) * len(its),
            )
        )
    for group in dict.fromkeys(f["group"] for f in faults if f.get("must_refuse")):
        its = [f for f in faults if f["group"] == group]
        opened = sum(f["class"] != "off" for f in its)
        found.append((f"not refused, of '{group}'", opened, len(its), opened == 0))
    return found


def text_table(rows, timed=False):
    """For a terminal. `timed`: with the latest time to the gates off and the motor's largest torque."""
    head = ["point", "group", "faults", *CLASSES, "peak Nm", "mNm s"] + (["off us", "motor Nm"] if timed else [])
    cells = [
        [row.point, row.group, row.total(), *(row.count[c] for c in CLASSES)]
        + [f"{max(row.peaks):.3f}", f"{1e3 * max(row.integrals):.3f}"]
        + ([max(row.off_us, default="-"), f"{max(row.motor_peaks):.3f}"] if timed else [])
        for row in rows
    ]
    return aligned([head, *cells], left=2)


def block_of(fault, blocks):
    """The block that a register is in: the deepest instance that is named after one."""
    name = fault["register"]
    if name.startswith("parameter "):
        return "params"
    if name == "velocity line":
        return "travel_window"
    found = "feltgate_core"
    for instance in re.findall(r"u_(\w+?)\.", name):
        found = instance if instance in blocks else found
    return found


def per_block(faults, blocks):
    """{block: {"unsafe": [n, of], "silent": [n, of]}} of single flips."""
    found = {}
    for fault in (f for f in faults if is_safety(f)):
        entry = found.setdefault(block_of(fault, blocks), {"unsafe": [0, 0], "silent": [0, 0]})
        for key in entry:
            entry[key][1] += 1
            entry[key][0] += fault["class"] == key
    return found
