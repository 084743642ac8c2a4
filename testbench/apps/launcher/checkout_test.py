#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Checkouts of other kinds than ours: a path with a space in it, and a clone that turns line ends."""

import shutil
import unittest

from testing import ROOT, Scratch, ran

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


if __name__ == "__main__":
    unittest.main()
