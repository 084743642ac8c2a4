#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Checkouts of other kinds than ours: a path with a space in it, and a clone that turns line ends. And
scripts/cmake/quick_build.cmake: what was compiled comes from the cache, and never what a header was before.
"""

import os
import shutil
import unittest

from testing import ROOT, Scratch, environment, ran

# Scripts for bash, and a recording.
FILES = ("feltgate", "scripts/build.sh", ".ci/run", "vectors/traces/membrane.vec")


class Checkouts(Scratch):
    @unittest.skipUnless((ROOT / ".git").exists(), "no clone")
    def test_a_clone_that_turns_line_ends_keeps_every_byte(self):
        clone = self.folder / "clone"
        for words in (("clone", "-q", "--no-checkout", "-c", "core.autocrlf=true", ROOT, clone),
                      ("-C", clone, "checkout", "-q", "HEAD", "--", ".gitattributes"),
                      ("-C", clone, "checkout", "-q", "HEAD", "--", *FILES)):  # fmt: skip
            self.ended(ran("git", "-c", "safe.directory=*", *words))
        for name in FILES:
            self.assertEqual((clone / name).read_bytes(), (ROOT / name).read_bytes(), name)

    @unittest.skipUnless(shutil.which("ninja"), "no ninja")
    def test_a_path_with_a_space_is_verilated(self):
        source, build = self.folder / "a checkout", self.folder / "a build"
        source.symlink_to(ROOT)
        self.ended(ran("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DFELTGATE_TESTS=OFF",
                       "-DFELTGATE_PACKAGES=OFF"))  # fmt: skip
        self.assertIn("a checkout", (build / "CMakeCache.txt").read_text(encoding="utf-8"))
        self.ended(ran("ninja", "-C", build, "core_lever.verilated/all.cpp"))


PROJECT = f"""cmake_minimum_required(VERSION 3.22)
project(small LANGUAGES CXX)
list(APPEND CMAKE_MODULE_PATH "{ROOT}/scripts/cmake")
include(quick_build)
add_executable(small small.cpp)
target_precompile_headers(small PRIVATE early.hpp)
"""


@unittest.skipUnless(shutil.which("ccache"), "no ccache here")
class Ccache(Scratch):
    def setUp(self):
        super().setUp()
        self.put("CMakeLists.txt", PROJECT)
        self.put("small.cpp", '#include "late.hpp"\nint main() { return early + late; }\n')
        self.write(1, 10)

    def write(self, early, late):
        """Both headers; their times are always the same, and so are their sizes."""
        for name, value in (("early", early), ("late", late)):
            path = self.put(f"{name}.hpp", f"#pragma once\nconstexpr int {name} = {value};\n")
            os.utime(path, (1_600_000_000, 1_600_000_000))

    def built(self):
        """What the program returns, built anew; and how many of its files came from the cache."""
        shutil.rmtree(self.folder / "build", ignore_errors=True)
        more = {"CCACHE_DIR": str(self.folder / "cache")}
        env = environment("CCACHE_", "CMAKE_CXX_COMPILER_LAUNCHER", **more)
        hits = self.hits(env)
        for words in (["-S", ".", "-B", "build"], ["--build", "build"]):
            ran("cmake", *words, cwd=self.folder, env=env, check=True)
        return ran(self.folder / "build/small").returncode, self.hits(env) - hits

    def hits(self, env):
        stats = ran("ccache", "--print-stats", env=env, check=True).stdout
        values = dict(line.split("\t") for line in stats.splitlines())
        return int(values["direct_cache_hit"]) + int(values["preprocessed_cache_hit"])

    def test_nothing_stale(self):
        self.assertEqual(self.built(), (11, 0))
        code, hits = self.built()
        self.assertEqual(code, 11)
        self.assertGreaterEqual(hits, 1)
        self.write(2, 10)
        self.assertEqual(self.built()[0], 12)
        self.write(2, 20)
        self.assertEqual(self.built()[0], 22)
        self.write(1, 10)
        self.assertEqual(self.built()[0], 11)


if __name__ == "__main__":
    unittest.main()
