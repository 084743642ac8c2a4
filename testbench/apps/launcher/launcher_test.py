# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The launcher on a bare machine: what it installs, builds and hands on, and what needs neither."""

import json
import re
import unittest

from machine import ROOT, Machine
from testing import text_of

import help_texts

BUILD_PACKAGES = ("python3", "cmake", "ninja-build", "g++", "verilator")

LABELS = {"name": "LABELS", "value": ["unit"]}


class FirstStart(Machine):
    def test_python_is_looked_up_after_it_was_installed(self):
        for program, *words in (("feltgate_run", "run", "membrane"), ("feltgate", "figures")):
            with self.subTest(words):
                self.setUp()
                done = self.ended(self.start("--yes", *words))
                self.assertIn(f"program {program} {' '.join(words)}\n", done.stdout)
                self.assertIn("python works", done.stdout)
                configured = [c for c in self.log() if c.startswith("cmake ") and " -S " in c]
                self.assertEqual(len(configured), 1)
                self.assertIn(f"-DPython3_EXECUTABLE={self.bin}/python3", configured[0])
                self.assertIn("-DFELTGATE_WERROR=OFF", configured[0])

    def test_a_warning_ends_the_build_of_ci_alone(self):
        self.assertIn("export CI=true FELTGATE_WERROR=ON\n", text_of(".ci/run"))
        for given, option in (({"CI": "true"}, "OFF"), ({"CI": "true", "FELTGATE_WERROR": "ON"}, "ON"), ({}, "OFF")):
            self.ended(self.start("--yes", "run", "membrane", **given))
            (configured,) = [c for c in self.log() if c.startswith("cmake ") and " -S " in c]
            self.assertIn(f"-DFELTGATE_WERROR={option}", configured)

    def test_nothing_is_installed_unasked(self):
        self.ended(self.start("run", "membrane"), 2, "python3", "apt-get install")
        self.assertFalse([c for c in self.log() if c.startswith("apt-get")])

    def test_without_python_it_says_so(self):
        self.ended(self.start("run", "membrane", FELTGATE_SKIP_PACKAGES="1"), 2, "no python3")

    def test_the_build_folder_of_another_user(self):
        """Whose lock cannot be opened, as by permissions, which mean nothing to root."""
        (self.repository / "build/launcher/lock").mkdir(parents=True)
        done = self.ended(self.start("--yes", "run", "membrane"), 2)
        said = [line for line in done.stderr.splitlines() if "build folder" in line]
        self.assertEqual(len(said), 1, done.stderr)
        self.assertIn("another user's or read-only; build in one of your own: FELTGATE_BUILD=", said[0])
        self.assertNotIn("build.sh", done.stderr)

    def test_the_second_start_asks_and_configures_nothing(self):
        self.assertEqual(self.start("--yes", "run", "membrane").returncode, 0)
        self.log()
        self.assertEqual(self.start("run", "membrane").returncode, 0)
        self.assertEqual([c.split()[0] for c in self.log()], ["ninja", "python3"])

    def test_a_newer_python_configures_again(self):
        """A build folder made before Python was there does not stay without."""
        self.assertEqual(self.start("--yes", "run", "membrane").returncode, 0)
        configured = self.repository / "build/launcher/configured"
        lines = configured.read_text(encoding="utf-8").splitlines()
        configured.write_text("\n".join([*lines[:2], "", *lines[3:]]) + "\n", encoding="utf-8")
        self.log()
        self.assertEqual(self.start("run", "membrane").returncode, 0)
        self.assertEqual(len(self.calls("cmake")), 1)

    def test_a_tool_that_came_later_configures_again(self):
        """faults needs yosys at configuration, which run does not install."""
        self.assertEqual(self.start("--yes", "run", "membrane").returncode, 0)
        self.log()
        self.start("--yes", "faults")
        calls = [c.split()[0] for c in self.log()]
        self.assertLess(calls.index("apt-get"), calls.index("cmake"))


