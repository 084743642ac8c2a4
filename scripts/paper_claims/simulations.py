# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What claims are simulated with: runs of the twin, the textbook loop. Called by claims.py; documentation: docs/claims.md"""
import functools
import json
import math
import os
import re
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import command_line

COUNT, TICK = 2 * math.pi / 4096, 1e-6


def scene(core, seconds, hand, *motion, more="", arm_s=0.05):
    """Text of a scene: the hand's kind, and its motion or torque as (kind, seconds, to)."""
    key, to = ("torque", "to_nm") if hand == "torque" else ("motion", "to_rad")
    steps = "".join(f'{{ kind = "{kind}", duration_s = {length!r}' + (f", {to} = {at[0]!r} }}," if at else " },")
                    for kind, length, *at in motion)
    return f'title = "-"\nabout = "-"\nduration_s = {seconds!r}\n[core]\nscene = "{core}"\narm_s = {arm_s}\n{more}\n' \
        f'[[hand.phase]]\nkind = "{hand}"\n' + (f"{key} = [{steps}]\n" if steps else "")


@functools.lru_cache(None)
def run(scene, design="lever", plant="p24", constants=(), given=(), every=0):
    """Figures, what was felt, and columns of every n-th tick of `feltgate run`. A scene is a name, or its text; constants
    of the plant and parameters of the core are pairs of name and value."""
    with tempfile.TemporaryDirectory(prefix="feltgate-claims-") as name:
        folder = Path(name)
        if "\n" in scene:
            (folder / "scene.toml").write_text(scene, encoding="utf-8")
            scene = folder / "scene.toml"
        if constants:
            text = (command_line.root() / f"vectors/plants/{plant}.toml").read_text(encoding="utf-8")
            for key, value in constants:
                text = re.sub(rf"(?m)^{key} = .*", f"{key} = {value!r}", text)
            plant = folder / "plant.toml"
            plant.write_text(text, encoding="utf-8")
        words = [scene, "--design", design, "--plant", plant, "--engine", "twin", "--quiet"]
        words += [word for key, value in given for word in ("--set", f"{key}={float(value)!r}")]
        words += ["--csv", folder / "rows.csv", "--every", str(every)] if every else []
        found, rows = feltgate("run", *words, good=(0, 1)), {}  # 1: another plant breaks the scene's expectations
        if every:
            with open(folder / "rows.csv", encoding="utf-8") as file:
                rows = dict(zip(file.readline().strip().split(","), np.loadtxt(file, delimiter=",", unpack=True)))
        return found["figures"], found["felt"], rows


def feltgate(*words, good=(0,)):
    """What a command writes to --json."""
    program = os.environ.get("FELTGATE_PROGRAM") or command_line.build_folder() / "feltgate"
    with tempfile.NamedTemporaryFile(prefix="feltgate-claims-") as file:
        done = subprocess.run([program, *map(str, words), "--json", file.name], capture_output=True, text=True, check=False)
        if done.returncode not in good:
            raise command_line.Refused(f"feltgate {words[0]} {words[1]} failed: {done.stderr.strip()}")
        return json.loads(Path(file.name).read_text(encoding="utf-8"))


def flow(rate, seconds):
    """exp(rate * seconds): a short Taylor series, squared ten times."""
    step, term, total = rate * seconds / 1024, np.eye(len(rate)), np.eye(len(rate))
    for i in range(1, 10):
        term = term @ step / i
        total = total + term
    return np.linalg.matrix_power(total, 1024)


def radius(k, m, b, T, bv=0.0, lag=0.0, dead=0.0, kept=0.0):
    """Largest eigenvalue of a period of the textbook loop: a mass with friction b on a wall k, bv; velocity by backward
    difference, of which `kept` stays from the one before; the force is held, late by `dead`, through a lag.
    States: position, speed, force, command, position and velocity of the sample before, commands under way."""
    whole, rest = int(dead / T + 1e-9), dead % T
    rate, same = np.zeros((7 + whole, 7 + whole)), np.eye(7 + whole)
    rate[0, 1], rate[1, 1], rate[1, 2 if lag else 3] = 1, -b / m, 1 / m
    rate[2, 2], rate[2, 3] = -1 / (lag or T), 1 / lag if lag else 0
    sample, take = same.copy(), same.copy()
    sample[6:-1] = same[7:]
    sample[5] = kept * same[5] + (1 - kept) / T * (same[0] - same[4])
    sample[4] = same[0]
    sample[-1] = -k * same[0] - bv * sample[5]
    take[3] = same[6]
    return abs(np.linalg.eigvals(flow(rate, T - rest) @ take @ flow(rate, rest) @ sample)).max()


def largest(stable, low):
    """The largest value that is stable, from a small one upwards, by bisection."""
    high = low
    while stable(high):
        low, high = high, 1.2 * high
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


def stiffest(start, **loop):
    return largest(lambda k: radius(k, **loop) < 1, 1e-3 * start)


def turned(to_rad, seconds, design, every, given=()):
    """Columns of a run in which a hand turns a lever evenly, with nothing rendered."""
    way = ("hold", 0.001), ("ramp", seconds, to_rad)
    return run(scene("free", max(seconds, 0.003) + 0.001, "prescribed", *way), design, given=given, every=every)[2]


def settled(rows, column, from_s, to_s=9.0):
    return rows[column][(rows["time_s"] > from_s) & (rows["time_s"] < to_s)]


def pushed(seconds, push, count_nm, more=""):
    """A scene: a hand pushes into a wall at 0 of so much torque a count."""
    wall = f"[parameters]\nwall_contact = 0\nwall_damping = 0.005\nwall_stiffness = {count_nm!r}"
    return scene("wall", seconds, "torque", push, more=more + wall)
