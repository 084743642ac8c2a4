#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Pictures of a stability study: stability.py STUDY.json FOLDER.

Called by `feltgate stability --plot`; it only draws. Documentation: docs/speed-for-accuracy.md
"""

import argparse
import json
import sys
from pathlib import Path

import command_line
from reports import stability_plots


def main(argv=None):
    parser = argparse.ArgumentParser(prog="stability.py", description=__doc__)
    parser.add_argument("study", type=Path)
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args(argv)

    def work():
        study = json.loads(arguments.study.read_text(encoding="utf-8"))
        for picture in stability_plots.pictures(study, png=True):
            print(arguments.folder / picture.write(arguments.folder)[0])

    return command_line.ended("stability", work)


if __name__ == "__main__":
    sys.exit(main())
