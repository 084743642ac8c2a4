#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Where outputs go: files, links, devices, pipes, stdout; and what is refused before the run.

Documentation: docs/json.md
"""

import ctypes
import json
import os
import signal
import stat
import threading
import unittest

from bench import ROOT, Bench
from testing import ran


def drop_right_to_all():
    """Root without the capabilities DAC_OVERRIDE and DAC_READ_SEARCH meets rights as others do."""
    for capability in (1, 2):
        ctypes.CDLL(None).prctl(24, capability, 0, 0, 0)  # PR_CAPBSET_DROP


class Files(Bench):
    def test_a_new_file_and_one_that_is_replaced(self):
        self.assertEqual(self.run_it("--json", "new.json").returncode, 0)
        self.assertEqual(json.loads(self.path("new.json").read_text())["scene"], "short")
        self.path("old.json").write_text("old")
        self.path("old.json").chmod(0o640)
        self.assertEqual(self.run_it("--json", "old.json").returncode, 0)
        self.assertIn("scene", json.loads(self.path("old.json").read_text()))
        self.assertEqual(stat.S_IMODE(self.path("old.json").stat().st_mode), 0o640)
        self.assert_only("new.json", "old.json")

    def test_a_symbolic_link_stays_and_its_target_is_replaced(self):
        self.path("there").mkdir()
        self.path("there/target.csv").write_text("old")
        self.path("link.csv").symlink_to("there/target.csv")
        self.path("second.csv").symlink_to("link.csv")
        self.assertEqual(self.run_it("--csv", "second.csv").returncode, 0)
        self.assertTrue(self.path("second.csv").is_symlink())
        self.assertTrue(self.path("link.csv").is_symlink())
        self.assertTrue(self.path("there/target.csv").read_text().startswith("time_s,"))

    def test_a_dangling_link_gets_its_target(self):
        self.path("link.json").symlink_to("target.json")
        self.assertEqual(self.run_it("--json", "link.json").returncode, 0)
        self.assertTrue(self.path("link.json").is_symlink())
        self.assertTrue(self.path("target.json").is_file())
        self.assert_only("link.json", "target.json")

    def test_every_output_of_a_run_at_once(self):
        words = ("--json", "a.json", "--csv", "a.csv", "--fst", "a.fst", "--record", "a.vec")
        self.assertEqual(self.finished("run", "short.toml", *words).returncode, 0)
        self.assert_only("a.json", "a.csv", "a.fst", "a.vec")
        self.assertTrue(self.path("a.vec").read_text().endswith("\nend 100001\n"))


class InPlace(Bench):
    def test_stdout_is_for_the_output_alone(self):
        for name in ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
            with self.subTest(name):
                done = self.run_it("--json", name)
                self.assertEqual(done.returncode, 0)
                self.assertEqual(json.loads(done.out)["scene"], "short")
                self.assertIn("scene short", done.err)
                self.assert_only()

    def test_a_full_disk_is_told_and_costs_no_other_output(self):
        for option, other in (("--json", "--csv"), ("--csv", "--json"), ("--record", "--json")):
            with self.subTest(option):
                done = self.run_it(option, "/dev/full", other, "kept", "--quiet")
                self.assert_refused(done, f"{option} /dev/full: could not be written whole: No sp")
                self.assert_only("kept")
                self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode))
                self.path("kept").unlink()
        with open("/dev/full", "wb") as full:
            self.assert_refused(self.run_it(stdout=full), "stdout could not be written whole")

    def test_a_fifo_and_a_descriptor_of_the_shell(self):
        os.mkfifo(self.path("fifo"))
        got = []
        reader = threading.Thread(target=lambda: got.append(self.path("fifo").read_text()))
        reader.start()
        done = self.run_it("--csv", "fifo")
        reader.join()
        self.assertEqual(done.returncode, 0)
        self.assertTrue(got[0].startswith("time_s,"))
        self.assertTrue(stat.S_ISFIFO(self.path("fifo").stat().st_mode))
        script = '"$0" run short.toml --engine twin --json >(cat >told) --csv - | head -1; wait $!'
        ran("bash", "-c", f"set -o pipefail; {script}", *self.words(), cwd=self.folder)
        self.given.add("told")
        self.assert_only("fifo")

    def test_two_runs_into_one_folder(self):
        """The second one would replace what the first one said; at the same time or after it."""
        self.assertEqual(self.run_it("--report", "out").returncode, 0)
        before = {p.name: p.read_bytes() for p in self.path("out").iterdir()}
        done = self.run_it("--report", "out/", scene="long.toml")
        self.assert_refused(done, "--report out/: holds the report.html of a run before; choose")
        self.assertEqual({p.name: p.read_bytes() for p in self.path("out").iterdir()}, before)
        # A file of another run, without a report.
        self.path("kept").mkdir()
        self.path("kept/short.csv").write_text("mine\n")
        done = self.run_it("--report", "kept")
        self.assert_refused(done, "--report kept: kept/short.csv is there already and would be repl")
        self.assertEqual(self.path("kept/short.csv").read_text(), "mine\n")
        first = self.start("run", "long.toml", "--engine", "twin", "--report", "new/both")
        self.until(lambda: list(self.folder.rglob("*.part")))
        done = self.run_it("--report", "new/both")
        self.assert_refused(done, "--report new/both: another run writes there; choose another")
        first.send_signal(signal.SIGINT)
        first.wait()
        self.assertFalse(self.path("new").exists())


class Refused(Bench):
    def test_what_is_no_place_for_a_file(self):
        self.path("folder").mkdir()
        self.path("file").write_text("kept")
        self.path("round").symlink_to("round")
        for path, said in (
            ("folder", "is a folder"),
            (".", "is a folder"),
            ("new/", "is the name of a folder"),
            ("no/x.json", "the folder no cannot be used: No such file"),
            ("file/x.json", "Not a directory"),
            ("round", "choose another name"),
            ("", "has no name"),
            ("/proc/x.json", "cannot be written"),
            ("/dev/fd/77", "is not open for writing"),
            ("n" * 300, "File name too long"),
        ):
            for option in ("--json", "--csv", "--fst", "--record"):
                with self.subTest(option=option, path=path):
                    if path == "":
                        continue  # as if it were not given
                    done = self.run_it(f"{option}={path}", scene="long.toml")
                    self.assert_refused(done, f"feltgate: {option} {path}: ", said)
        self.assertEqual(self.path("file").read_text(), "kept")
        self.assert_only("folder", "file", "round")

    def test_a_waveform_needs_a_file(self):
        for path in ("-", "/dev/null"):
            done = self.finished("run", "long.toml", "--engine", "rtl", "--fst", path)
            self.assert_refused(done, f"--fst {path}: takes a file only")

    def test_two_outputs_on_one_path(self):
        self.path("link").symlink_to("same")
        self.path("sub").mkdir()
        self.path("same").write_text("kept")
        for one, two in (
            ("same", "same"),
            ("same", "./same"),
            ("same", "sub/../same"),
            ("same", self.path("same")),
            ("same", "link"),
            ("new", "./new"),
            ("-", "/dev/stdout"),
            ("/dev/full", "/dev/full"),
        ):
            with self.subTest(one=one, two=two):
                done = self.run_it("--json", one, "--csv", two, scene="long.toml")
                self.assert_refused(done, f"--json {one} and --csv {two} are the same")
        self.assertEqual(self.path("same").read_text(), "kept")
        self.assert_only("same", "link", "sub")

    def test_what_the_command_reads(self):
        for path in ("short.toml", "./short.toml", self.path("short.toml")):
            done = self.run_it("--json", path)
            self.assert_refused(done, "would replace short.toml, which is read")
        vector = ROOT / "vectors/traces/torque_step_cord.vec"
        self.path("r.vec").write_bytes(vector.read_bytes())
        done = self.finished("replay", "r.vec", "--json", "r.vec")
        self.assert_refused(done, "would replace r.vec, which is read")
        self.assertEqual(self.path("r.vec").read_bytes(), vector.read_bytes())
        # The motion of a hand and the numbers of a design are read too.
        self.path("hand.csv").write_text("time_s,theta_rad\n0,0\n0.01,0.1\n")
        self.path("hand.toml").write_text(
            'title = "t"\nabout = "a"\nduration_s = 0.01\n[core]\nscene = "free"\n'
            '[hand]\n[[hand.phase]]\nkind = "trace"\nfile = "hand.csv"\n'
        )
        done = self.run_it("--csv", "hand.csv", scene="hand.toml")
        self.assert_refused(done, "would replace hand.csv, which is read")
        self.path("lever").symlink_to(ROOT / "rtl/designs/lever.toml")
        done = self.run_it("--json", "lever")
        self.assert_refused(done, "rtl/designs/lever.toml, which is read")

    def test_rights(self):
        drop = {"preexec_fn": drop_right_to_all} if os.geteuid() == 0 else {}
        self.path("locked").mkdir()
        self.path("locked").chmod(0o500)
        self.path("kept").write_text("kept")
        self.path("kept").chmod(0o400)
        self.assert_refused(self.run_it("--json", "locked/x", **drop), "cannot be written", "Perm")
        self.assert_refused(self.run_it("--json", "kept", **drop), "is write-protected")
        self.assert_refused(self.run_it("--report", "locked", **drop), "--report locked: ")
        self.assertEqual(self.path("kept").read_text(), "kept")


class OtherCommands(Bench):
    """The same through every command that writes: onto /dev/full, a folder, stdout."""

    def commands(self):
        trim = ROOT / "testbench/studies/trim/push.toml"
        vector = ROOT / "vectors/traces/torque_step_cord.vec"
        study = ("stability", "--rate", "1000", "--damping", "0.003", "--no-bits")
        return {
            "import": (("import", vector), None),
            "design": (("design", "lever", "--for", "wall"), "-o"),
            "stability": (study, "--json"),
            "extremes": (("extremes", "wrap_32"), "--json"),
            "replay": (("replay", vector, "--engine", "twin"), "--json"),
            "trim": (("trim", trim, "--tolerance", "20%", "--unseen", "1"), "--json"),
        }

    def test_full_disk_folder_stdout(self):
        for name, (words, option) in self.commands().items():
            option = () if option is None else (option,)
            for path in ("/dev/full", ".", "-"):
                with self.subTest(name, path=path):
                    done = self.finished(*words, *option, path)
                    if path == "-":
                        self.assertIn(done.returncode, (0, 1), done.err)
                        self.assertRegex(done.out, r"\A(\{|feltgate-vector|#)")
                    elif path == ".":
                        self.assert_refused(done, "is a folder")
                    else:
                        self.assertEqual(done.returncode, 2)
                        self.assertIn("/dev/full: could not be written whole: ", done.err)
        self.assert_only()


if __name__ == "__main__":
    unittest.main()