class Beside(Machine):
    """Packages that the build does not need come while it runs."""

    def test_pictures_come_beside_the_build(self):
        done = self.ended(self.start("--yes", "run", "membrane", "--report", "out"))
        installs = [c for c in self.log() if c.startswith("apt-get") and " install " in c]
        self.assertEqual(len(installs), 2, done.stderr)
        self.assertIn(" ninja-build ", installs[0])
        self.assertNotIn("matplotlib", installs[0])
        self.assertIn("python3-matplotlib", installs[1])
        self.assertIn("the other packages are installed while it builds", done.stderr)

    def test_tests_are_configured_when_their_packages_are_there(self):
        for words, targets in ((("test",), ["feltgate_run", "all"]), (("coverage",), ["build.ninja"])):
            with self.subTest(words):
                self.setUp()
                self.start("--yes", *words)
                log = self.log()
                second = max(i for i, c in enumerate(log) if c.startswith("apt-get"))
                tests = [i for i, c in enumerate(log) if "-DFELTGATE_TESTS=ON" in c]
                self.assertIn(" catch2 ", log[second])
                self.assertEqual(len(tests), 1)
                self.assertLess(second, tests[0])
                self.assertEqual([c.split()[3] for c in log if c.startswith("ninja")], targets)

    def test_a_failure_beside_ends_the_launcher(self):
        """After the build, with what apt-get says, and the next start tries again."""
        fails = '[ "${3-}" = install ] && case "$*" in *matplotlib*) echo no space; exit 100 ;; esac\n'
        path = self.bin / "apt-get"
        good = path.read_text(encoding="utf-8")
        path.write_text(good.replace("#!/bin/sh\n", "#!/bin/sh\n" + fails), encoding="utf-8")
        words = ("--yes", "run", "membrane", "--report", "out")
        done = self.start(*words)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("no space", done.stderr)
        self.assertIn("the installation failed; the command was: ", done.stderr)
        path.write_text(good, encoding="utf-8")
        self.log()
        self.assertEqual(self.start(*words).returncode, 0)
        self.assertEqual(sum(" install " in call for call in self.calls("apt-get")), 1)

    def test_the_demo_starts_without_the_modules_that_come_beside(self):
        """Its arguments cannot be checked before: numpy comes with matplotlib."""
        shadow = self.repository / "shadow" / "numpy.py"
        shadow.parent.mkdir()
        shadow.write_text("raise ModuleNotFoundError(\"No module named 'numpy'\")\n", encoding="utf-8")
        path = self.bin / "apt-get"
        comes = f'case "$*" in *matplotlib*) rm -f {shadow} ;; esac\n'
        # Apt ends when the build has begun, or is not going to.
        begun = 'grep -q ^ninja "$MACHINE/log" && break; sleep 1'
        waits = f"for n in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do {begun}; done"
        slow = f'case "$*" in *matplotlib*) {waits} ;; esac\n'
        (self.bin / "sleep").symlink_to("/usr/bin/sleep")
        text = path.read_text(encoding="utf-8")
        path.write_text(text.replace("#!/bin/sh\n", "#!/bin/sh\n" + slow + comes), encoding="utf-8")
        done = self.ended(self.start("--yes", "demo", "--jobs", "0", PYTHONPATH=str(shadow.parent)), 2)
        self.assertNotIn("ModuleNotFoundError", done.stderr)
        self.assertIn("argument --jobs", done.stderr)
        self.assertEqual([c.split()[3] for c in self.log() if c.startswith("ninja")], ["feltgate_run"])

    def test_a_launcher_that_ends_early_leaves_no_apt_behind(self):
        """An option that is refused before the build; apt is slow."""
        path = self.bin / "apt-get"
        (self.bin / "sleep").symlink_to("/usr/bin/sleep")
        slow = 'case "$*" in *matplotlib*) sleep 8; echo "apt ended" >>"$MACHINE/log" ;; esac\n'
        text = path.read_text(encoding="utf-8")
        path.write_text(text.replace("#!/bin/sh\n", "#!/bin/sh\n" + slow), encoding="utf-8")
        self.ended(self.start("--yes", "demo", "--no-such-option"), 2, "waiting for the other packages")
        self.assertIn("apt ended", self.log())


class Help(Machine):
    def test_every_command_helps_on_a_bare_machine(self):
        names = re.findall(r"^  ([a-z]+) ", self.start("--help").stdout, re.M)
        self.assertIn("explore", names)
        for name in names:
            for words in ((name, "--help"), (name, "-h"), ("help", name)):
                done = self.ended(self.start(*words))
                self.assertEqual(done.stdout, help_texts.committed()[name])
        self.assertEqual(self.log(), [])
        self.assertFalse((self.repository / "build").exists())

    def test_help_of_a_verb(self):
        done = self.start("explore", "page", "--help")
        self.assertIn("feltgate explore page", done.stdout)
        self.assertEqual(self.log(), [])

    def test_a_command_that_is_none(self):
        self.ended(self.start("rnu", "--help"), 2, "no subcommand 'rnu'")


