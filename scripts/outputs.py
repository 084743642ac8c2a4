# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Files that appear completely or not at all, as the program's do. Documentation: docs/json.md"""

import contextlib
import io
import json
import os
import stat
import sys
import tempfile
import wave
from pathlib import Path

STDOUT = "-"


def is_in_place(path):
    """Whether a path is stdout, a device or a pipe, which are written where they are."""
    if str(path) == STDOUT:
        return True
    try:
        mode = os.stat(path).st_mode
    except OSError:
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def is_stdout(path):
    """Whether a path is stdout, by this or another name."""
    try:
        return (
            str(path) == STDOUT
            or os.path.samestat(os.stat(path), os.fstat(1))
            and is_in_place(path)
        )
    except OSError:
        return False


def refusal(path):
    """Why nothing can be written there, with what to do, or ""."""
    path = Path(path)
    if is_in_place(path):
        return "" if str(path) == STDOUT or os.access(path, os.W_OK) else "is not writable"
    if path.is_dir():
        return "is a folder; add the name of a file in it"
    folder = Path(os.path.realpath(path)).parent
    if not folder.is_dir():
        return f"there is no folder {folder}; make it, or choose another one"
    if not os.access(folder, os.W_OK | os.X_OK):
        return f"the folder {folder} cannot be written; choose another one"
    if path.exists() and not os.access(path, os.W_OK):
        return "is write-protected; choose another name, or chmod u+w"
    return ""


def check(parser, reads=(), **paths):
    """Ends with 2, before the work, where an option's path cannot be written: json=path. `reads`
    are files that the command reads, which no output may replace. Where an output goes to stdout
    the text for people goes to stderr from now on."""
    taken = {
        os.path.realpath(path): "is read by the same command"
        for path in reads
        if path and os.path.exists(path)
    }
    for option, path in paths.items():
        why = refusal(path) if path else ""
        if path and not why and not is_in_place(path):
            place = os.path.realpath(path)
            why = taken.get(place, "")
            taken[place] = f"is also that of --{option}"
        if why:
            parser.error(f"--{option} {path}: {why}")
        if path and is_stdout(path):
            sys.stdout = sys.stderr


def check_folder(parser, option, path):
    """Ends with 2, before the work, where an option's folder cannot be one."""
    if path and Path(path).exists() and not Path(path).is_dir():
        parser.error(f"{option} {path}: is no folder; give a folder's name")


@contextlib.contextmanager
def new_folder(path):
    """A folder that is made where it is not there, and goes again where nothing came into it."""
    path = Path(path)
    made = [one for one in (path, *path.parents) if not one.exists()]
    path.mkdir(parents=True, exist_ok=True)
    try:
        yield path
    finally:
        inside = [one for one in path.rglob("*") if one.is_dir()] if made else []
        for one in (*sorted(inside, reverse=True), *made):
            with contextlib.suppress(OSError):
                one.rmdir()


@contextlib.contextmanager
def kept_or_temporary(folder, command):
    """The folder of --keep, made where it is not there; without one a temporary folder."""
    if folder:
        folder.mkdir(parents=True, exist_ok=True)
        yield folder.resolve()
        return
    with tempfile.TemporaryDirectory(prefix=f"feltgate-{command}-") as temporary:
        yield Path(temporary)


def write_json(path, value):
    """An object, with a line for each of its parts."""
    write_whole(path, json.dumps(value, indent=1) + "\n")


def write_wav(path, samples, rate_hz):
    """Samples of full scale 1 as a WAV file of one channel and 16 bits."""
    sound = io.BytesIO()
    with wave.open(sound, "wb") as out:
        out.setnchannels(1)
        out.setsampwidth(2)
        out.setframerate(rate_hz)
        out.writeframes((samples * 32767).astype("<i2").tobytes())
    write_whole(path, sound.getvalue())


def write_whole(path, data):
    """Text or bytes. A symbolic link stays, its target is replaced and keeps its mode."""
    data = data.encode("utf-8", "surrogateescape") if isinstance(data, str) else data
    if str(path) == STDOUT:
        sys.__stdout__.flush()
        sys.__stdout__.buffer.write(data)
        sys.__stdout__.buffer.flush()
        return
    if is_in_place(path):
        with open(path, "wb", buffering=0) as device:
            device.write(data)
        return
    target = os.path.realpath(path)
    folder, name = os.path.split(target)
    part = os.path.join(folder, f"{name[:200]}.{os.getpid()}.part")
    try:
        with open(part, "xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
            if os.path.exists(target):
                os.fchmod(file.fileno(), stat.S_IMODE(os.stat(target).st_mode))
        os.replace(part, target)
    except BaseException:
        Path(part).unlink(missing_ok=True)
        raise
