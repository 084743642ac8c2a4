#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The launcher on a bare machine of stand-ins: what it installs, builds and starts, its exit codes, and what needs
neither. Debian's folders are moved into the scratch folder in a copy of the launcher; each stand-in notes its words.
"""

import json
import os
import shutil
import subprocess
import unittest

from testing import ROOT, Scratch, ran

import help_texts

# What Debian has before anything is installed, and what packages bring.
ESSENTIAL = """bash cat chmod cmp cp cut dirname env false flock grep head ln ls mkdir mv nproc
readlink rm sed sh sort tail tr true uname""".split()
BRINGS = {"python3": ["python3"], "cmake": ["cmake", "ctest"], "ninja-build": ["ninja"], "g++": ["g++"],
          "verilator": ["verilator"]}
STANDINS = {
    "dpkg-query": 'for p; do if grep -qx "$p" "$MACHINE/installed"; then echo "$p ii "; fi; done; true',
    "apt-get": """
[ "${3-}" = install ] || exit 0
case "$*" in *"${FAILING-nothing}"*) echo no space; exit 100 ;; esac
shift 3
for package in "$@"; do
  case $package in -*) continue ;; esac
  echo "$package" >>"$MACHINE/installed"
  if [ -d "$MACHINE/archive/$package" ]; then cp "$MACHINE/archive/$package"/* "$MACHINE/usr/bin/"; fi
done
echo changed >"$MACHINE/var/lib/dpkg/status" """,
    "sudo": '[ "$1" = -v ] && exit 0\n[ "$1" = -n ] && shift\nexec "$@"',
    # The real one: the launcher runs the project's scripts with it. Nothing is fetched from PyPI.
    "python3": 'case "$*" in *"-m venv"*) exit 1 ;; esac\nexec "$REAL_PYTHON" "$@"',
    "cmake": """
while [ $# -gt 0 ]; do
  case $1 in -B) build=$2 ;; -DPython3_EXECUTABLE=*) python=${1#*=} ;; esac
  shift
done
[ -x "$python" ] || exit 1
mkdir -p "$build" && : >"$build/build.ninja" """,
    "ninja": """
build=$2
[ "$3" = -t ] && { echo "a_test: CXX"; exit 0; }
shift 2
for target in "$@"; do cp "$MACHINE/program" "$build/${target##*/}"; done
exit "${BUILD_FAILS:-0}" """,
    "ctest": """
