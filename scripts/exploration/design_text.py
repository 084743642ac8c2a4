# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A point as a design file: the base's text, with the lines changed that the point sets; and as a
program of its own.

Documentation: docs/speed-for-accuracy.md
"""

import json
import os
import re
from pathlib import Path

import building
import command_line
import interrupts
import outputs
from exploration import space

# Of two such keys a design has one: setting one takes the other out.
ALTERNATIVES = (("velocity.n", "velocity.gain"), ("control.kp", "control.kp_1_kg_m2"))


def toml_value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, list):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    return repr(value)


def header(lines, section):
    """Index of the line [section], None where there is none."""
    found = [i for i, line in enumerate(lines) if re.match(rf"\[{re.escape(section)}\]", line)]
    return found[0] if found else None


def key_line(lines, section, key):
    """Index of the line of a key, None where the section has none."""
    start = header(lines, section)
    if start is None:
        return None
    for i in range(start + 1, len(lines)):
        if lines[i].startswith("["):
            return None
        if re.match(rf"{re.escape(key)}\s*=", lines[i]):
            return i
    return None


def put(lines, full_key, value):
    section, key = full_key.rsplit(".", 1)
    text = f"{key} = {toml_value(value)}"
    at = key_line(lines, section, key)
    for pair in ALTERNATIVES:
        if at is None and full_key in pair:
            other = pair[pair[0] == full_key]
            at = key_line(lines, section, other.rsplit(".", 1)[1])
    if at is not None:
        lines[at] = text  # a comment on the old value would be wrong
        return
    start = header(lines, section)
    if start is None:
        lines += ["", f"[{section}]", text]
    else:
        lines.insert(start + 1, text)


def design_text(root, point):
    """Text of the design file that a point stands for."""
    text = space.design_path(root, point["base"]).read_text(encoding="utf-8")
    lines = text.rstrip("\n").split("\n")
    # Its self-test is off unless it is set: the pulse is made for the base's tick.
    off = {} if header(lines, "self_test") is None else {"self_test.mode": "off"}
    for key, value in (off | point["set"]).items():
        put(lines, key, value)
    if point["set"].get("velocity.estimator") == "mt":  # then these are refused
        of_n_method = {key_line(lines, "velocity", key) for key in ("m1", "n", "gain")}
        lines = [line for i, line in enumerate(lines) if i not in of_n_method]
    return "\n".join(lines) + "\n"


def described(text, point):
    """The design's text with a head and a description of its own, not those of its base."""
    what = f"{point['base']} with " + ", ".join(f"{k} = {v}" for k, v in point["set"].items())
    text = re.sub(r"\A(#.*\n)*", lambda _: f"# {what}: written by `feltgate choose`.\n", text)
    line = f"description = {json.dumps(what)}"
    return re.sub(r"^description = .*$", lambda _: line, text, count=1, flags=re.M)


def own_program(command, name, text):
    """Builds feltgate_NAME, a program with this design, in the build folder; the environment in which
    it knows the design's file: the repository, by links, with that among the others."""
    build, root = command_line.build_folder(), command_line.root()
    folder = build / "own" / name
    generated, file, shadow = folder / "feltgate/generated", folder / f"{name}.toml", folder / "root"
    generated.mkdir(parents=True, exist_ok=True)
    outputs.write_whole(file, text)
    words = [build / "feltgate_generate", root, "--design", file, "--output", generated]
    done = interrupts.run(words, **interrupts.CAPTURED)  # it leaves what has not changed
    if done.returncode:
        raise command_line.Refused(done.stderr.strip() or f"{name}: feltgate_generate failed")
    for source in (*root.iterdir(), *(root / "rtl").iterdir(), *(root / "rtl/designs").iterdir(), file):
        at = shadow / (Path("rtl/designs") / file.name if source == file else source.relative_to(root))
        if source in (root / "rtl", root / "rtl/designs") or at.exists():
            continue
        at.parent.mkdir(parents=True, exist_ok=True)
        at.symlink_to(source.resolve())
    building.make(command, build, [f"feltgate_{name}"], os.cpu_count())
    return {"FELTGATE_ROOT": str(shadow)}
