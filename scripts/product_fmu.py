# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""`feltgate product fmu`: a scene with its plant and the twin of a design as one FMI 3.0 file.

Documentation: docs/other-tools.md
"""

import ctypes
import io
import platform
import zipfile
from pathlib import Path

import building
import command_line
from synth_tools import require_current

# Without a time of its own: the same scene gives the same file.
EPOCH = (1980, 1, 1, 0, 0, 0)


class FmuError(command_line.Refused):
    """A design or scene of which no FMU can be made."""


class Library:
    """The library of a design: it describes itself, so that what it says is what it does."""

    def __init__(self, path):
        self.path = path
        try:
            self._library = ctypes.CDLL(str(path))
        except OSError as error:
            raise FmuError(f"{path} cannot be loaded: {error}") from None
        for name in ("plant", "description", "error"):
            getattr(self._library, f"feltgate_fmu_{name}").restype = ctypes.c_char_p

    def ask(self, name, *paths):
        """The text of feltgate_fmu_NAME."""
        said = getattr(self._library, f"feltgate_fmu_{name}")(*(str(p).encode() for p in paths))
        if said is None:
            raise FmuError(self._library.feltgate_fmu_error().decode())
        return said.decode()


def scene_path(root, scene):
    """Of a name in vectors/scenes, or of a file, which is looked for before anything is built."""
    if "/" in scene or scene.endswith(".toml"):
        if not Path(scene).is_file():
            raise FmuError(f"{scene}: there is no such file; check the path")
        return Path(scene)
    path = root / f"vectors/scenes/{scene}.toml"
    if not path.is_file():
        names = ", ".join(sorted(p.stem for p in path.parent.glob("*.toml")))
        raise FmuError(f'"{scene}" is not in vectors/scenes; give the path of a file, or one of {names}')
    return path


def library_of(design):
    """The library of a design, up to date where the build folder is one of CMake's."""
    build = command_line.build_folder()
    path = build / f"feltgate_fmu_{design}.so"
    if (build / "build.ninja").is_file():
        if f"build feltgate_fmu_{design}.so:" not in (build / "build.ninja").read_text("utf-8"):
            raise FmuError(f"--design {design}: an FMU is of a design with one axis and no engine")
        building.make("product", build, [path.stem], 2)
    if not path.is_file():
        raise FmuError(f"--design {design}: there is no {path}; choose lever, or build {path.stem}")
    return Library(path)


def fmu(root, design, scene):
    """The bytes of the file."""
    scene_file = scene_path(root, scene)
    if (root / f"rtl/designs/{design}.toml").is_file():
        require_current(root, design)
    library = library_of(design)
    plant = library.ask("plant", scene_file, root / "vectors/plants")
    description = library.ask("description", scene_file, plant)
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
    parts = {
        "modelDescription.xml": description.encode(),
        f"binaries/{machine}-linux/{library.path.name}": library.path.read_bytes(),
        "resources/scene.toml": scene_file.read_bytes(),
        "resources/plant.toml": Path(plant).read_bytes(),
    }
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in parts.items():
            archive.writestr(zipfile.ZipInfo(name, EPOCH), data, zipfile.ZIP_DEFLATED)
    return whole.getvalue()