case "$*" in *--show-only*) cat "$MACHINE/tests.json"; exit 0 ;; esac
while [ $# -gt 0 ]; do
  if [ "$1" = --output-junit ]; then printf '<testcase status="run"\\n<testcase status="%s"\\n' $SECOND >"$2"; fi
  shift
done
[ "$SECOND" = run ] """,
    "g++": "",
    "verilator": "",
}
STANDINS = {name: f'#!/bin/sh\nprintf "%s\\n" "${{0##*/}} $*" >>"$MACHINE/log"\n{text}\n' for name, text in STANDINS.items()}
PROGRAM = '#!/bin/sh\necho "program ${0##*/} $*"\n"$FELTGATE_PYTHON" -c \'print("python works")\'\n'


class Machine(Scratch):
    def setUp(self):
        super().setUp()
        self.bin, self.repository = self.folder / "usr/bin", self.folder / "feltgate"
        for name in ("installed", "log", "var/lib/dpkg/status"):
            self.put(name, "")
        self.bin.mkdir(parents=True)
        for name in ESSENTIAL:
            (self.bin / name).symlink_to(shutil.which(name, path="/usr/bin:/bin"))
        for name in ("dpkg-query", "apt-get", "sudo"):
            self.put_program(f"usr/bin/{name}", STANDINS[name])
        for package, programs in BRINGS.items():
            for name in programs:
                self.put_program(f"archive/{package}/{name}", STANDINS[name])
        self.put_program("program", PROGRAM)
        shutil.copytree(ROOT / "scripts", self.repository / "scripts")
        for name in ("docs", "rtl", "vectors", "CITATION.cff"):
            (self.repository / name).symlink_to(ROOT / name)
        shutil.copy(ROOT / "feltgate", self.repository)
        for path in [self.repository / "feltgate", *self.repository.glob("scripts/*.sh")]:
            text = path.read_text(encoding="utf-8")
            for place in ("/usr/bin/", "/var/lib/"):
                text = text.replace(place, f"{self.folder}{place}")
            path.write_text(text, encoding="utf-8")

    def start(self, *words, **environment):
        """./feltgate WORDS..., with neither terminal nor CI; `log` is what the stand-ins were told."""
        (self.folder / "log").write_text("", encoding="utf-8")
        ours = {"PATH": str(self.bin), "HOME": str(self.folder), "MACHINE": str(self.folder)}
        ours |= {"REAL_PYTHON": os.path.realpath("/proc/self/exe"), **environment}
        done = ran(self.bin / "bash", self.repository / "feltgate", *words, env=ours, stdin=subprocess.DEVNULL)
        self.log = (self.folder / "log").read_text(encoding="utf-8").splitlines()
        return done

    def called(self, name):
        return [line.partition(" ")[2] for line in self.log if line.split()[0] == name]

    def test_the_first_start_and_the_second(self):
        self.ended(self.start("run", "membrane"), 2, "python3", "apt-get install")
        self.assertEqual(self.called("apt-get"), [])
        for program, *words in (("feltgate", "figures"), ("feltgate_run", "run", "membrane")):
            done = self.ended(self.start("--yes", *words))
            self.assertIn(f"program {program} {' '.join(words)}\n", done.stdout)
            self.assertIn("python works", done.stdout)
        self.ended(self.start("run", "membrane"))
        self.assertEqual([line.split()[0] for line in self.log], ["ninja", "python3"])
        self.ended(self.start("run", "membrane", BUILD_FAILS="3"), 3)

    def test_a_failed_installation_ends_it(self):
        """Pictures come beside the build, and the next start tries again."""
        words = ("--yes", "run", "membrane", "--report", "out")
        done = self.ended(self.start(*words, FAILING="matplotlib"), 2, "no space", "the installation failed")
        self.assertEqual(done.stdout, "")
        self.ended(self.start(*words))
        self.assertEqual(sum(" install " in call for call in self.called("apt-get")), 1)

    def test_help_needs_nothing(self):
        for name in help_texts.subcommands():
            done = self.ended(self.start(name, "--help"))
            self.assertEqual(done.stdout, help_texts.committed()[name])
            self.assertEqual(self.log, [])
        self.ended(self.start("rnu", "--help"), 2, "no subcommand 'rnu'")

    def installed(self):
        for programs in BRINGS.values():
            for name in programs:
                self.put_program(f"usr/bin/{name}", STANDINS[name])

    def test_what_each_command_builds(self):
        self.installed()
        law = self.put("law.toml", '[core]\nscene = "law"\nlaw = "my.law"\n')
        device = self.put("device.toml", 'device = "stylus"\n')
        recording = self.put("fast.board", "feltgate-board/1\n# written by a board\ndesign fast\n")
        for words, target in (
            (("run", "membrane", "--design", "fast"), "fast"),
            (("run", "membrane"), "run"),
            (("run", "membrane", "--engine", "twin,double"), "twin"),
            (("run", "membrane", "--engine", "twin,rtl"), "run"),
            (("run", "wall", "--design", "paper"), ""),
            (("run", "wall", "--design", "my/own.toml"), ""),
            (("run", "--csv", "out", law), "lever_law"),
            (("import", "a.sr"), "twin"),
            (("run", "wall", "--design", "my/own.toml", "--engine", "twin"), "twin"),
            (("run", law, "--engine", "twin"), ""),
            (("stability", "balanced"), ""),
            (("design", "fast"), ""),
            (("board", "--design", "lever_law", "--hand", "swing"), "board"),
            (("board", "--rtl"), "board_rtl_lever"),
            (("board", "--rtl", "--replay", recording), "board_rtl_fast"),
            (("host", "PORT", "info", "--design", "lever_law"), "host"),
            (("touch", "a.glb", "--engine", "all"), "touch_rtl"),
            (("rates", device), ""),
            (("rates", device, "--lock-step"), "stylus_law"),
            (("trim", "membrane"), ""),
            (("trim", "detent"), ""),
        ):
            with self.subTest(words):
                self.ended(self.start(*words, FELTGATE_SKIP_PACKAGES="1"))
                built = [call.split()[2:] for call in self.called("ninja")]
                self.assertEqual(built, [[f"feltgate_{target}" if target else "feltgate"]])
        self.ended(self.start("prove", "--defects", "x", FELTGATE_SKIP_PACKAGES="1"), 2, "argument --defects")
        self.assertEqual([line.split()[0] for line in self.log], ["python3"])

    def test_tests(self):
        self.installed()
        build = self.repository / "build"
        self.put("feltgate/build/CTestTestfile.cmake", f'add_test([=[a]=] "{build}/a_test")\n')
        labels = {"name": "LABELS", "value": ["unit"]}
        self.put("tests.json", json.dumps({"tests": [{"name": "a", "properties": [labels]}]}))
        skip = {"FELTGATE_SKIP_PACKAGES": "1"}
        for second, status, counts in (("run", 0, "2 passed, 0 failed"), ("fail", 1, "1 passed, 1 failed")):
            done = self.ended(self.start("test", "a", SECOND=second, **skip), status)
            self.assertEqual(done.stdout.splitlines()[-1], counts)
            self.assertTrue([call for call in self.called("ctest") if call.endswith("-R a -C Named")])
            self.assertIn(f"-C {build} a_test", self.called("ninja"))
        done = self.ended(self.start("test", "--list", **skip))
        self.assertEqual(done.stdout, "a  unit\n")
        self.put("tests.json", '{"tests": []}')
        self.ended(self.start("test", "zzz", **skip), 2, "no test matches 'zzz'")


if __name__ == "__main__":
    unittest.main()
