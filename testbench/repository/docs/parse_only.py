# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""parse_only.py SCRIPT ARGUMENTS...: the script up to the point where argparse has accepted all of
them; then status 0. For commands that would build or place and route for minutes."""

import argparse
import runpy
import sys
from pathlib import Path

parse = argparse.ArgumentParser.parse_args


def parse_and_end(parser, *words, **more):
    parse(parser, *words, **more)
    sys.exit(0)


argparse.ArgumentParser.parse_args = parse_and_end
sys.argv = sys.argv[1:]
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))
runpy.run_path(sys.argv[0], run_name="__main__")
sys.exit(f"{sys.argv[0]} ended without reading its options")
