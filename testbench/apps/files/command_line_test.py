#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What the command line refuses: one line that names it, its range or the nearest name.

Documentation: README.md
"""

import json
import unittest

from bench import ROOT, Bench

SEED = "a whole number from 0 to 18446744073709551615"
SECONDS = "a number above 0, to 100000 s"
NUMBERS = (
    ("stability", "--rate", ("nan", "inf", "0", "1e300", "1000,nan", "x"), "1 to 1000000 Hz"),
    ("stability", "--damping", ("nan", "-1", "-nan", "2"), "a number from 0 to 1 Nm s/rad"),
    ("replay x.vec", "--duration", ("nan", "-1", "0", "1e300", "inf", "x"), SECONDS),
    ("replay x.vec", "--sample-hz", ("nan", "0", "-1", "inf", "2.5"), "number from 1 to 1000000000000 Hz"),
    ("trim membrane", "--duration", ("nan", "1e300", "-1", "0"), SECONDS),
    ("trim membrane", "--window", ("nan", "0"), "a number from 0.01 to 1000 ms"),
    ("trim membrane", "--jobs", ("0", "65", "1e-1", "nan"), "a whole number from 1 to 64"),
    ("run membrane", "--every", ("0", "-1", "1.5", "nan", "99999999999"), "from 1 to 1000000000"),
    ("run membrane", "--seed", ("-1", "1.5", "nan", "18446744073709551616", "0x1"), SEED),
    ("replay x.vec", "--seed", ("-1",), SEED),
    ("import x.vec y.vec", "--seed", ("-1",), SEED),
    ("trim membrane", "--seed", ("-1",), SEED),
)


class CommandLine(Bench):
    def refused(self, *words, said):
        self.assert_refused(self.finished(*words), *said)
        self.assert_only()

    def test_trim_of_a_device_has_no_plant(self):
        self.refused("trim", "coupled_levers", "--plant", "p24", said=("--plant is for scenes of one lever",))

    def test_a_law_where_none_is_taken(self):
        self.refused("replay", "x.vec", "--scene", "law", said=("--scene law", "loads no program"))

    def test_numbers(self):
        for command, option, values, accepted in NUMBERS:
            for value in values:
                with self.subTest(command, option=option, value=value):
                    wrong = value.rpartition(",")[2]
                    said = (f"feltgate: {option}: {wrong} is not ", f"{accepted}; see feltgate ")
                    self.refused(*command.split(), f"{option}={value}", said=said)

    def test_empty_words(self):
        for words in (("run", "short.toml", "--json", ""), ("figures", "-o", ""), ("replay", "")):
            with self.subTest(words):
                self.refused(*words, said=(f"the word after {words[-2]} is empty",))
        self.refused("run", "short.toml", "--report=", said=("--report= has no value",))

    def test_a_folder_is_no_law(self):
        for path in (".", "..", "./", self.folder):
            self.refused("law", path, said=(f"{path}: is a folder; give a file in it",))

    def test_a_binary_table_reaches_no_terminal(self):
        table = b"\xff\x9b\x1b[2J,A\xc3\xa9,\xc3(,\x80\n" + bytes(range(128, 200)) + b"\n"
        self.path("binary.csv").write_bytes(table)
        self.given.add("binary.csv")
        for words in (("replay", "binary.csv"), ("import", "binary.csv", "x.vec")):
            done = self.finished(*words)
            self.assertEqual((done.returncode, done.out), (2, ""), done.err)
            self.assertIn("A\u00e9", done.err)  # UTF-8 is what a terminal takes
            self.assertNotRegex(done.err, r"[\x00-\x09\x0b-\x1f\x7f-\x9f\udc80-\udcff]")

    def test_a_column_that_begins_again_and_times_without_a_unit(self):
        rows = "".join(f"{5 * n},{(350 + n) % 360}\n" for n in range(20))
        self.put("log.csv", "time,angle_deg\n" + rows)
        self.given.add("log.csv")
        words = ("import", "log.csv", "log.vec", "--scale", "4096/360")
        done = self.finished(*words)
        self.assertEqual(done.returncode, 0, done.err)
        self.assertRegex(done.err, r"(?m)^warning: log.csv:2: the rows are 5 s apart, .*--time-unit ms")
        self.assertRegex(done.err, r"(?m)^warning: log.csv:12: 'angle_deg' goes .* give --wrap 360$")
        # An angle of 19 degrees is 216 counts; the wrap may stand before the file.
        for more in (("--wrap",), ("--wrap", "360"), ("--wrap=360",)):
            done = self.finished(*words, "--time-unit", "ms", *more)
            self.assertEqual((done.returncode, done.err), (0, ""))
            self.assertIn("0.095 s", done.out)
            edges = self.path("log.vec").read_text(encoding="utf-8").splitlines()[2:-1]
            self.assertEqual(len(edges), 216)
        self.path("log.vec").unlink()
        for more in (("--wrap=-1",), ("--wrap", "2 turns")):
            self.refused(*words, *more, said=(" is not a finite number above 0",))
        self.refused("replay", "--wrap", "log.csv", "--quiet", said=("put --wrap behind the file",))
        self.refused(*words, "--time-unit", "h", said=("--time-unit", "h"))

    def test_trim_ends_in_a_set_that_breaks_an_expectation(self):
        scene = (ROOT / "testbench/studies/trim/push.toml").read_text(encoding="utf-8")
        self.path("push.toml").write_text(scene + '[[expect]]\nfigure = "faults"\nlow = 1\n')
        self.given.add("push.toml")
        words = ("--tolerance", "20%", "--unseen", "1", "-o", "trimmed.toml")
        done = self.finished("trim", "push.toml", *words)
        self.assertEqual(done.returncode, 1, done.out)
        self.assertRegex(done.out, r"^trimmed, not as expected: .*faults")
        self.assert_only()

    def test_units(self):
        for words, said in (
            (("run", "wall", "--set", "torque_limit=1V"), "1V is not in Nm; give it in Nm"),
            (("run", "wall", "--set", "wall_stiffness=4Nm"),
             "give it in Nm/count, or in Nm/rad"),
            (("run", "wall", "--set", "torque_limit=20000mNm"), "torque_limit = 20 "),
            (("run", "wall", "--set", "wall_contact=nan rad"), "is no number"),
            (("trim", "wall", "--duration", "5V"), "--duration: 5V is not in s; give it in s"),
            (("trim", "wall", "--duration", "1us"), "shorter than 10 windows"),
            (("replay", "x.vec", "--duration=2m"), "2m is not in s; give it in s"),
            (("stability", "--damping", "2V"), "2V is not in Nm s/rad"),
        ):
            with self.subTest(words):
                self.refused(*words, said=(said,))

    def test_the_nearest_name(self):
        for words, said in (
            (("rnu",), 'command rnu is unknown; did you mean "run"?'),
            (("run", "membrane", "--desing", "lever"), 'did you mean "--design"?'),
            (("run", "membrane", "--desing=lever"), 'option --desing is unknown; did you mean'),
            (("run", "membrnae"), '"membrnae" is not in vectors/scenes; did you mean "membrane"?'),
            (("run", "mebrane.toml"), "did you mean membrane, which is in vectors/scenes?"),
            (("run", "membrane", "--plant", "p42"), '"p42" is not in vectors/plants; did you mean'),
            (("stability", ROOT / "vectors/scenes/detent.toml", "--plot", "out"), "leave out --rate, --damping"),
            (("trim", "membrane", "--design", "levr"), 'did you mean "lever"?'),
        ):
            with self.subTest(words):
                self.refused(*words, said=(said,))

    def test_a_folder_is_no_scene(self):
        self.path("scenes.toml").mkdir()
        self.given.add("scenes.toml")
        for name in (self.folder, "./", "scenes.toml"):
            for command in ("run", "trim"):
                with self.subTest(command, name=name):
                    self.refused(command, name, said=(f"{name}: is a folder; give a file in it",))
        self.refused("run", "short.toml", "--plant", "./", said=("./: is a folder",))
        self.refused("design", "./", said=("./: is a folder",))
        for command in ("shape", "texture"):
            self.refused(command, "./", said=("./ is a folder; give a file in it",))

    def test_what_a_scene_may_be_taken_for(self):
        begin = self.path("short.toml").read_text().replace("start_rad = 0.0", "start_rad = 0.8")
        event = '[[event]]\nat_s = {}\n{} = true\n'
        self.path("short.toml").write_text(
            begin + event.format(0.0005, "stop") + event.format(0.001, "arm")
        )
        out = self.run_it().out
        self.assertIn("the lever starts, 0.8 rad: what wall puts at an angle", out)
        self.assertIn("arm = true at 0.001 s does nothing: the stop of 0.0005 s", out)
        self.path("short.toml").write_text(begin.replace('"wall"', '"damper"'))
        self.assertNotIn("note: ", self.run_it().out)
        again = begin.replace('"wall"', '"damper"') + event.format(0.001, "arm")
        self.path("short.toml").write_text(again)
        self.assertIn("arm = true at 0.001 s is no new request", self.run_it().out)
        low = '[[event]]\nat_s = 0.0005\narm = false\n'
        self.path("short.toml").write_text(again.replace("[[event]]", low + "[[event]]", 1))
        self.assertNotIn("note: ", self.run_it().out)

    def test_a_design_by_its_path(self):
        ours = ROOT / "rtl/designs/lever.toml"
        done = self.run_it("--design", ours, "--json", "a.json")
        self.assertEqual(done.returncode, 0, done.err)
        self.assertEqual(json.loads(self.path("a.json").read_text())["design"], "lever")
        # Another design runs in the twin at once; its RTL is in no program.
        self.given.add("mine.toml")
        self.path("mine.toml").write_text(ours.read_text().replace("torque_limit_nm = 0.5", "torque_limit_nm = 0.4"))
        done = self.run_it("--design", "mine.toml", "--json", "a.json")
        self.assertEqual(done.returncode, 0, done.err)
        self.assertEqual(json.loads(self.path("a.json").read_text())["design"], "mine")
        self.path("a.json").unlink()
        self.refused("run", "short.toml", "--design", "mine.toml", said=("its RTL is not in this program",))
        # A design of a built name that says something else is not that.
        self.given.add("lever.toml")
        self.path("lever.toml").write_text(self.path("mine.toml").read_text())
        self.refused("run", "short.toml", "--design", "lever.toml", said=("another design of this name",))


if __name__ == "__main__":
    unittest.main()
