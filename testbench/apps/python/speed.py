# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""How fast feltgate.run() is beside the program feltgate, both on the twin alone.

  python3 testbench/apps/python/speed.py [--scene membrane] [--seconds S] [--repeat 5]

The program runs the scene and writes no rows; Python runs it with every column of every tick in
arrays (every=1) and with the default of about 20 000 rows. They take turns, and the best of each
counts; the time is that of the processor, so that what else the machine does counts for little.
What the program does besides (start, read files) is timed with it, as is all of the call in Python.
FELTGATE_BUILD: where the program is.
"""

import argparse
import os
import re
import resource
import subprocess
import tempfile
from pathlib import Path

import feltgate

ROOT = Path(os.environ.get("FELTGATE_ROOT", Path(__file__).resolve().parents[3]))
PROGRAM = Path(os.environ.get("FELTGATE_BUILD", ROOT / "build")) / "feltgate"


def scene_of(name, seconds, folder):
    """A scene file of that length without expectations, which hold for the whole only."""
    text = (ROOT / f"vectors/scenes/{name}.toml").read_text(encoding="utf-8")
    text = text.split("[[expect]]")[0]
    if seconds is not None:
        text = re.sub(r"(?m)^duration_s = .*$", f"duration_s = {seconds}", text)
    path = Path(folder) / f"{name}.toml"
    path.write_text(text, encoding="utf-8")
    return path


def processor_s():
    """Time that this process and the programs it ran have spent on a processor."""
    uses = map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(use.ru_utime + use.ru_stime for use in uses)


def timed(call):
    start = processor_s()
    call()
    return processor_s() - start


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", default="membrane")
    parser.add_argument("--seconds", type=float, help="simulated; default: the scene's own")
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = scene_of(options.scene, options.seconds, folder)
        ways = {
            "program": lambda: subprocess.run(
                [PROGRAM, "run", scene, "--engine", "twin", "--quiet"], check=True),
            "Python, every tick": lambda: feltgate.run(scene, engine="twin", every=1),
            "Python": lambda: feltgate.run(scene, engine="twin"),
        }
        ticks = feltgate.run(scene, engine="twin").ticks
        best = {name: min(times) for name, times in zip(ways, zip(
            *([timed(way) for way in ways.values()] for _ in range(options.repeat))))}
    for name, seconds in best.items():
        print(f"{name:20} {ticks / seconds / 1e6:7.3f} million ticks/s"
              f"   {best['program'] / seconds:5.2f} of the program's speed")


if __name__ == "__main__":
    main()
