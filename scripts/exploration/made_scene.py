# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Scene and law files that `feltgate choose` writes: a scene with other values, a law with a rate, a
motion for a law that has no scene. Documentation: docs/speed-for-accuracy.md
"""

import difflib
import re
import tomllib
from pathlib import Path

import command_line
from command_line import Refused
from exploration.design_text import toml_value

# There is no motion in a law file: a hand that comes from the middle, goes both ways, and rests.
SWEEP = """title = "The law {name}"
about = "A hand sweeps 0.8 rad to both sides, to 17 rad/s, and rests there."
duration_s = 0.62

[core]
scene = "law"
law = "{law}"
arm_s = 0.02

[hand]
[[hand.phase]]
kind = "prescribed"
motion = [
  {{ kind = "hold", duration_s = 0.05 }},
  {{ kind = "minimum_jerk", duration_s = 0.12, to_rad = 0.8 }},
  {{ kind = "hold", duration_s = 0.05 }},
  {{ kind = "minimum_jerk", duration_s = 0.18, to_rad = -0.8 }},
  {{ kind = "hold", duration_s = 0.05 }},
  {{ kind = "minimum_jerk", duration_s = 0.12, to_rad = 0.0 }},
  {{ kind = "hold", duration_s = 0.05 }},
]

[[expect]]
figure = "mismatches"
high = 0
"""


def named(given):
    """(path of a scene, None) or (None, path of a law)."""
    root, path = command_line.root(), Path(given)
    scenes = {p.stem: p for p in root.glob("vectors/scenes/*.toml")}
    laws = {p.stem: p for p in root.glob("rtl/laws/*.law")}
    scene = scenes.get(given) or (path if given.endswith(".toml") else None)
    law = laws.get(given) or (path if given.endswith(".law") else None)
    found = scene or law
    if found is None:
        near = difflib.get_close_matches(given, [*scenes, *laws], 1)
        mend = f"did you mean {near[0]}? Or " if near else ""
        raise Refused(
            f'"{given}" is neither a scene nor a law; {mend}give a name in vectors/scenes or rtl/laws, '
            "or the path of a .toml or .law file"
        )
    if not found.is_file():
        raise Refused(f"{given}: there is no such file; give one, or a name in vectors/scenes or rtl/laws")
    return (scene, None) if scene else (None, law)


def inline(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {inline(v)}" for key, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(inline(v) for v in value) + "]"
    return toml_value(value)


def toml_text(head, scene):
    """The text of a scene file."""
    lines = [f"# {line}" for line in head]
    tables = {key: value for key, value in scene.items() if isinstance(value, dict)}
    lines += [f"{key} = {inline(v)}" for key, v in scene.items() if key not in tables]
    for name, table in tables.items():
        lines += ["", f"[{name}]", *(f"{key} = {inline(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def linear_plant(scene):
    """The scene's plant as the margins of `feltgate rates` take it: linear, its viscous friction on."""
    name = scene.get("plant", "p24")
    own = "/" in name or name.endswith(".toml")
    path = Path(name) if own else command_line.root() / "vectors/plants" / f"{name}.toml"
    plant = tomllib.loads(path.read_text(encoding="utf-8"))
    on = ("inductance", "back_emf", "viscous")
    effects = plant["effects"] | scene.get("effects", {}) | {"viscous": True}
    plant["effects"] = {key: key in on and effects[key] for key in plant["effects"]}
    plant["motor"]["dead_voltage_v"] = plant["supply"]["diode_drop_v"] = 0.0
    return toml_text(["Linear, with viscous friction."], plant)


def moved(value, folder):
    """A scene's value for a file elsewhere: names of files beside the scene become whole paths."""
    if isinstance(value, dict):
        return {key: moved(v, folder) for key, v in value.items()}
    if isinstance(value, list):
        return [moved(v, folder) for v in value]
    is_name = isinstance(value, str) and re.fullmatch(r"[\w./+-]+\.\w+", value)
    return str((folder / value).resolve()) if is_name and (folder / value).is_file() else value


def with_values(scene, **values):
    """The scene with these parameters; what it sets itself stays."""
    all_of = values | scene.get("parameters", {})
    return scene | ({"parameters": all_of} if all_of else {})


def cut(scene, seconds):
    """The scene's first seconds, without expectations of its end."""
    if scene["duration_s"] <= seconds:
        return scene
    events = [e for e in scene.get("event", []) if e["at_s"] < seconds]
    short = {key: v for key, v in scene.items() if key not in ("expect", "event", "rest")}
    return short | {"duration_s": seconds} | ({"event": events} if events else {})


def law_at(text, rate_hz):
    """The law with a rate: in its own line, or as the first statement."""
    line = f"rate = {rate_hz:.9g} Hz"
    text, found = re.subn(r"^rate\s*=[^#\n]*", line + "  ", text, count=1, flags=re.M)
    if found:
        return text
    head = re.match(r"(?:[ \t]*(?:#.*)?\n)*", text).end()
    return f"{text[:head]}{line}\n{text[head:]}"


def law_path(root, scene_path, scene):
    """The file of a scene's law; None: it has none."""
    name = scene["core"].get("law")
    if not name:
        return None
    own = "/" in name or name.endswith(".law")
    return Path(scene_path).parent / name if own else root / "rtl/laws" / f"{name}.law"
