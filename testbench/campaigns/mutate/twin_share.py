#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Some mutants of the twin are killed as they are by `feltgate mutate --twin`. docs/testing.md

twin_share.py BUILD OPTION...: those of mutate --twin; skipped where there is no tree-sitter.
"""

import os
import sys
import unittest
from pathlib import Path

import testing  # noqa: F401, puts scripts/ on the path

from mutation import twin, twin_parser

BUILD, OPTIONS = sys.argv[1], sys.argv[2:]


def has_parser():
    try:
        twin_parser.cpp_language(Path(BUILD) / "venv-mutate")
    except twin_parser.SourceError:
        return False
    return True


@unittest.skipUnless(has_parser() or os.environ.get("CI"),
                     "no tree-sitter; ./feltgate test fetches it")
class Share(unittest.TestCase):
    def test_share(self):
        os.environ["FELTGATE_BUILD"] = BUILD
        self.assertEqual(twin.main([*OPTIONS, "--no-build"]), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
