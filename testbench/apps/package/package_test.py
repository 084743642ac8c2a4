#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The package as a user gets it: what is installed, the examples of docs/examples built and run
against it, the tree inside another project. docs/library.md

  package_test.py --configured DIR [unittest arguments]   DIR is the built tree that is installed
"""

import json
import os
import re
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from testing import ROOT, ran, weekly

at = sys.argv.index("--configured")
BUILD = Path(sys.argv[at + 1]).resolve()
del sys.argv[at : at + 2]
EXAMPLES = ROOT / "docs" / "examples"
# The projects of users: compiled soon, not to be fast.
SOON = ("-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O0")
# What no header of the package may pull in.
FOREIGN = re.compile(r"toml\+\+|/boost/|/fmt/|archive\.h|verilated|nlohmann|CLI11|Eigen")


def run(*command, ok=True, cwd=None):
    done = ran(*command, cwd=cwd)
    text = done.stdout + done.stderr
    if ok and done.returncode:
        raise AssertionError(f"{' '.join(map(str, command))}\n{text}")
    return text


def install(prefix, *components):
    for component in components:
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", f"feltgate_{component}")


def project(folder, text, source="int main() {}\n"):
    folder.mkdir()
    head = "cmake_minimum_required(VERSION 3.22)\nproject(outside LANGUAGES CXX)\n"
    (folder / "CMakeLists.txt").write_text(head + text)
    (folder / "main.cpp").write_text(source)
    return folder


def configure(folder, *options, ok=True):
    return run(
        "cmake", "-S", folder, "-B", folder / "build", "-G", "Ninja", *options,
        *SOON, "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", ok=ok,
    )  # fmt: skip


def main_command(folder):
    commands = json.loads((folder / "build" / "compile_commands.json").read_text())
    return next(c["command"] for c in commands if c["file"] == str(folder / "main.cpp"))


CORE_PROGRAM = """#include "feltgate/device.hpp"
#include "feltgate/generated/lever.hpp"
int main() {
  feltgate::TwinDevice device(feltgate::design_info<feltgate::Lever>());
  device.arm();
  for (int tick = 0; tick < 10; ++tick) device.tick({});
  return device.armed() ? 0 : 1;
}
"""
PLANT_PROGRAM = """#include "feltgate/plant/plant.hpp"
int main() {
  feltgate::plant::Parameters p;
  return p.motor.resistance_ohm == 0 && feltgate::plant::Hand{}.initial_rad() == 0 ? 0 : 1;
}
"""


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.prefix = cls.folder / "all"
        install(cls.prefix, "core", "sim", "systemc")

    def test_include_folder_has_feltgate_and_nothing_else(self):
        self.assertEqual([p.name for p in (self.prefix / "include").iterdir()], ["feltgate"])

    def test_headers_stand_alone_and_need_no_library(self):
        include = self.prefix / "include"
        headers = sorted(
            str(p.relative_to(include))
            for p in include.rglob("*.hpp")
            if "systemc" not in p.parts and not p.stem.endswith("_run")
        )
        self.assertGreater(len(headers), 50)
        source = self.folder / "headers.cpp"
        flags = ["g++", "-std=c++17", "-I", include, "-fsyntax-only", "-x", "c++"]
        warnings = ["-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Werror"]
        for order in (headers, headers[::-1]):
            source.write_text("".join(f'#include "{h}"\n' for h in order))
            run(*flags, *warnings, source)
        # Those of the twin, which users take one by one, need none before them.
        twin = [h for h in headers if Path(h).parent == Path("feltgate")]
        self.assertGreater(len(twin), 50)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(lambda header: run(*flags, "/dev/null", "-include", header), twin))
        seen = run("g++", "-std=c++17", "-I", include, "-M", source)
        self.assertEqual(FOREIGN.findall(seen), [])

    @weekly(3)
    def test_examples_run_against_the_installed_package(self):
        build = self.folder / "examples"
        run("cmake", "-S", EXAMPLES, "-B", build, "-G", "Ninja", *SOON,
            f"-DCMAKE_PREFIX_PATH={self.prefix}")  # fmt: skip
        run("ninja", "-C", build)
        run("ctest", "--test-dir", build, "--output-on-failure")
        wall = run(build / "tick_loop").split()
        self.assertEqual(wall[-4:], ["0.249", "rad", "-0.2040", "Nm"])
        data = self.prefix / "share" / "feltgate"
        spring = run(build / "closed_loop", data / "plants" / "p24.toml").split()
        # 0.2 Nm against 0.5 Nm/rad, less the friction of a lever that has come to rest.
        self.assertAlmostEqual(float(spring[-2]), 0.4, delta=0.02)
        told = run(build / "replay", data / "traces" / "membrane.vec")
        self.assertRegex(told, r"^3\.000 s: fixed [1-9]\.\d+e-04, float [1-9]\.\d+e-\d+ rad/s\n$")

    @weekly(3)
    def test_core_alone_needs_nothing_and_says_what_is_not_there(self):
        prefix = self.folder / "core"
        install(prefix, "core")
        found = f"-DCMAKE_PREFIX_PATH={prefix}"
        text = (
            "find_package(feltgate 0.2 REQUIRED COMPONENTS core)\nadd_executable(main main.cpp)\n"
        )
        text += "target_link_libraries(main PRIVATE feltgate::core)\n"
        folder = project(self.folder / "alone", text, CORE_PROGRAM)
        configure(folder, found)
        run("ninja", "-C", folder / "build")
        run(folder / "build" / "main")
        text = "find_package(feltgate REQUIRED COMPONENTS sim)\n"
        told = configure(project(self.folder / "lacking", text), found, ok=False)
        self.assertIn('feltgate has no component "sim" here; installed are: core', told)
        text = "find_package(feltgate 0.3 REQUIRED)\n"
        told = configure(project(self.folder / "newer", text), found, ok=False)
        self.assertIn("compatible with requested version", told)

    @weekly(3)
    def test_inside_another_project_only_what_is_linked_is_built(self):
        text = "include(FetchContent)\nFetchContent_Declare(feltgate URL nowhere)\n"
        text += "FetchContent_MakeAvailable(feltgate)\nadd_executable(main main.cpp)\n"
        text += "target_link_libraries(main PRIVATE feltgate::core)\n"
        folder = project(self.folder / "fetched", text, CORE_PROGRAM)
        configure(folder, f"-DFETCHCONTENT_SOURCE_DIR_FELTGATE={ROOT}", "-DFELTGATE_SIM=OFF")
        run("ninja", "-C", folder / "build")
        run(folder / "build" / "main")
        commands = json.loads((folder / "build" / "compile_commands.json").read_text())
        self.assertEqual([Path(c["file"]).name for c in commands], ["main.cpp"])

        text = f'add_subdirectory("{ROOT}" feltgate)\nadd_executable(main main.cpp)\n'
        text += "target_link_libraries(main PRIVATE feltgate::plant)\n"
        folder = project(self.folder / "added", text, PLANT_PROGRAM)
        configure(folder, "-DFELTGATE_SIGROK=OFF")
        self.assertNotIn("-Werror", (folder / "build" / "compile_commands.json").read_text())
        self.assertIn("Total Tests: 0", run("ctest", "--test-dir", folder / "build", "-N"))
        run("ninja", "-C", folder / "build", "main")
        run(folder / "build" / "main")
        made = sorted(p.name for p in (folder / "build" / "feltgate").glob("*.a"))
        self.assertEqual(made, ["libfeltgate_plant.a"])
        for path in re.findall(r"-(?:I|isystem) ?(\S+)", main_command(folder)):
            self.assertEqual([p.name for p in Path(path).iterdir()], ["feltgate"], path)


if __name__ == "__main__":
    unittest.main()
