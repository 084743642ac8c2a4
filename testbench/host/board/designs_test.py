#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Boards of all designs: the twin repeats, tick by tick and byte by byte, what the RTL did while its motor armed and gave
a torque that a host set. Arguments: the designs."""

import sys
import unittest

from board_host_test import Board, BoardTest
from board_process import board_program

# Without --hand the hand of a scene holds them.
HELD = ("two_levers_law", "stylus_law", "gimbal_law")
DESIGNS = sys.argv[1:]


class Designs(BoardTest):
    def board(self, design, kind, *more):
        hand = () if design in HELD else ("--hand", "swing")
        words = ("--design", design, *hand, "--scene", "setpoint", "--arm", *more)
        return Board(self, *words, *(["--rtl"] if kind else []), kind=kind)

    def wait_for(self, port, name):
        for _ in range(100):
            if self.value(port, name) != 0:
                return
        self.fail(f"{name} stays 0")

    def test_the_twin_repeats_the_rtl(self):
        self.assertTrue(DESIGNS)
        for design in DESIGNS:
            with self.subTest(design), self.board(design, "_rtl", "--record", "a.board") as board:
                self.wait_for(board.port, "status.armed")
                self.host(board.port, "set", "setpoint_torque=0.02Nm")
                self.wait_for(board.port, "voltage")
                status, said = board.end()
                self.assertEqual(status, 0, said)
                self.assertRegex(said, r"sent \d{3,} bytes")
                words = ("--design", design)
                again = self.run_program(board_program(words), "--replay", "a.board")
                self.assertIn("identical to the recording", again)
                self.assertEqual(again.splitlines()[0], said.splitlines()[0])
                again = self.run_program(board_program(words, "_rtl"), "--rtl", "--replay", "a.board")
                self.assertIn("identical to the recording", again)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
