# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The tables of the demo's page, each narrow enough for 1200 pixels.

Documentation: docs/figures.md
"""

from reports import page, recordings, run_section
from reports.headline import FIXED

NOT_RUN = page.mark(False, "did not run")
# The first columns of a run in closed loop, and of how far its torque is off.
RUN = ("scene", "design", "device time, s", "mismatches", "expectations broken")
TORQUE = ("largest torque asked for, Nm", "felt, Nm")


def fixed(summary):
    """Figures of the first back-end in fixed point."""
    engines = summary["engines"]
    return next((engines[name] for name in FIXED if name in engines), {})


def micro(value):
    return page.number(None if value is None else 1e6 * value)


def errors(summary, key, kinds=("max_error", "rms_error", "bound")):
    found = fixed(summary).get(key, {})
    return [micro(found.get(kind)) for kind in kinds]


def peaks(summary):
    """Largest torque that the scene asked for, and that the motor gave."""
    torque = summary.get("felt", {}).get("torque", {})
    return [page.number(torque.get(kind, {}).get("peak_nm")) for kind in ("asked", "motor")]


def ran(demo, names):
    return [demo.runs[name] for name in names if demo.runs[name].ran]


def of_run(run, anchor):
    """The cells below RUN."""
    s = run.summary
    expectations = s.get("expectations", {"checked": 0, "broken": []})
    broken = page.good_or_bad(len(expectations["broken"]))
    return [
        page.link(anchor, s["scene"]),
        s["design"],
        page.number(s["simulated_s"]),
        page.good_or_bad(run.mismatches),
        page.Cell(f"{broken} of {expectations['checked']}"),
    ]


def scenes(demo):
    head = [*RUN, *TORQUE, "largest error of the commanded torque, µNm", "its bound", "saturated ticks"]
    rows = []
    for name in demo.scenes:
        run = demo.runs[name]
        if not run.ran:
            rows.append([name, NOT_RUN])
            continue
        saturated = fixed(run.summary).get("saturations")
        rows.append(
            [
                *of_run(run, name),
                *peaks(run.summary),
                *errors(run.summary, "torque_nm", ("max_error", "bound")),
                "–" if saturated is None else f"{saturated:,}",
            ]
        )
    return page.table(head, rows)


def axes(demo):
    """Runs of devices of several axes: a row for each axis."""
    head = [*RUN, "axis", *TORQUE, "largest error of the engine's torque, µNm", "its bound"]
    rows = []
    for name in demo.devices:
        run = demo.runs[name]
        if not run.ran:
            rows.append([name, NOT_RUN])
            continue
        for number, axis in enumerate(run.summary["axes"]):
            rows.append(
                [
                    *of_run(run, name),
                    str(number),
                    *(page.number(axis[f"{kind}_peak_nm"]) for kind in ("asked", "motor")),
                    *(micro(axis["law_nm"].get(kind)) for kind in ("max_error", "bound")),
                ]
            )
    return page.table(head, rows)


def steps(demo):
    head = ["scene", "design"] + [title for title, _ in run_section.STEP_KEYS]
    rows = []
    for run in ran(demo, demo.scenes):
        if run.summary["scene"].startswith("calibration"):  # in figures 7 and 10
            continue
        for step in run_section.steps_of(run.summary):
            numbers = [page.number(step.get(key)) for _, key in run_section.STEP_KEYS]
            rows.append([run.summary["scene"], run.summary["design"], *numbers])
    return page.table(head, rows)


def as_known(run):
    if not run.job.recording.expected:
        return "no table"
    wrong = bool(recordings.faults(run))
    return page.mark(not wrong, "differs" if wrong else "yes")


def replays(demo):
    head = [
        *("recording", "device time, s", "steps", "illegal", "reversals"),
        *("as known", "mismatches", "largest error of the velocity, µrad/s", "its bound"),
    ]
    rows = []
    for name in demo.replays:
        run = demo.runs[name]
        if not run.ran:
            rows.append([run.job.recording.title, page.mark(False, "not read")])
            continue
        s, p = run.summary, run.summary["position"]
        rows.append(
            [
                page.link(name, run.job.recording.title),
                page.number(s["simulated_s"]),
                *(f"{p[key]:,}" for key in ("steps", "illegal", "reversals")),
                as_known(run),
                page.good_or_bad(run.mismatches),
                *errors(s, "velocity_rad_s", ("max_error", "bound")),
            ]
        )
    return page.table(head, rows, words=(0,))
