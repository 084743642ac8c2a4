#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""scripts/cmake/quick_build.cmake: what was compiled comes from the cache, and never what a header was before."""

import os
import shutil
import unittest

from testing import ROOT, Scratch, environment, ran

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
