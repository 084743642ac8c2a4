#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""slang, a strict SystemVerilog front end, on files; run by a Python that has pyslang.

  slang_lint.py --top feltgate_core FILE...      status 1 when slang finds anything

Options of slang, such as -DNAME, may be among the files. All of -Wextra and -Wpedantic is on,
except for casts to a width that a word has in one design and not in another.
"""

import sys

OPTIONS = ("-Wextra", "-Wpedantic", "-Werror", "-Wno-useless-cast")


def main():
    from pyslang import driver

    slang = driver.Driver()
    slang.addStandardArgs()
    words = ["slang", *OPTIONS, *(f'"{word}"' for word in sys.argv[1:])]
    fine = slang.parseCommandLine(" ".join(words), driver.CommandLineOptions())
    fine = fine and slang.processOptions() and slang.parseAllSources()
    fine = fine and slang.runFullCompilation(True)
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
