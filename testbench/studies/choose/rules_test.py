# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The rules of feltgate choose on numbers made for it: which alternative is chosen, what the front
is, why a wish is not met; the designs of the table; scenes and laws as they are written again."""

import csv
import tomllib
import unittest

from testing import ROOT, Scratch, called, text_of

import choose
from exploration import choice, made_scene


def one(rate_hz, share, margin, ms, gates, mult18=2, **more):
    """An alternative with these figures."""
    part = {"part": "a", "rms_nm": share, "worst_nm": share, "from": "here"}
    found = {"design": "d", "rate_hz": rate_hz, "cutoff_rad_s": 500.0, "broken": [], "margin_by": "the rate", "built": True}
    found |= {"error": choice.error_of([part], 1.0)}
    found |= {"margin": margin and choice.summed([{"part": "b", "margin": margin}], "margin")}
    found |= {"latency": choice.summed([{"part": "c", "ms": ms}], "ms")}
    found |= {"gates": choice.gates_of(("d", {"lut4_equivalents": gates, "mult18": mult18, "bram": 6}), None)}
    return found | {"chips": {n: choice.fit(c, found["gates"], 1.9) for n, c in choice.CHIPS.items()}} | more


def wishes(objective=None, **stated):
    aims = {"torque_error": 0.01, "margin": 2.0, "chip": None, "latency": None}
    return aims | stated | {"stated": list(stated), "objective": objective}


SLOW = one(1e3, 0.009, 1.5, 0.9, 3000)
MIDDLE = one(1e4, 0.005, 4.0, 0.3, 3000)
FAST = one(1e6, 0.004, 5.0, 0.2, 3100)
ALL = [SLOW, MIDDLE, FAST]


class Choice(unittest.TestCase):
    def chosen(self, **words):
        return choice.choose(ALL, wishes(**words))[0]

    def test_fewest_gates_then_the_slowest_that_meets_all(self):
        self.assertIs(self.chosen(), MIDDLE)
        self.assertIs(self.chosen(margin=1.2), SLOW)
        self.assertIs(self.chosen(margin=4.5), FAST)
        self.assertIs(self.chosen(latency=0.25), FAST)
        self.assertIs(self.chosen(torque_error=0.0045), FAST)

    def test_objectives_are_of_what_meets_the_wishes(self):
        self.assertIs(self.chosen(objective="fastest"), FAST)
        self.assertIs(self.chosen(objective="stiffest"), FAST)
        self.assertIs(self.chosen(objective="smallest"), SLOW)  # the aims were not asked for
        self.assertIs(self.chosen(objective="smallest", margin=2.0), MIDDLE)

    def test_a_design_of_the_table_where_no_built_one_will_do(self):
        small = one(1e3, 0.009, 4.0, 0.9, 2000, built=False)
        all_of = [*ALL, small]
        self.assertIs(choice.choose(all_of, wishes())[0], MIDDLE)
        self.assertIs(choice.choose(all_of, wishes(objective="smallest"))[0], small)
        self.assertIn(small, choice.choose(all_of, wishes())[1])
        quick = one(1e6, 0.004, 4.0, 0.1, 4000, built=False)
        self.assertIs(choice.choose([*ALL, quick], wishes(latency=0.15))[0], quick)

    def test_a_wish_that_cannot_be_is_told_with_the_best(self):
        asked = wishes(margin=8.0)
        best, _ = choice.choose(ALL, asked)
        self.assertIs(best, FAST)
        (told,) = choice.why_not(ALL, best, asked)
        self.assertEqual((told["wish"], told["is"], told["best"], told["stated"]), ("margin", 5.0, 5.0, True))
        self.assertFalse(told["alone"])

    def test_what_misses_a_wish_by_the_same_is_alike(self):
        table = one(1e4, 0.01330, 4.0, 0.3, 3000, built=False)
        all_of = [one(1e6, 0.01331, 4.0, 0.3, 3000), table, one(1e6, 0.02, 4.0, 0.3, 3000)]
        self.assertIs(choice.choose(all_of, wishes())[0], all_of[0])
        self.assertIs(choice.choose(all_of[1:], wishes())[0], table)

    def test_wishes_that_are_met_apart_alone(self):
        all_of = [one(1e3, 0.001, 1.0, 0.2, 3000), one(1e6, 0.1, 9.0, 0.2, 3000)]
        asked = wishes(margin=8.0, torque_error=0.002)
        best, _ = choice.choose(all_of, asked)
        (told,) = choice.why_not(all_of, best, asked)
        self.assertTrue(told["alone"])

    def test_nan_is_no_wish_met(self):
        nothing = float("nan")
        for figures in ((nothing, 5.0, 0.1), (0.001, nothing, 0.1), (0.001, 5.0, nothing)):
            self.assertTrue(choice.broken(one(1e3, *figures, 1), wishes(latency=1.0, margin=2.0)))

    def test_no_margin_breaks_the_wish_and_not_the_aim(self):
        without = one(1e3, 0.001, None, 0.1, 1)
        self.assertEqual(choice.broken(without, wishes()), [])
        self.assertEqual([b["wish"] for b in choice.broken(without, wishes(margin=2.0))], ["margin"])

    def test_expectations_of_the_scene_count(self):
        all_of = [one(1e3, 0.001, 5.0, 0.1, 1, broken=["x = 1, expected 2"]), FAST]
        self.assertIs(choice.choose(all_of, wishes())[0], FAST)

    def test_a_chip_by_what_it_lacks(self):
        engine = one(1e3, 0.001, 5.0, 0.1, 3500, mult18=4)
        (told,) = choice.broken(engine, wishes(chip="up5k"))
        self.assertEqual((told["wish"], told["by"]), ("chip", "multipliers"))
        self.assertEqual(choice.broken(engine, wishes(chip="gw1nr-9")), [])
        large = one(1e3, 0.001, 5.0, 0.1, 20_000, mult18=4)
        self.assertEqual(choice.broken(large, wishes(chip="ecp5-25")), [])
        self.assertEqual(choice.broken(large, wishes(chip="ep4ce22"))[0]["by"], "cells")

    def test_the_front_has_what_nothing_beats_and_five_at_most(self):
        beaten = one(1e6, 0.005, 4.0, 0.3, 3200)
        best, front = choice.choose([*ALL, beaten], wishes())
        self.assertEqual(front[0], best)
        self.assertFalse(any(o is beaten for o in front))
        many = [one(1e3 * n, 0.01 / n, float(n), 1.0 / n, 3000 + n) for n in range(1, 20)]
        self.assertEqual(len(choice.choose(many, wishes())[1]), 5)


class Designs(unittest.TestCase):
    def setUp(self):
        with open(ROOT / "vectors/spaces/trade.csv", newline="", encoding="utf-8") as file:
            self.rows = list(csv.DictReader(file))
        self.base = tomllib.loads(text_of("rtl/designs/lever.toml"))

    def test_registers_hold_a_cut_off_within_an_octave(self):
        kept, _ = choice.designs(self.rows, self.base, "wall")
        held = sorted(row.get(choice.CUTOFF) for row in kept if row.in_registers())
        self.assertEqual(held, [500.0, 600, 700, 950])
        for row in kept:
            figures = row.figures
            self.assertEqual((figures["coarse"], figures["stable"], figures["mismatches"]), ("False", "True", "0"))


class Written(Scratch):
    def test_every_shipped_scene_is_written_as_it_was_read(self):
        for path in sorted((ROOT / "vectors/scenes").glob("*.toml")):
            with self.subTest(path.stem):
                scene = tomllib.loads(path.read_text(encoding="utf-8"))
                self.assertEqual(tomllib.loads(made_scene.toml_text(["x"], scene)), scene)

    def test_a_cut_scene_has_no_later_events(self):
        scene = {"duration_s": 2.0, "event": [{"at_s": 0.1}, {"at_s": 1.0}], "expect": [{}]}
        scene["rest"] = {"from_s": 1.5}
        self.assertEqual(made_scene.cut(scene, 0.5), {"duration_s": 0.5, "event": [{"at_s": 0.1}]})
        self.assertEqual(made_scene.cut(scene, 2.0), scene)

    def test_a_law_gets_one_rate(self):
        told = made_scene.law_at("# a\n# b\nout torque = 1 Nm\n", 1e4)
        self.assertEqual(told, "# a\n# b\nrate = 10000 Hz\nout torque = 1 Nm\n")
        self.assertEqual(made_scene.law_at("# a\nrate = 40 kHz # b\nout", 1e4), "# a\nrate = 10000 Hz  # b\nout")


class Refused(Scratch):
    def test_what_is_no_scene_and_no_law(self):
        broken = self.put("broken.toml", "title = ")
        lawless = self.put("lawless.toml", '[core]\nscene = "law"\nlaw = "gone.law"\n')
        for given, said in (
            (broken, "not a scene file"),
            (self.put("bare.toml", 'name = "x"\n'), "it has no table [core]"),
            (lawless, "there is no law"),
        ):
            with self.subTest(given):
                status, out, err = called(choose.main, given, "-o", self.folder / "out")
                self.assertEqual((status, out), (2, ""))
                self.assertIn(said, err)
                self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
