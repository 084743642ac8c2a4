#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/felt.svg, the picture of the README, from three runs of the core.

  FELTGATE_PROGRAM=build/feltgate scripts/readme_picture.py
"""

import os
import subprocess
import tempfile
from pathlib import Path

from docs_picture import BLUE, GREY, RED, ROOT, columns, plt, save


def run(scene, design, every, folder):
    """Columns of a run in lock-step; CalledProcessError when anything was not as it should be."""
    path = Path(folder, f"{scene}_{design}.csv")
    program = os.environ.get("FELTGATE_PROGRAM", str(ROOT / "build/feltgate"))
    words = [program, "run", scene, "--design", design, "--quiet"]
    subprocess.run([*words, "--csv", str(path), "--every", str(every)], check=True)
    return columns(path)


def window(run, first_s, last_s):
    keep = (first_s <= run["time_s"]) & (run["time_s"] <= last_s)
    return {key: values[keep] for key, values in run.items()}


def membrane(axes, crossing):
    cut = window(crossing, 2.35, 2.75)
    axes.plot(cut["theta_rad"], cut["motor_torque_nm"], color=BLUE, label="motor torque")
    axes.plot(cut["theta_rad"], cut["tau_ref_nm"], color="k", lw=0.9, ls="--", label="asked for")
    axes.invert_xaxis()
    axes.annotate("", (0.33, 0.25), (0.47, 0.25), arrowprops={"arrowstyle": "->", "color": GREY})
    axes.text(0.40, 0.27, "hand", ha="center", color=GREY, fontsize=9)
    axes.set(title="a membrane between 0.7 and 0.5 rad", xlabel="angle of the lever, rad")


def step(axes, lever, paper):
    for run_of, color, name in ((lever, BLUE, "lever"), (paper, RED, "paper")):
        cut = window(run_of, 0.2585, 0.272)
        ms = 1e3 * (cut["time_s"] - 0.26)
        axes.plot(ms, cut["motor_torque_nm"], color=color, label=f"motor torque, {name}")
    axes.plot(ms, cut["tau_hat_nm"], color=RED, lw=0.9, ls=":", label="what paper's observer says")
    axes.plot(ms, cut["tau_ref_nm"], color="k", lw=0.9, ls="--", label="asked for")
    axes.set(title="a step of 0.3 Nm, shaft locked", xlabel="time, ms")


def main():
    with tempfile.TemporaryDirectory() as folder:
        crossing = run("membrane", "lever", 500, folder)
        steps = [run("torque_step", design, 25, folder) for design in ("lever", "paper")]
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.0), layout="constrained")
    membrane(axes[0], crossing)
    step(axes[1], *steps)
    for axis in axes:
        axis.set_ylabel("torque on the lever, Nm")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8, frameon=False)
    save(figure, "felt")


if __name__ == "__main__":
    main()
