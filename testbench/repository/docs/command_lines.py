# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The command lines that the pages show: in fenced blocks, inline where they start a program, and
in the help texts of scripts/help.txt.

A line of a block ends where two blanks or a # begin its explanation. `feltgate run` alone, inline,
only names a subcommand.
"""

import dataclasses
import re
from dataclasses import dataclass
from pathlib import Path

import help_texts
import pages


PROGRAMS = ("feltgate", "cmake", "ctest", "ninja", "pip", "python", "python3")
PROGRAMS += ("cp", "mv", "git", "source", "sudo", "apt-get", "g++", "c++")
PROGRAMS += ("jupyter", "bash", "cd", "quartus_sh", "openFPGALoader", "fusesoc")
COMMAND = re.compile(
    r"^(?:\$ )?((?:[A-Z_]+=\S+ )*(?:\./|\.?\.?[\w./-]*/bin/)?(?:%s)(?:$| .*))"
    % "|".join(map(re.escape, PROGRAMS))
)
SCRIPT = re.compile(r"^((?:scripts|testbench)/[\w/]+\.(?:py|sh) .*)")
SHELL = ("", "sh", "bash", "console")
ALL_COMMANDS = ("sh", "bash")  # a block of which each line is a command


@dataclass(frozen=True)
class Line:
    where: str
    words: str

    @property
    def names_only(self):
        return re.fullmatch(r"feltgate [a-z]+", self.words) is not None


def without_explanation(text):
    return re.split(r"\s{2,}|\s+#\s", text.strip())[0]


def joined(code):
    """Lines of blocks with a backslash at their end and the next one made one."""
    whole = None
    for one in code:
        if whole is not None and one.language is not None:
            one = dataclasses.replace(whole, text=f"{whole.text} {one.text.strip()}")
            whole = None
        if one.language is not None and one.text.rstrip().endswith("\\"):
            whole = dataclasses.replace(one, text=one.text.rstrip()[:-1].rstrip())
            continue
        yield one


def of_code(code):
    for one in joined(code):
        inline = one.language is None
        if not inline and one.language not in SHELL:
            continue
        text = one.text if inline else without_explanation(one.text)
        found = COMMAND.match(text) or SCRIPT.match(text)
        if found is None and text and one.language in ALL_COMMANDS:
            yield Line(f"{one.page}:{one.line}", text)
        if found is None or (inline and " " not in text):
            continue
        for part in found[1].split(" && "):
            yield Line(f"{one.page}:{one.line}", part.strip())


def help_lines(page):
    """The examples of the help texts; lines with brackets are their usage."""
    for _, first, lines in help_texts.lines_of(page):
        for number, text in enumerate(lines, first):
            if text.startswith(" ") and "[" not in text:
                yield pages.Code(Path("scripts") / page.name, number, text.strip(), "")


def all_lines():
    root = pages.ROOT
    yield from of_code(help_lines(help_texts.PAGE))
    for page in pages.pages(root):
        code, _ = pages.parts(page, root)
        yield from of_code(code)
