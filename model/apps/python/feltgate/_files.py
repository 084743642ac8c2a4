# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Where scenes, plants and designs lie: beside this package, or in FELTGATE_ROOT."""

import difflib
import os
import warnings
from pathlib import Path
from typing import List, Union

from feltgate import _core

PathLike = Union[str, "os.PathLike[str]"]

_DATA = Path(__file__).parent / "data"
SCENES, PLANTS, DESIGNS = "vectors/scenes", "vectors/plants", "rtl/designs"
LAWS = "rtl/laws"


def root() -> Path:
    """The folder with vectors/ and rtl/: FELTGATE_ROOT of the environment, else the package's own."""
    return Path(os.environ.get("FELTGATE_ROOT") or _DATA)


def _names(folder: str, suffix: str = ".toml") -> List[str]:
    return sorted(path.stem for path in (root() / folder).glob("*" + suffix))


def scenes() -> List[str]:
    """Names of the scenes that run() knows."""
    return _names(SCENES)


def plants() -> List[str]:
    """Names of the plants: motor, lever, friction, encoder, supply."""
    return _names(PLANTS)


def designs() -> List[str]:
    """Names of the designs that are compiled into this package."""
    return sorted([*_core.design_names(), *_core.extra_designs])


def find(name: PathLike, folder: str, suffix: str = ".toml") -> str:
    """The file of a name in a folder, or the path that was given. Raises ValueError."""
    text = os.fspath(name)
    if os.sep in text or text.endswith(suffix):
        if not os.path.isfile(text):
            raise ValueError(f"{text}: there is no such file; check the path")
        return text
    path = root() / folder / f"{text}{suffix}"
    if path.is_file():
        return str(path)
    names = _names(folder, suffix)
    near = difflib.get_close_matches(text, names, n=1)
    hint = f"did you mean \"{near[0]}\"? " if near else ""
    raise ValueError(f"\"{text}\" is not in {folder}; {hint}choose one of {', '.join(names)} "
                     "or give the path of a file")


def design_files(design: str) -> "tuple[str, str]":
    """TOML of a design and of the registers. Raises ValueError for one that is not compiled in, or whose
    TOML says something else than what was compiled in."""
    if design not in designs():
        near = difflib.get_close_matches(str(design), designs(), n=1)
        hint = f"did you mean \"{near[0]}\"? " if near else ""
        raise ValueError(f"design \"{design}\" is not built in; {hint}"
                         f"choose one of {', '.join(designs())}")
    registers = str(root() / "rtl/registers.toml")
    inside = _DATA / DESIGNS / f"{design}.toml"
    toml = root() / DESIGNS / f"{design}.toml"
    if not toml.is_file():
        toml = inside
    _core.require_current(design, str(toml), registers)
    if toml == inside:
        _tell_if_changed(design, registers)
    return str(toml), registers


def _tell_if_changed(design: str, registers: str) -> None:
    """Warns where the file that this package was installed from says something else today."""
    listed = (_DATA / DESIGNS / "installed_from.txt").read_text(encoding="utf-8").splitlines()
    toml = dict(line.split("=", 1) for line in listed).get(design, "")
    if os.path.isfile(toml):
        try:
            _core.require_current(design, toml, registers)
        except ValueError as error:
            warnings.warn(f"{error}; until then this package goes by its own copy", stacklevel=4)
