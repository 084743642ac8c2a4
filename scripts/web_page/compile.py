# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Compiles the twin, the plant and the stability study to WebAssembly with Debian's Emscripten."""

import concurrent.futures
import os
import re
import shutil

import interrupts

# Boost.Interval wants to know how to set a rounding mode; ours (bounds::Outward) never does.
FLAGS = "-std=c++17 -O3 -fexceptions -DFMT_HEADER_ONLY -D__USE_ISOC99=1".split()
# TinyGLTF reads the bytes that it is given: no file, no picture.
FLAGS += [f"-DTINYGLTF_NO_{name}" for name in ("FS", "STB_IMAGE", "STB_IMAGE_WRITE")]
LINK = (
    "-O3 -fexceptions --bind -sALLOW_MEMORY_GROWTH=1 -sMODULARIZE=1 -sEXPORT_NAME=Feltgate "
    "-sENVIRONMENT=web,worker"
).split()
# Header-only libraries of the system, one by one: its C library is not Emscripten's.
HEADERS = {
    "toml++": "/usr/include/toml++",
    "fmt": "/usr/include/fmt",
    "boost": "/usr/include/boost",
    "Eigen": "/usr/include/eigen3/Eigen",
    "nlohmann": "/usr/include/nlohmann",
    "tiny_gltf.h": "/usr/include/tiny_gltf.h",
}
FOLDERS = ("apps/page", "sim/plant", "files/toml", "design", "law", "sim/law_loop")
FILES = (
    "sim/axes_loop/plane_host.cpp",
    "sim/backends/backend.cpp",
    "sim/loop/ensemble.cpp",
    "sim/loop/backend_choice.cpp",
    "sim/loop/run_host.cpp",
    "sim/loop/step_plan.cpp",
    "sim/reference/chain.cpp",
    "sim/touch/edges.cpp",
    "sim/touch/glb.cpp",
    "sim/touch/mesh.cpp",
    "sim/touch/proxy.cpp",
    "studies/shape/rhombus.cpp",
    "studies/stability/linear_loop.cpp",
)
# Of the devices whose laws the page has as images.
LAW_DESIGNS = ("stylus_law", "gimbal_law")
PLANTS = ("p24", "p48", "linear", "gimbal_motor")
# A hand read from a file needs recordings, which the page has none of; its designs are files; nobody asks
# it for proofs.
LEFT_OUT = re.compile(r"hand_file|shipped|cpp(_.*)?|gappa(_.*)?|.*_main")


class CompileError(Exception):
    """Emscripten is missing or refused something; the message is for the user."""


def sources(root):
    """What is compiled."""
    found = [path for name in FOLDERS for path in sorted((root / "model" / name).glob("*.cpp"))]
    found += [root / "model" / name for name in FILES]
    return [p for p in found if not LEFT_OUT.fullmatch(p.stem)]


def run(words):
    # Debian's Emscripten finds its optimiser's parser only so when node is not Debian's.
    environment = dict(os.environ, NODE_PATH="/usr/share/nodejs")
    done = interrupts.run([str(word) for word in words], env=environment, **interrupts.CAPTURED)
    if done.returncode:
        raise CompileError(f"em++ has failed:\n{done.stderr.strip()[:2000]}")


def compile_core(root, designs, folder, progress=None):
    """(JavaScript, WebAssembly) of the core of these designs.

    `folder` is written; `progress` is called with a number of steps done and their total.
    """
    if not shutil.which("em++"):
        raise CompileError("em++ is not there; apt-get install emscripten")
    include = folder / "include"
    include.mkdir(parents=True, exist_ok=True)
    for name, place in HEADERS.items():
        if not (include / name).exists():
            (include / name).symlink_to(place)
    gltf = folder / "tiny_gltf.cpp"
    lines = "#include <fstream>", "#define TINYGLTF_IMPLEMENTATION", "#include <tiny_gltf.h>", ""
    gltf.write_text("\n".join(lines), encoding="utf-8")
    jobs = [gltf, *sources(root)]
    paths = ["-I", root, "-I", root / "model", "-I", root / "model/include", "-I", folder]
    paths += ["-isystem", include]

    def compiled(source):
        target = folder / f"{source.parent.name}_{source.stem}.o"
        run(["em++", "-c", *FLAGS, *paths, source, "-o", target])
        return target

    objects = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, target in enumerate(pool.map(compiled, jobs), 1):
            objects.append(target)
            if progress:
                progress(done, len(jobs) + 1)
    data = {root / "rtl/registers.toml": "/rtl/registers.toml"}
    names = folder / "names.txt"
    names.write_text("\n".join(designs), encoding="utf-8")
    data[names] = "/designs/names.txt"
    for design in [*designs, *LAW_DESIGNS]:
        data[root / f"rtl/designs/{design}.toml"] = f"/designs/{design}.toml"
    for plant in PLANTS:
        data[root / f"vectors/plants/{plant}.toml"] = f"/plants/{plant}.toml"
    files = [word for path, place in data.items() for word in ("--embed-file", f"{path}@{place}")]
    script = folder / "core.js"
    run(["em++", *LINK, *files, *objects, "-o", script])
    return script.read_bytes(), script.with_suffix(".wasm").read_bytes()