class Tables(Machine):
    def test_the_page_of_a_table_needs_no_build(self):
        self.installed("python3", "python3-matplotlib")
        table = str(ROOT / "vectors/spaces/trade.csv")
        out = self.folder / "out"
        self.ended(self.start("explore", "page", table, "-o", str(out)))
        self.assertTrue((out / "explore.html").is_file())
        self.assertLessEqual({c.split()[0] for c in self.log()}, {"dpkg-query", "python3"})
        self.assertFalse(list(self.folder.rglob("venv-*")))

    def test_an_option_asks_for_its_packages_wherever_it_is(self):
        self.installed(*BUILD_PACKAGES)
        for words, package in (
            (("law", "--gappa", "out", "x.law"), "gappa"),
            (("law", "x.law", "--gappa=out"), "gappa"),
            (("host", "--picture=o", "PORT", "watch"), "python3-matplotlib"),
        ):
            self.assertIn(package, self.start(*words).stderr)

    def test_python_is_asked_for_and_nothing_else(self):
        done = self.ended(self.start("explore", "page", str(ROOT / "vectors/spaces/trade.csv")), 2)
        self.assertIn("apt-get install --yes --no-install-recommends python3 python3-matplotlib\n", done.stderr)


class Presets(Machine):
    def built(self, *words):
        """The targets of one start."""
        done = self.ended(self.start(*words, FELTGATE_SKIP_PACKAGES="1"))
        log = self.log()
        self.assertFalse([c for c in log if c.startswith("cmake") and "PRESET" in c])
        self.said = done.stdout
        return [c.split()[3:] for c in log if c.startswith("ninja")]

    def recording(self, design):
        path = self.folder / f"{design}.board"
        path.write_text(f"feltgate-board/1\n# written by a board\ndesign {design}\n", encoding="utf-8")
        return str(path)

    def test_a_preset_burdens_the_command_that_names_it_and_no_other(self):
        self.installed(*BUILD_PACKAGES)
        self.assertEqual(self.built("run", "membrane", "--design", "fast"), [["feltgate_fast"]])
        self.assertIn("program feltgate_fast run membrane --design fast\n", self.said)
        self.assertEqual(self.built("run", "membrane"), [["feltgate_run"]])
        self.assertIn("program feltgate_run run membrane\n", self.said)
        self.assertEqual(self.built("run", "wall", "--design=exact"), [["feltgate_exact"]])
        self.assertEqual(self.built("stability", "balanced"), [["feltgate_balanced"]])
        self.assertEqual(self.built("design", "fast"), [["feltgate"]])
        self.assertEqual(self.built("run", "wall", "--design", "paper"), [["feltgate"]])
        self.assertEqual(self.built("run", "wall", "--design", "my/own.toml"), [["feltgate"]])
        self.assertEqual(self.built("rates", "wall", "--design", "fast"), [["feltgate_fast"]])
        # Programs of their own and scripts have all designs, or none.
        out = str(self.folder / "out")
        for words, target in (
            (("board", "--design", "lever_law", "--hand", "swing"), "feltgate_board_lever_law"),
            (("board", "--design", "paper"), "feltgate_board"),
            (("board", "--rtl"), "feltgate_board_rtl_lever"),
            (("board", "--design=pantograph_law", "--rtl"), "feltgate_board_rtl_pantograph_law"),
            (("board", "--replay", self.recording("gimbal_motor")), "feltgate_board_gimbal_motor"),
            (("board", "--rtl", "--replay", self.recording("fast")), "feltgate_board_rtl_fast"),
            (("host", "PORT", "info", "--design", "lever_law"), "feltgate_host"),
            (("product", "board", "--design", "fast", "-o", out), "feltgate_generate"),
        ):
            self.assertEqual(self.built(*words), [[target]])
        # That none has the name is said by any program.
        self.assertEqual(self.built("run", "wall", "--design", "faster"), [["feltgate_run"]])

    def test_a_run_without_rtl_builds_none(self):
        self.installed(*BUILD_PACKAGES)
        for engine, program in (
            ("twin", "twin"), ("twin,double", "twin"), ("all", "run"), ("twin,rtl", "run"), ("lockstep", "run"),
        ):
            with self.subTest(engine):
                self.assertEqual(self.built("run", "membrane", "--engine", engine), [[f"feltgate_{program}"]])
                self.assertEqual(self.built("replay", f"--engine={engine}", "a.csv"), [[f"feltgate_{program}"]])
        self.assertEqual(self.built("import", "a.sr"), [["feltgate_twin"]])
        self.installed(*BUILD_PACKAGES, "libtinygltf-dev", "libmeshoptimizer-dev")
        self.assertEqual(self.built("touch", "a.glb"), [["feltgate_touch"]])
        self.assertEqual(self.built("touch", "a.glb", "--engine", "all"), [["feltgate_touch_rtl"]])

    def test_a_scene_with_a_law_takes_the_design_with_an_engine(self):
        self.installed(*BUILD_PACKAGES)
        mine = self.folder / "mine.toml"
        mine.write_text('[core]\nscene = "law"\nlaw = "my.law"\n', encoding="utf-8")
        self.assertEqual(self.built("run", "--csv", "out", str(mine)), [["feltgate_lever_law"]])
        self.assertIn(f"--csv out {mine} --design lever_law\n", self.said)
        self.assertEqual(self.built("run", str(mine), "--design", "fast"), [["feltgate_fast"]])

    def test_rates_run_laws(self):
        self.installed(*BUILD_PACKAGES)
        self.assertEqual(self.built("rates", "wall"), [["feltgate_lever_law"]])
        # That has the twin of each device; the RTL is in the device's own program.
        scene = self.folder / "mine.toml"
        scene.write_text('device = "stylus"\n', encoding="utf-8")
        self.assertEqual(self.built("rates", str(scene)), [["feltgate_lever_law"]])
        locked = self.built("rates", str(scene), "--lock-step")
        self.assertEqual(locked, [["feltgate_stylus_law"]])
        self.assertEqual(self.built("rates", "wall", "--lock-step"), [["feltgate_lever_law"]])

    def test_trim_runs_laws_and_devices(self):
        self.installed(*BUILD_PACKAGES)
        self.assertEqual(self.built("trim", "membrane"), [["feltgate"]])
        self.assertEqual(self.built("trim", "detent"), [["feltgate_lever_law"]])
        self.assertEqual(self.built("trim", "coupled_levers", "--quiet"), [["feltgate_lever_law"]])

    def test_the_demo_has_scenes_with_laws(self):
        self.installed(*BUILD_PACKAGES)
        # The first program is there before the demo begins; it builds the others beside its runs.
        self.start("demo", "--no-figures", FELTGATE_SKIP_PACKAGES="1")
        first, *others = [c.split()[3:] for c in self.log() if c.startswith("ninja")]
        self.assertEqual(first, ["feltgate_run"])
        self.assertEqual(others[0], ["feltgate_lever_law"])
        devices = ("lever", "pantograph", "two_levers", "stylus", "gimbal")
        motors = ("feltgate_gimbal_motor", "feltgate_lever_current")
        wanted = {"feltgate", *motors, *(f"feltgate_{name}_law" for name in devices)}
        self.assertEqual(sorted(*zip(*others)), sorted(wanted))


