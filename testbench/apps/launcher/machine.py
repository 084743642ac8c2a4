# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A bare machine of stand-ins: a copy of the launcher, a PATH that knows no more than bash's usual
company, and package tools through which programs appear, as on a fresh Debian.

Debian's own folders are moved into the scratch folder in the copy of the launcher, so that nothing
of the real machine is seen. Every stand-in notes its name and arguments in the log.
"""

import os
import shutil
import subprocess

from testing import ROOT, Scratch, ran

# What Debian has before anything is installed.
ESSENTIAL = """bash cat chmod cmp cp cut dirname env false flock grep head ln ls mkdir mv nproc
readlink rm sed sh sort tail tr true uname""".split()
# Package: programs that it brings.
BRINGS = {
    "python3": ["python3"],
    "cmake": ["cmake", "ctest"],
    "ninja-build": ["ninja"],
    "g++": ["g++"],
    "verilator": ["verilator"],
}
LOG = 'printf "%s\\n" "${0##*/} $*" >>"$MACHINE/log"\n'
STANDINS = {
    "dpkg-query": """
for package in "$@"; do
  if grep -qx "$package" "$MACHINE/installed"; then echo "$package ii "; fi
done
true""",
    "apt-get": """
[ "${3-}" = install ] || exit 0
shift 3
for package in "$@"; do
  case $package in -*) continue ;; esac
  echo "$package" >>"$MACHINE/installed"
  if [ -d "$MACHINE/archive/$package" ]; then
    cp "$MACHINE/archive/$package"/* "$MACHINE/usr/bin/"
  fi
done
echo changed >"$MACHINE/var/lib/dpkg/status" """,
    "sudo": """
[ "$1" = -v ] && exit 0
[ "$1" = -n ] && shift
exec "$@" """,
    # The real one: the launcher runs the project's scripts with it. Nothing is fetched from PyPI.
    "python3": 'case "$*" in *"-m venv"*) exit 1 ;; esac\nexec "$REAL_PYTHON" "$@"',
    "cmake": """
while [ $# -gt 0 ]; do
  case $1 in -B) build=$2 ;; -DPython3_EXECUTABLE=*) python=${1#*=} ;; esac
  shift
done
# As CMake's find_package does: an interpreter that is not there ends the configuration.
[ -x "$python" ] || { echo "no interpreter: '$python'"; exit 1; }
mkdir -p "$build" && : >"$build/build.ninja" """,
    # Builds programs that show what they are given.
    "ninja": """
build=$2
[ "$3" = -t ] && { cat "$MACHINE/outputs"; exit 0; }
shift 2
for target in "$@"; do
  cp "$MACHINE/program" "$build/${target##*/}"
done""",
    "ctest": """
build=$2
case "$*" in *--show-only*) cat "$MACHINE/tests.json"; exit 0 ;; esac
while [ $# -gt 0 ]; do
  if [ "$1" = --output-junit ]; then echo '<testcase name="a" status="run" time="1">' >"$2"; fi
  shift
done""",
    "g++": "",
    "verilator": "",
}
PROGRAM = """#!/bin/sh
echo "program ${0##*/} $*"
"$FELTGATE_PYTHON" -c 'print("python works")'
"""


class Machine(Scratch):
    def setUp(self):
        super().setUp()
        self.bin = self.folder / "usr/bin"
        self.repository = self.folder / "feltgate"
        for folder in (self.bin, self.folder / "archive", self.folder / "var/lib/dpkg"):
            folder.mkdir(parents=True)
        for name in ("installed", "log", "outputs", "var/lib/dpkg/status"):
            (self.folder / name).touch()
        for name in ESSENTIAL:
            (self.bin / name).symlink_to(shutil.which(name, path="/usr/bin:/bin"))
        for name in ("dpkg-query", "apt-get", "sudo"):
            self.standin(self.bin / name)
        for package, programs in BRINGS.items():
            (self.folder / "archive" / package).mkdir()
            for name in programs:
                self.standin(self.folder / "archive" / package / name)
        program = self.folder / "program"
        program.write_text(PROGRAM, encoding="utf-8")
        program.chmod(0o755)
        self.copy_repository()

    def standin(self, path):
        path.write_text(f"#!/bin/sh\n{LOG}{STANDINS[path.name]}\n", encoding="utf-8")
        path.chmod(0o755)

    def copy_repository(self):
        """The launcher and what it reads; the rest is linked."""
        self.repository.mkdir()
        shutil.copytree(ROOT / "scripts", self.repository / "scripts")
        for name in ("docs", "rtl", "vectors", "CITATION.cff"):
            (self.repository / name).symlink_to(ROOT / name)
        shutil.copy(ROOT / "feltgate", self.repository)
        for path in [self.repository / "feltgate", *self.repository.glob("scripts/*.sh")]:
            text = path.read_text(encoding="utf-8")
            for place in ("/usr/bin/", "/var/lib/"):
                text = text.replace(place, f"{self.folder}{place}")
            path.write_text(text, encoding="utf-8")

    def installed(self, *packages):
        """Packages that are there from the beginning."""
        for package in packages:
            subprocess.run(
                [self.bin / "apt-get", "-o", "x", "install", package],
                env={"MACHINE": str(self.folder), "PATH": str(self.bin)},
                check=True,
            )
        (self.folder / "log").write_text("", encoding="utf-8")

    def start(self, *words, **environment):
        """./feltgate WORDS..., with neither terminal nor CI; what came of it."""
        return ran(
            *(self.bin / "bash", self.repository / "feltgate", *words),
            env={
                "PATH": str(self.bin),
                "HOME": str(self.folder),
                "MACHINE": str(self.folder),
                "REAL_PYTHON": os.path.realpath("/proc/self/exe"),
                **environment,
            },
            stdin=subprocess.DEVNULL,
        )

    def log(self):
        """Calls of the stand-ins so far, which are then forgotten."""
        path = self.folder / "log"
        lines = path.read_text(encoding="utf-8").splitlines()
        path.write_text("", encoding="utf-8")
        return lines

    def calls(self, name):
        """Arguments of each call of one stand-in, in order."""
        return [line.partition(" ")[2] for line in self.log() if line.split()[0] == name]
