# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The sentence of a run's card: one for each object, with numbers from the run's rows.

Documentation: docs/figures.md
"""

import tomllib
from pathlib import Path

import numpy as np

from reports import moments, runs

SAID = tomllib.loads(Path(__file__).with_name("sentences.toml").read_text(encoding="utf-8"))


def of_axes(summary, csv):
    """The sentence of a device of several axes."""

    def turned(n):
        return degrees(np.degrees(np.ptp(csv[f"theta_rad.{n}"])))

    words = {"first": turned(0), "second": turned(1)}
    if "hand_nm" in csv:
        words["most"] = f"{np.abs(csv['hand_nm']).max():.2f} Nm"
    if "handle_w" in csv:
        words["most"] = f"{np.abs(csv['motor_torque_nm.0']).max():.2f} Nm"
    if "pen_x_m" in csv:
        axes = [a for a in "xyz" if f"pen_{a}_m" in csv]
        way = np.linalg.norm([np.ptp(csv[f"pen_{a}_m"]) for a in axes])
        words["way_mm"] = f"{1e3 * way:.0f}"
        forces = np.linalg.norm([csv[f"hand_{a}_n"] for a in axes], axis=0)
        words["force"] = f"{forces.max():.1f} N"
    return SAID["device"][summary["device"]].format(**words)


def degrees(value):
    return f"{value + 0.0:.0f}°".replace("-", "−")


def title(subject):
    """That of the scene's file; of what is no scene of ours, its name."""
    try:
        return runs.scene_file(subject)["title"]
    except OSError:
        return subject


def said(summary, m):
    """The sentence, from the rows that the card shows."""
    torque = m.asked if m.felt is None else m.felt
    strong = np.abs(m.asked) >= 0.5 * np.abs(m.asked).max()
    begun = int(np.argmax(np.abs(m.asked) > moments.LEAST_NM))
    entered, deepest = float(m.angle[begun]), float(m.angle[m.peak])
    if summary.get("scene") == "membrane":  # the edges, not where its torque is largest
        entered, deepest = float(m.angle[strong].max()), float(m.angle[strong].min())
    low, high = float(m.angle.min()), float(m.angle.max())
    words = {
        "most": f"{np.abs(torque).max():.2f} Nm",
        "near": degrees(entered),
        "far": degrees(deepest),
        "depth": degrees(abs(deepest - entered)),
        "low": degrees(low),
        "high": degrees(high),
    }
    plain = SAID["moved" if high - low > 1 else "still"]
    if "scene" not in summary:
        return SAID["replayed"].format(**words)
    # What was never met is not described.
    sentence = SAID["scene"].get(summary["scene"], plain) if m.touched.any() else plain
    return sentence.format(**words)