class Arguments(Machine):
    def test_what_is_refused_fetches_and_builds_nothing(self):
        for words, said in (
            (("prove", "--defects", "x"), "argument --defects"),
            (("prove", "--list", "--update"), "--update"),
            (("prove", "limitr"), "no proof of limitr"),
            (("mutate", "--require", "2"), "argument --require"),
            (("mutate", "--count", "-1"), "argument --count"),
        ):
            with self.subTest(words):
                self.setUp()
                self.installed(*BUILD_PACKAGES)
                done = self.ended(self.start(*words, FELTGATE_SKIP_PACKAGES="1"), 2, said)
                self.assertEqual([c.split()[0] for c in self.log()], ["python3"])
                self.assertNotIn("fetching", done.stderr)


class Tests(Machine):
    def setUp(self):
        super().setUp()
        self.installed(*BUILD_PACKAGES)
        build = self.repository / "build"
        build.mkdir()
        (build / "CTestTestfile.cmake").write_text(
            f'add_test([=[a]=] "{build}/a_test")\n', encoding="utf-8"
        )
        self.tests("a")
        (self.folder / "outputs").write_text("a_test: CXX\nb_test: CXX\n", encoding="utf-8")

    def tests(self, *names):
        """What CTest says there is."""
        found = [{"name": name, "properties": [LABELS]} for name in names]
        text = json.dumps({"tests": found})
        (self.folder / "tests.json").write_text(text, encoding="utf-8")

    def test_a_name_builds_what_its_tests_need(self):
        done = self.ended(self.start("test", "a", FELTGATE_SKIP_PACKAGES="1"))
        self.assertEqual(done.stdout.splitlines()[-1], "1 passed, 0 failed")
        log = self.log()
        built = [c.split(maxsplit=3)[3] for c in log if c.startswith("ninja") and " -t " not in c]
        self.assertEqual(built, ["build.ninja", "a_test"])
        self.assertTrue([c for c in log if c.startswith("ctest") and c.endswith("-R a -C Named")])

    def test_the_list_builds_nothing(self):
        done = self.ended(self.start("test", "--list", FELTGATE_SKIP_PACKAGES="1"))
        self.assertEqual(done.stdout, "a  unit\n")
        self.assertEqual(self.calls("ninja")[0].split()[2:], ["build.ninja"])

    def test_a_name_that_none_has(self):
        self.tests()
        self.ended(self.start("test", "zzz", FELTGATE_SKIP_PACKAGES="1"), 2, "no test matches 'zzz'")
        self.assertEqual(len(self.calls("ninja")), 1)  # configured, nothing built


if __name__ == "__main__":
    unittest.main()
