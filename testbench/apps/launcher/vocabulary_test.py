#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""One vocabulary over all commands: every help teaches by examples and says its exit codes, options
that mean the same are called the same, old spellings are still understood, schemas are named alike.
"""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, environment, ran

import help_texts

PROGRAMS = Path(sys.argv.pop()) if len(sys.argv) > 1 else None

# What an option's value is called, wherever the option is.
TYPES = {
    "--json": "FILE",
    "--csv": "FILE",
    "--fst": "FILE",
    "--design": "DESIGN",
    "--plant": "PLANT",
    "--for-plant": "PLANT",
    "--duration": "SECONDS",
    "--report": "DIR",
    "--plot": "DIR",
}
# Names that an option had once; nothing shows them any more.
OLD = ("--out", "--seconds", "--threads", "--engines", "--scenes")
# feltgate-WHAT/NUMBER; a program is called feltgate-something too, but never with a number.
SCHEMA = re.compile(r"feltgate-[a-z]+(?:-[a-z]+)*([-/])[0-9]+\b")


def options(text):
    """(name, type) of each option in a help text; one that argparse or CLI11 made up as it is."""
    for line in text.splitlines():
        found = re.match(r" +(?:-\w[ ,]+)?(?:[A-Z]+, )?(--[a-z-]+)(?:[ =]([^ =:]+))?", line)
        if found:
            yield found.group(1), found.group(2) or ""


class HelpTest(unittest.TestCase):
    def texts(self):
        texts = sorted(help_texts.committed().items())
        self.assertGreater(len(texts), 15)
        return texts

    def test_every_help_has_an_example_and_exit_codes(self):
        for command, text in self.texts():
            command = command.replace("host ", r"host \S+ ")  # its port comes before the verb
            shown = re.findall(rf"^ +(?:\./)?feltgate {command}\b", text, re.M)
            usage = re.findall(rf"^ +feltgate {command} \[?--?[a-z]+.*\[", text, re.M)
            with self.subTest(command=command):
                self.assertGreater(len(shown) - len(usage), 0, "no example")
                self.assertRegex(text, r"Exit code: 0\s")
                self.assertRegex(re.split(r"Exit code: 0\s", text)[1], r"\b2[\s,]")

    def test_values_are_called_alike(self):
        for command, text in self.texts():
            for name, kind in options(text):
                with self.subTest(command=command, option=name):
                    if name in TYPES:
                        self.assertEqual(kind, TYPES[name])
                    self.assertNotEqual(kind, "TEXT")

    def test_no_old_spelling_is_shown(self):
        for _, text in self.texts():
            self.assertFalse({name for name, _ in options(text)} & set(OLD))


class SchemaTest(unittest.TestCase):
    def test_names_in_sources_and_pages(self):
        named = set()
        for folder in ("model", "scripts", "docs"):
            for path in (ROOT / folder).rglob("*"):
                if path.suffix not in (".cpp", ".hpp", ".py", ".md", ".json"):
                    continue
                for found in SCHEMA.finditer(path.read_text(encoding="utf-8")):
                    self.assertEqual(found.group(1), "/", f"{path}: {found.group(0)}")
                    named.add(found.group(0))
        self.assertGreaterEqual(len(named), 10, named)


@unittest.skipUnless(PROGRAMS, "needs the built programs")
class ProgramTest(Scratch):
    def run_it(self, *words, program="feltgate"):
        if words[0] == "extremes":
            program, words = "feltgate_extremes", words[1:]
        ours = environment(FELTGATE_ROOT=str(ROOT), FELTGATE_PYTHON=sys.executable)
        return ran(PROGRAMS / program, *words, env=ours, stdin=subprocess.DEVNULL)

    def test_old_spellings_do_what_the_new_ones_do(self):
        trace = ROOT / "vectors/traces/membrane.vec"
        texts = []
        for option in ("--duration", "--seconds"):
            done = self.ended(self.run_it("replay", trace, option, "0.01", "--engine", "twin,quad"))
            texts.append(re.sub(r" +\S+x\n", "\n", done.stdout))
        self.assertEqual(*texts)
        self.assertIn("0.010002 s", texts[0])
        # A value that cannot be: the complaint is about the value, not about the option.
        for words, program in (
            (("trim", "membrane", "--threads", "0"), "feltgate"),
            (("--engines", "nonsense"), "feltgate_bench"),
            (("--scenes", "nonsense"), "feltgate_bench"),
        ):
            done = self.ended(self.run_it(*words, program=program), 2)
            self.assertNotIn("option --", done.stderr)
            self.assertRegex(done.stderr, r"^feltgate[ a-z]*: (--threads|.*nonsense)")
        for script in ("demo", "figures"):
            self.ended(self.run_it(script, "--out"), 2, "--out: expected one argument")

    def test_json_of_the_programs(self):
        trace = ROOT / "vectors/traces/membrane.vec"
        for words in (
            ("run", "torque_step", "--engine", "twin"),
            ("replay", trace, "--duration", "0.01", "--engine", "twin"),
            ("budget", "torque_step"),
            ("extremes", "wrap_32"),
            ("stability", "lever", "--no-bits", "--no-experiments", "--rate", "1000"),
        ):
            with self.subTest(command=words[0]):
                path = self.folder / f"{words[0]}.json"
                self.ended(self.run_it(*words, "--json", path))
                kind = "run" if words[0] == "replay" else words[0]
                found = json.loads(path.read_text(encoding="utf-8"))["schema"]
                self.assertEqual(found, f"feltgate-{kind}/1")

    def test_csv_size_is_told_and_bounded(self):
        path = self.folder / "rows.csv"
        done = self.ended(self.run_it("run", "torque_step", "--engine", "twin,double,float", "--csv", path))
        lines = path.read_text(encoding="utf-8").splitlines()
        header = lines[0].split(",")
        for engine in ("twin", "double", "float"):
            self.assertIn(f"{engine}_velocity_rad_s", header)
        self.assertNotIn("quad_velocity_rad_s", header)
        told = re.match(r"CSV: (\d+) rows of (\d+) columns, up to about", done.stderr)
        self.assertEqual(int(told.group(1)), len(lines) - 1)
        self.assertEqual(int(told.group(2)), len(header))
        self.assertLessEqual(len(lines) - 1, 100_000)

    def test_a_plant_that_does_not_fit_is_told_with_the_command_that_helps(self):
        done = self.run_it("run", "torque_step", "--plant", "p48", "--engine", "twin")
        self.assertLess(done.stdout.index("torque constant"), done.stdout.index("What was felt"))
        command = re.search(
            r"feltgate (design --for-plant p48 --nominal-current AMPERES) -o", done.stdout
        ).group(1)
        made = self.ended(self.run_it(*command.replace("AMPERES", "3.1").split()))
        self.assertIn("torque_constant_nm_a = 0.0603", made.stdout)


if __name__ == "__main__":
    unittest.main()
