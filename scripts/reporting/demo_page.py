# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The page of the main job: verdict, tables of all runs, the paper's figures, each run's pictures.

Documentation: docs/figures.md
"""

import os
import platform
import time
from dataclasses import dataclass, field
from pathlib import Path

from reporting import page, recordings, run_section, stability_section
from reporting.progress import clock_text


@dataclass
class Demo:
    """Everything that the page and demo.json tell. Names are those of jobs."""

    runs: dict
    scenes: list
    replays: list
    pictures: dict = field(default_factory=dict)
    figures: list = field(default_factory=list)
    stability: dict | None = None
    wrong: list = field(default_factory=list)
    unreadable: list = field(default_factory=list)
    where: Path = None
    own: bool = False
    took_s: float = 0.0

    @property
    def clocks(self):
        return sum(run.summary.get("clocks", 0) for run in self.runs.values())

    @property
    def simulated_s(self):
        return round(sum(run.summary.get("simulated_s", 0.0) for run in self.runs.values()), 6)

    @property
    def mismatches(self):
        return sum(run.mismatches for run in self.runs.values())


ERROR_HEAD = [
    "velocity error, max, µrad/s",
    "rms",
    "observed torque, max, µNm",
    "rms",
    "torque, max, µNm",
    "rms",
]
SPEED_HEAD = ["RTL, s/s", "twin", "double", "quad"]


def error_cells(summary):
    rtl = summary["engines"].get("rtl", {})
    return [
        cell
        for key in ("velocity_rad_s", "tau_hat_nm", "torque_nm")
        for cell in run_section.error_cells(rtl, key, 1e6)
    ]


def speed_cells(summary):
    engines = summary["engines"]
    return [page.number(engines.get(name, {}).get("speed")) for name in run_section.ENGINES]


def scene_table(demo):
    head = [
        "scene",
        "design",
        "device time, s",
        "mismatches",
        "expectations broken",
        *ERROR_HEAD,
        "saturated ticks",
        *SPEED_HEAD,
    ]
    rows = []
    for name in demo.scenes:
        run = demo.runs[name]
        if not run.ran:
            rows.append([name, page.Cell('<span class="bad">did not run</span>')])
            continue
        s = run.summary
        expectations = s.get("expectations", {"checked": 0, "broken": []})
        broken = page.good_or_bad(len(expectations["broken"]))
        saturated = s["engines"].get("rtl", {}).get("saturations")
        rows.append(
            [
                page.link(name, s["scene"]),
                s["design"],
                page.number(s["simulated_s"]),
                page.good_or_bad(run.mismatches),
                page.Cell(f"{broken} of {expectations['checked']}"),
                *error_cells(s),
                "–" if saturated is None else f"{saturated:,}",
                *speed_cells(s),
            ]
        )
    return page.table(head, rows)


def step_table(demo):
    head = ["scene", "design"] + [title for title, _ in run_section.STEP_KEYS]
    rows = []
    for name in demo.scenes:
        run = demo.runs[name]
        if not run.ran or run.summary["scene"].startswith("calibration"):  # in figures 7 and 10
            continue
        for step in run_section.steps_of(run.summary):
            numbers = [page.number(step.get(key)) for _, key in run_section.STEP_KEYS]
            rows.append([run.summary["scene"], run.summary["design"], *numbers])
    return page.table(head, rows)


def recording_table(demo):
    head = [
        "recording",
        "device time, s",
        "mismatches",
        "steps",
        "illegal",
        "reversals",
        "as known",
        *ERROR_HEAD,
        *SPEED_HEAD,
    ]
    rows = []
    for name in demo.replays:
        run = demo.runs[name]
        recording = run.job.recording
        if not run.ran:
            rows.append([recording.title, page.Cell('<span class="bad">not read</span>')])
            continue
        s, p = run.summary, run.summary["position"]
        known = "no table"
        if recording.expected:
            wrong = bool(recordings.faults(run))
            known = page.Cell(
                f'<span class="{"bad" if wrong else "good"}">'
                f'{"differs" if wrong else "yes"}</span>'
            )
        rows.append(
            [
                page.link(name, recording.title),
                page.number(s["simulated_s"]),
                page.good_or_bad(run.mismatches),
                f"{p['steps']:,}",
                f"{p['illegal']:,}",
                f"{p['reversals']:,}",
                known,
                *error_cells(s),
                *speed_cells(s),
            ]
        )
    return page.table(head, rows)


def contents(demo):
    parts = [("scenes", "scenes"), ("steps", "torque steps"), ("recordings", "recordings")]
    links = [page.link(anchor, text) for anchor, text in parts]
    links += [page.link(f.name(), f"figure {f.number}") for f in demo.figures]
    if demo.stability:
        links.append(page.link("stability", "walls"))
    links.append(page.link("runs", "each run"))
    return f"<p>{' · '.join(links)}</p>"


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


def runs_section(demo):
    parts = []
    for name in demo.scenes + demo.replays:
        run = demo.runs[name]
        if run.ran:
            title = f"{run_section.subject(run.summary)}, design {run.design}"
            if run.job.recording is not None:
                title = run.job.recording.title
            text = run_section.inside(run.summary, demo.pictures.get(name, []))
            parts.append(page.folded(name, title, text))
    return page.section("runs", "Each run", "\n".join(parts))


def document(demo):
    ran = sum(run.ran for run in demo.runs.values())
    good = (
        f"0 mismatches between RTL and twin in {demo.clocks:,} clocks "
        f"({demo.simulated_s:.1f} s of device time, {ran} runs)"
    )
    version = next((r.summary.get("version", "") for r in demo.runs.values() if r.ran), "")
    body = "<h1>feltgate demo</h1>" + page.verdict(demo.wrong, good)
    body += page.paragraph(
        "A DSP core for haptic devices, from encoder pins to PWM pins. Its SystemVerilog runs here "
        "beside its bit-exact C++ twin, every output compared in every clock, in closed loop with "
        "a modelled motor, lever and hand, and on recordings of real encoders. Errors are against "
        "the same chain in 113-bit arithmetic on the same sampled counts; speed is simulated "
        "seconds per second spent in an engine. Everything is simulation: nothing ran on a board."
    )
    body += page.paragraph(
        f"feltgate {version}, {time.strftime('%Y-%m-%d %H:%M')}, {os.cpu_count()} cores "
        f"({platform.machine()}), {clock_text(demo.took_s)} minutes",
        soft=True,
    )
    body += contents(demo)
    body += page.section("scenes", "Scenes, closed loop", scene_table(demo))
    body += page.section("steps", "Torque steps", step_table(demo))
    replays = recordings_text(demo) + recording_table(demo)
    if demo.unreadable:
        replays += page.paragraph("Could not be read:") + page.bullets(demo.unreadable)
    body += page.section("recordings", "Encoder recordings, open loop", replays)
    if demo.figures:
        body += page.section(
            "figures",
            "The paper's figures, redrawn from RTL",
            page.paragraph(
                "Broad pale blue is the RTL, thin dark red the same chain in 113-bit floating "
                "point, dashed black the ideal, green the modelled motor. Design paper has the "
                "published numbers, lever those of the motor that is really there."
            ),
        )
        body += "".join(figure.html() for figure in demo.figures)
    if demo.stability:
        body += stability_section.html(demo.stability)
    body += runs_section(demo)
    return page.document("feltgate demo", body)
