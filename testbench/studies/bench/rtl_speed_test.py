# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Two versions of the RTL against each other: ratio, equal bits, one that differs, what is
refused."""

import contextlib
import io
import os
import re
import shutil
import tempfile
import unittest
from argparse import Namespace
from pathlib import Path
from unittest import mock

from testing import ROOT, Scratch

import rtl_speed


def measured(old, new):
    """What is printed of a short run of cores that nobody optimised: those are compiled soon."""
    options = Namespace(old=str(old), new=str(new), design="lever", links=2, rounds=1, clocks=30000)
    options.verbose = False
    said = io.StringIO()
    with tempfile.TemporaryDirectory() as work, mock.patch("rtl_speed.flags", lambda: ["-O1"]):
        with mock.patch("rtl_speed.instructions", lambda program, name: 1234.0):
            with contextlib.redirect_stdout(said):
                rtl_speed.measure(options, Path(work))
    return said.getvalue()


class Speed(Scratch):
    def test_equal_and_different(self):
        other = self.folder / "other"
        shutil.copytree(ROOT / "rtl", other / "rtl")
        velocity = other / "rtl/core/estimators/velocity_n.sv"
        text = velocity.read_text(encoding="utf-8")
        changed = text.replace("travel_q - oldest_q", "travel_q - oldest_q + 1'b1")
        self.assertNotEqual(text, changed)
        if "FELTGATE_WHOLE" in os.environ:
            said = measured(ROOT, ROOT)
            self.assertIn("snapshots are equal in every bit", said)
            ratio = float(re.search(r"times as fast: ([\d.e+-]+) \(", said)[1])
            self.assertGreater(ratio, 0.3)
            self.assertLess(ratio, 3.0)
        velocity.write_text(changed, encoding="utf-8")
        self.assertIn("snapshots are DIFFERENT", measured(ROOT, other))

    def test_flags_are_those_of_the_product(self):
        self.assertEqual(rtl_speed.flags()[0], "-O3")

    def test_no_version(self):
        with self.assertRaisesRegex(rtl_speed.SpeedError, "neither a folder"):
            rtl_speed.rtl_of("no-such-revision", Path())

    def test_objects_move(self):
        work, seen = self.folder, set()
        with mock.patch("rtl_speed.call") as call:
            for seed in range(8):
                rtl_speed.link([Path("a.o"), Path("b.o"), Path("c.o")], work, seed)
                order = [str(p) for p in call.call_args[0][0] if str(p).endswith(".o")]
                pad = (work / "pad0.s").read_text(encoding="utf-8")
                seen.add((tuple(order), pad))
        self.assertEqual(len(seen), 8)
        self.assertGreater(len({order for order, _ in seen}), 2)


if __name__ == "__main__":
    unittest.main()
