#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The main job: every scene in closed loop and recordings whole, through RTL and twin.

Writes demo.html (one file, pictures inside, no network) and demo.json, and prints the page's path
last. The exit code is 1 if there was a mismatch or a broken expectation; these are listed before.
Documentation: docs/figures.md
"""

import json
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import command_line
import interrupts
import outputs
from outputs import write_whole
from reports import all_figures, demo_page, observer_section, recordings, runs
from reports.progress import clock_text

SCHEMA = "feltgate-demo/1"
EPILOG = """\
Without recordings it says where public ones can be downloaded.
  feltgate demo
  feltgate demo --traces recordings -o report
  feltgate demo --all
Exit code: 0 nothing broken, 1 a mismatch or a broken expectation, 2 unusable input."""
DESIGNS = ("lever", "paper")
# Velocity alone would leave half of the core idle: the damper makes torque of it.
REPLAY_SCENE = "damper"


# Further scenes of devices that others show already, and long ones.
ALL_ONLY = (
    *("wall_tracked", "ceiling_tracked", "end_stops_thrown", "material_fabric", "material_water"),
    *("material_object", "coupled_levers_drag", "coupled_levers_free"),
    *("pantograph_wall", "pantograph_wall_filtered"),  # over a minute each
)


def scene_jobs(everything=False):
    """(jobs, those of devices of several axes): every scene on the design that it needs, on lever
    where it needs none; those in which the published design teaches something on paper too."""
    files = {path.stem: runs.read_toml(path) for path in runs.SCENES.glob("*.toml")}
    names = [n for n in sorted(files) if everything or n not in ALL_ONLY]
    single = [n for n in names if "device" not in files[n]]
    jobs = [runs.scene_job(n, runs.design_of(n)) for n in single]
    on_paper = [n for n in single if n.startswith(("torque_step", "calibration_"))]
    jobs += [runs.scene_job(n, "paper") for n in on_paper]
    return jobs, [runs.scene_job(n, runs.design_of(n)) for n in names if n not in single]


def all_jobs(scenes, replays, figures):
    """Each run once: figures use the runs of the scenes, with the finer rows of the two."""
    jobs = {job.name: job for job in scenes + replays}
    for job in figures:
        if job.name not in jobs or job.every < jobs[job.name].every:
            jobs[job.name] = job
    return list(jobs.values())


def find_recordings(named, everything=False):
    """(recordings, where they lie). Without any: those of the project itself."""
    where = recordings.folder(named)
    if found := recordings.find(where, everything):
        return found, where
    print(recordings.SOURCES, file=sys.stderr)
    return recordings.find(recordings.OWN), recordings.OWN


def write(folder, demo):
    """demo.json and demo.html; the path of the page."""
    summary = {
        "schema": SCHEMA,
        "took_s": round(demo.took_s, 1),
        "cores": os.cpu_count(),
        "simulated_s": demo.simulated_s,
        "clocks": demo.clocks,
        "mismatches": demo.mismatches,
        "broken": demo.wrong,
        "unreadable": demo.unreadable,
        "runs": {name: run.summary for name, run in demo.runs.items() if run.ran},
        "figures": [figure.summary() for figure in demo.figures],
    }
    text = json.dumps(summary, indent=1, ensure_ascii=False)
    write_whole(folder / "demo.json", text + "\n")
    path = folder / "demo.html"
    write_whole(path, demo_page.document(demo))
    return path


def guesses_that_failed(done):
    """Recordings that were tried with guesses and could not be read."""
    failed = (r for r in done.values() if not r.ran and r.job.recording and not r.job.recording.sure)
    return [f"{r.job.recording.title}: {r.complaint}" for r in failed]


def drawn(names, done, jobs):
    """{name: its pictures} of the runs that ended."""
    there = [name for name in names if done[name].ran]
    with ProcessPoolExecutor(jobs, initializer=interrupts.leave_signals_to_the_parent) as pool:
        return dict(zip(there, pool.map(demo_page.draw, (done[name] for name in there))))


def arguments_of(argv):
    parser = command_line.parser(
        "demo",
        "Every object in closed loop and recordings whole, through RTL and twin in\n"
        "lock-step; one HTML report. About half an hour on two cores.",
        EPILOG,
    )
    what = "recordings; default: FELTGATE_TRACES, ../shared/traces"
    parser.add_argument("--traces", metavar="DIR", help=what)
    command_line.add_folder(parser, "default: demo in build")
    command_line.add_flags(parser, all="scenes and recordings that are left out for time, too")
    what = "runs at a time; default: all cores"
    parser.add_argument("--jobs", type=command_line.whole(1), metavar="N", help=what)
    command_line.add_flags(parser, no_figures="leave out the runs that only the figures need")
    command_line.add_only_arguments(parser)
    arguments = parser.parse_args(argv)
    outputs.check_folder(parser, "-o", arguments.out)
    if arguments.traces and not Path(arguments.traces).is_dir():
        parser.error(f"--traces {arguments.traces}: no such folder")
    return arguments


def run(arguments):
    """The exit code."""
    folder = (arguments.out or runs.build_folder() / "demo").resolve()
    began = time.monotonic()
    with outputs.new_folder(folder):
        found, where = find_recordings(arguments.traces, arguments.all)
        scenes, devices = scene_jobs(arguments.all)
        replays = [recordings.job(r, i, "lever", REPLAY_SCENE) for i, r in enumerate(found, 1)]
        figures = [] if arguments.no_figures else all_figures.jobs(DESIGNS, quick=True) + observer_section.jobs()
        jobs = all_jobs(scenes + devices, replays, figures)
        total = sum(job.seconds for job in jobs)
        print(
            f"demo: {len(scenes) + len(devices)} scenes, {len(replays)} recordings in {where}, "
            f"{len(jobs) - len(scenes) - len(devices) - len(replays)} more runs for the figures; "
            f"{total:.0f} s of device time",
            file=sys.stderr,
        )
        done = runs.run_all("demo", jobs, folder / "data", arguments.jobs)
        demo = demo_page.Demo(
            runs=done,
            scenes=[job.name for job in scenes],
            devices=[job.name for job in devices],
            replays=[job.name for job in replays],
            figures=[] if arguments.no_figures else all_figures.draw(done, DESIGNS),
            wrong=recordings.all_faults(done),
            unreadable=guesses_that_failed(done),
            where=where,
            own=where == recordings.OWN,
        )
        demo.drawn = drawn(demo.shown, done, arguments.jobs)
        demo.took_s = time.monotonic() - began
        path = write(folder, demo)
    for line in demo.unreadable:
        print(f"demo: could not read {line}", file=sys.stderr)
    for line in demo.wrong:
        print(f"demo: {line}", file=sys.stderr)
    print(
        f"demo: {demo.mismatches:,} mismatches in {demo.clocks:,} clocks, {len(demo.wrong)} things "
        f"wrong, {clock_text(demo.took_s)} min"
    )
    print(path)
    return 1 if demo.wrong else 0


def main(argv=None):
    arguments = arguments_of(argv)
    if arguments.only_arguments:
        return 0
    return command_line.ended("demo", lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())
