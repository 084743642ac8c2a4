# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""scripts/tests.py: what a test needs, found in a build folder of text files and two stand-ins."""

import json
import os
import unittest

from testing import Scratch, script

MADE = ("product", "tests/a_test", "tests/b.vvp", "all", "libx.a")
# Name: (command, labels, REQUIRED_FILES); %s is the build folder.
TESTS = {
    "a": (["%s/tests/a_test", "[tag]"], ["unit"], []),
    "a.defect1": (["cmake", "-DTEST=%s/tests/a_test;[tag]", "-P", "x.cmake"], ["mutation"], []),
    "b": (["sh", "-c", "%s/product 1 b.hex && vvp b.vvp"], ["lockstep", "unit"], []),
    "script": (["python3", "s.py"], ["unit"], ["/bin/sh", "%s/libx.a"]),
    "whole": (["cmake", "--install", "%s"], ["system"], []),
}
UNKNOWN = {"stray": (["python3", "t.py"], ["unit"], [])}


class Selection(Scratch):
    def setUp(self):
        super().setUp()
        self.build = self.folder / "build"
        (self.build / "tests").mkdir(parents=True)
        self.folder.joinpath("bin").mkdir()
        self.standin("ninja", "\n".join(f"{name}: CXX" for name in MADE))
        self.configure(TESTS)

    def standin(self, name, says):
        self.put(f"{name}.txt", says + "\n")
        self.put_program(f"bin/{name}", f'cat "{self.folder}/{name}.txt"')

    def configure(self, tests):
        """What CMake writes, and what CTest says of it; CTest is silent about commands."""
        build, lines, entries = str(self.build), [], []
        for name, (command, labels, required) in tests.items():
            words = " ".join(f'"{word.replace("%s", build)}"' for word in command)
            lines.append(f"  add_test([=[{name}]=] {words})")
            properties = [
                {"name": "LABELS", "value": labels},
                {"name": "WORKING_DIRECTORY", "value": f"{build}/tests"},
            ]
            if required:
                files = [path.replace("%s", build) for path in required]
                properties.append({"name": "REQUIRED_FILES", "value": files})
            entries.append({"name": name, "properties": properties})
        top, inner = self.build / "CTestTestfile.cmake", self.build / "tests/CTestTestfile.cmake"
        top.write_text('# Generated\nsubdirs("tests")\n', encoding="utf-8")
        inner.write_text("\n".join(lines) + "\n", encoding="utf-8")
        self.standin("ctest", json.dumps({"tests": entries}))

    def say(self, *words):
        path = {"PATH": f"{self.folder}/bin:{os.environ['PATH']}"}
        return script("tests.py", *words, "--build", self.build, env=os.environ | path)

    def targets(self, *names):
        self.configure({name: (TESTS | UNKNOWN)[name] for name in names})
        return self.say("targets").stdout.split()

    def test_programs_of_commands(self):
        self.assertEqual(self.targets("a"), ["tests/a_test"])
        self.assertEqual(self.targets("a.defect1"), ["tests/a_test"])
        self.assertEqual(self.targets("a", "b"), ["product", "tests/a_test", "tests/b.vvp"])

    def test_required_files(self):
        self.assertEqual(self.targets("script"), ["libx.a"])

    def test_everything_where_the_build_folder_is_named_or_nothing_is_known(self):
        self.assertEqual(self.targets("whole", "a"), ["all"])
        self.assertEqual(self.targets("stray", "a"), ["all"])

    def test_check_names_the_test_that_says_nothing(self):
        self.assertEqual(self.say("check").returncode, 0)
        self.configure(TESTS | UNKNOWN)
        done = self.ended(self.say("check"), 1)
        self.assertIn("stray: what it needs is not known", done.stdout)

    def test_check_names_the_file_that_nothing_makes(self):
        self.configure({"script": (["python3", "s.py"], ["unit"], ["%s/libgone.a"])})
        done = self.ended(self.say("check"), 1)
        self.assertIn("libgone.a, which nothing makes", done.stdout)

    def test_list(self):
        lines = self.say("list").stdout.splitlines()
        self.assertEqual(len(lines), len(TESTS))
        self.assertEqual(lines[2].split(), ["b", "lockstep", "unit"])

    def test_a_name_that_is_no_regular_expression(self):
        self.standin("ctest", "RegularExpression::compile(): ?+* follows nothing.\n{}")
        done = self.say("list", "--name", "(?!a)")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("'(?!a)' is no regular expression for CTest", done.stderr)

    def test_minutes(self):
        results = self.folder / "results.xml"
        cases = {"a": 30, "a.defect1": 60, "b": 90.5, "script": 0.5, "whole": 600}
        text = "".join(f'<testcase name="{n}" time="{s}"/>' for n, s in cases.items())
        results.write_text(f"<testsuite>{text}</testsuite>", encoding="utf-8")
        done = self.ended(self.say("minutes", "--results", results))
        self.assertIn("| mutation | 1 | 1.0 | `a.defect1` | 60 |", done.stdout)
        self.assertIn("| unit | 2 | 0.5 | `a` | 30 |", done.stdout)
        self.assertIn("| all | 5 | 13.0 | | |", done.stdout)


if __name__ == "__main__":
    unittest.main()
