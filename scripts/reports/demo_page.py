# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page of the main job: what a hand feels, three numbers, tables of all runs, the paper's
figures, each run's pictures.

Documentation: docs/figures.md
"""

import os
import platform
import time
from dataclasses import dataclass, field
from pathlib import Path

from reports import demo_tables, headline, observer_section, page, recordings, run_pictures
from reports import run_section
from reports.progress import clock_text

# What every reader has felt before.
CARDS = ("membrane-lever", "spring_compression-lever", "wall-lever", "detent-lever_law")
STEPS = "torque_step-lever"


def draw(run):
    """A run's pictures; a process of its own does that."""
    if run.of_axes:
        return run_pictures.axes_pictures(run.job.name, run.csv)
    return run_pictures.pictures(run.job.name, run.summary, run.csv)


@dataclass
class Demo:
    """Everything that the page and demo.json tell. Names are those of jobs."""

    runs: dict
    scenes: list
    replays: list
    drawn: dict = field(default_factory=dict)
    devices: list = field(default_factory=list)  # of several axes
    figures: list = field(default_factory=list)
    wrong: list = field(default_factory=list)
    unreadable: list = field(default_factory=list)
    where: Path = None
    own: bool = False
    took_s: float = 0.0

    @property
    def shown(self):
        """Runs that have a place on the page."""
        return self.scenes + self.devices + self.replays

    @property
    def clocks(self):
        return sum(run.compared_clocks for run in self.runs.values())

    @property
    def compared(self):
        """Runs of RTL and twin; the paper's long motions are the twin's alone."""
        return [run for run in self.runs.values() if run.compared_clocks]

    @property
    def simulated_s(self):
        return round(sum(run.summary["simulated_s"] for run in self.compared), 6)

    @property
    def mismatches(self):
        return sum(run.mismatches for run in self.runs.values())


def headlines(demo):
    """Clocks and mismatches of all runs, the largest error of any, the settling of a step."""
    there = [run.summary for run in demo.runs.values() if run.ran and not run.of_axes]
    found = [headline.compared(demo.clocks, demo.mismatches), headline.error(there)]
    run = demo.runs.get(STEPS)
    if run is not None and run.ran and run_section.steps_of(run.summary):
        found.append(headline.settling(run.summary, run_section.steps_of(run.summary)))
    return headline.html(found)


def title(run):
    if run.job.recording is not None:
        return run.job.recording.title
    return f"{run_section.subject(run.summary)}, design {run.design}"


def cards(demo):
    there = [(demo.runs[name], demo.drawn[name]) for name in CARDS if name in demo.drawn]
    text = page.paragraph(
        "A hand moves the lever; the core reads its encoder and tells the motor how hard to push "
        "back. Core, motor, lever and hand are simulated, clock by clock."
    )
    parts = [
        f'<section id="{run.job.name}"><h3>{page.escape(title(run))}</h3>'
        f"{run_section.inside(run.summary, drawn)}</section>"
        for run, drawn in there
    ]
    return page.section("felt", "What a hand feels", text + "".join(parts)) if parts else ""


def recordings_text(demo):
    if demo.own:
        text = (
            "No public recordings were found, so these are the project's own, from its simulated "
        )
        return page.paragraph(text + "bench.") + page.paragraph(recordings.SOURCES, soft=True)
    return page.paragraph(
        f"Read from {demo.where}, whole. A slow capture meets a 50 MHz clock: each edge falls at a "
        "seeded random clock inside its sample. “As known”: steps, illegal steps and reversals are "
        "what a plain counting program finds. The core renders the damper, so that motion makes "
        "torque; nothing feels it, for a recording cannot give way."
    )


def many(count, what):
    return f"{count:,} {what}{'' if count == 1 else 's'}"


def tables(demo):
    """All runs; each table is folded, and its title says what came out."""
    scenes = [demo.runs[name] for name in demo.scenes]
    replays = [demo.runs[name] for name in demo.replays]
    broken = sum(len(r.summary.get("expectations", {}).get("broken", [])) for r in scenes)
    steps = sum(r.summary["position"]["steps"] for r in replays if r.ran)
    text = page.paragraph(
        "Each scene in closed loop with a modelled motor, lever and hand; each recording of a real "
        "encoder whole. Errors are against the same chain in 113-bit arithmetic on the same "
        "sampled counts; speed is simulated seconds per second spent in a back-end. Everything is "
        "simulation: nothing ran on a board."
    )
    text += page.folded(
        "scenes",
        f"Scenes: {many(len(scenes), 'run')} in closed loop, {mismatches(scenes)}, "
        f"{many(broken, 'expectation')} broken",
        demo_tables.scenes(demo),
    )
    if demo.devices:
        axes = [demo.runs[name] for name in demo.devices]
        text += page.folded(
            "axes",
            f"Devices of several axes: {many(len(axes), 'run')} in closed loop, {mismatches(axes)}",
            demo_tables.axes(demo),
        )
    text += page.folded("steps", "Torque steps: how fast each settles", demo_tables.steps(demo))
    read = recordings_text(demo) + demo_tables.replays(demo)
    if demo.unreadable:
        read += page.paragraph("Could not be read:") + page.bullets(demo.unreadable)
    text += page.folded(
        "recordings",
        f"Encoder recordings: {len(replays)} in open loop, {many(steps, 'step')}, "
        f"{mismatches(replays)}",
        read,
    )
    return text


def mismatches(there):
    count = sum(run.mismatches for run in there)
    return "1 mismatch" if count == 1 else f"{count:,} mismatches"


def runs_section(demo):
    parts = []
    for name in demo.shown:
        run = demo.runs[name]
        if not run.ran or name in CARDS:
            continue
        if run.of_axes:
            text = page.bullets(run_section.axes_facts(run.summary)) + page.pictures(demo.drawn[name])
            parts.append(page.folded(name, title(run), text))
        else:
            parts.append(page.folded(name, title(run), run_section.inside(run.summary, demo.drawn[name])))
    return page.section("runs", "Each run", "\n".join(parts))


def document(demo):
    good = (
        f"0 mismatches between RTL and twin in {demo.clocks:,} clocks "
        f"({demo.simulated_s:.1f} s of device time, {len(demo.compared)} runs)"
    )
    version = next((r.summary.get("version", "") for r in demo.runs.values() if r.ran), "")
    body = "<h1>feltgate demo</h1>"
    body += page.paragraph(
        "A DSP core that lets a hand feel things that are not there, tried in simulation: its "
        "SystemVerilog runs beside its bit-exact C++ twin, every output compared in every clock."
    )
    body += page.verdict(demo.wrong, good)
    body += headlines(demo) + cards(demo)
    body += page.section("tables", "All runs", tables(demo))
    if demo.figures:
        body += page.section(
            "figures",
            "The paper's figures, redrawn from RTL",
            page.paragraph(
                "Blue is the torque that paper observes, purple its motor's, green that of lever's motor, dashed "
                "the ideal. Design paper has the published numbers, lever those of the motor that is really there."
            ),
        )
        body += "".join(figure.html() for figure in demo.figures)
        body += observer_section.html(demo.runs)
    body += runs_section(demo)
    body += page.paragraph(
        f"feltgate {version}, {time.strftime('%Y-%m-%d %H:%M')}, {os.cpu_count()} cores "
        f"({platform.machine()}), {clock_text(demo.took_s)} minutes",
        soft=True,
    )
    return page.document("feltgate demo", body)
