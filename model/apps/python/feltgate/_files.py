# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Where scenes, plants and designs lie: beside this package, or in FELTGATE_ROOT."""

import difflib
import os
from pathlib import Path
from typing import List, Union

from feltgate import _core

PathLike = Union[str, "os.PathLike[str]"]

_DATA = Path(__file__).parent / "data"
SCENES, PLANTS, DESIGNS = "vectors/scenes", "vectors/plants", "rtl/designs"
LAWS = "rtl/laws"
_core.set_data(str(_DATA))


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
    """Names of the designs; wherever one is asked for, the path of a design file does, too."""
    return sorted({*_names(DESIGNS), *(path.stem for path in (_DATA / DESIGNS).glob("*.toml"))})


def find(name: PathLike, folder: str, suffix: str = ".toml") -> str:
    """The file of a name in a folder, or the path that was given. Raises ValueError."""
    text = os.fspath(name)
    if os.sep in text or text.endswith(suffix):
        if not os.path.isfile(text):
            raise ValueError(f"{text}: there is no such file; check the path")
        return text
    for place in (root(), _DATA) if folder == DESIGNS else (root(),):
        path = place / folder / f"{text}{suffix}"
        if path.is_file():
            return str(path)
    names = designs() if folder == DESIGNS else _names(folder, suffix)
    near = difflib.get_close_matches(text, names, n=1)
    hint = f"did you mean \"{near[0]}\"? " if near else ""
    raise ValueError(f"\"{text}\" is not in {folder}; {hint}choose one of {', '.join(names)} "
                     "or give the path of a file")


def design_files(design: str) -> "tuple[str, str]":
    """TOML of a design and of the registers. Raises ValueError for one that is not there."""
    return find(design, DESIGNS), str(root() / "rtl/registers.toml")
