#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A package that the RTL cannot work with is refused by every front end, with what must hold in the
message. docs/designs.md

elaboration_test.py VERILATOR VENV: VENV has pyslang or is not there.
"""

import os
import re
import shutil
import sys
import unittest
from pathlib import Path

from testing import ROOT, Scratch, ran, week

RTL = ROOT / "rtl"
VERILATOR, VENV = sys.argv.pop(1), Path(sys.argv.pop(1))
PACKAGE = RTL / "generated/lever/cfg.sv"
MAP = RTL / "generated/map.sv"

# Top, constant of the package or parameter of the top that is changed, to what, and what must hold.
BAD = (
    ("sequencer", "CLOCKS_PER_TICK", 40, "CLOCKS_PER_TICK_must_hold_the_wave"),
    ("sequencer", "SCENE_SLOTS", "64'h144f", "slots_0_and_63_must_not_be_a_scenes"),
    ("checks", "MULTIPLIER_B_BITS", 25, "the_multiplier_must_be_35_by_18_bits"),
    ("checks", "COEFFICIENT_BITS", 18, "COEFFICIENT_BITS_must_fit_the_multiplier"),
    ("checks", "ROUNDING", 3, "ROUNDING_must_be_0_1_or_2"),
    ("checks", "VELOCITY_W", 33, "a_signal_must_fit_its_word_of_32_bits"),
    ("checks", "TRAVEL_BITS", 15, "TRAVEL_BITS_must_be_the_16_of_the_decoder"),
    ("checks", "OBSERVER_DIFFERENCE_W", 36, "a_filters_difference_must_fit_the_multiplier"),
    ("checks", "SCENE_OFFSET_F", 7, "SCENE_OFFSET_must_be_SCENE_POSITION_with_a_fraction"),
    ("checks", "RAMP_F", 16, "RAMP_must_be_TORQUE_with_more_fraction"),
    ("checks", "OBSERVER_F", 16, "OBSERVER_F_must_be_above_TORQUE_F"),
    ("checks", "DUTY_W", 14, "DUTY_must_be_the_13_bits_of_the_bridge"),
    ("checks", "LIMITER_W", 19, "LIMITER_W_must_hold_torque_current_voltage_and_duty"),
    ("checks", "SCENE_DISTANCE_W", 36, "every_operand_but_a_difference_must_fit_32_bits"),
    ("checks", "P_TENSION_STIFFNESS_F", 25, "both_springs_must_have_one_format"),
    ("checks", "SCENE_GUARD_BITS", 0, "a_scenes_torque_must_hold_its_terms_and_fit_the_limiter"),
    ("checks", "PHASES", 4, "PHASES_must_be_2_or_3"),
    ("checks", "CURRENT_ESTIMATE_W", 19, "CURRENT_ESTIMATE_must_fit_the_multiplier"),
    ("checks", "P_VELOCITY_A1_F", 0, "a_filters_product_must_have_the_bits_that_are_dropped"),
    ("checks", "P_DUTY_GAIN_F", -14, "a_product_of_torque_control_must_have_the_bits_that_are"),
    ("checks", "MULTIPLIER_LATENCY", 3, "the_map_must_have_the_latencies_of_this_RTL"),
    ("core", "PWM_PERIOD", 5001, "PWM_PERIOD_must_be_even_and_4_to_4094"),
    ("core", "CLOCKS_PER_TICK", 40, "CLOCKS_PER_TICK_must_hold_the_wave"),
    ("core", "EVENT_AT_SNAPSHOT", 48, "the_last_word_must_be_stored_before_the_tick_ends"),
    ("core", "DEAD_CLOCKS", 0, "DEAD_CLOCKS_must_be_1_to_64"),
    ("core", "SHORTEST_CLOCKS", 0, "SHORTEST_CLOCKS_must_be_1_to_255"),
    ("core", "INDEX_COUNTS", 4095, "INDEX_COUNTS_must_be_a_power_of_two"),
    ("core", "M1", 0, "M1_must_be_1_to_32767"),
    ("core", "VELOCITY_SHIFT", 10, "the_velocity_must_have_room_for_its_counts"),
    ("core", "VELOCITY_DIFFERENCE_W", 34, "the_widths_of_a_lowpass_must_nest"),
    ("core", "DUTY_W", 14, "DUTY_must_be_the_13_bits_of_the_bridge"),
    ("current_sense", "CLOCK_HZ", 39_000_000, "an_over_current_must_be_latched_within_5_us_and"),
    ("absolute_encoder", "HalfClocks", 3, "a_parameter_is_out_of_its_range"),
    ("commutation", "Period", 999, "PERIOD_must_be_even_and_4_to_4094_and_MODULATION_0_or_1"),
    ("field_oriented", "Period", 999, "PERIOD_must_be_even_and_4_to_4094"),
    ("pwm_three_phase", "DeadClocks", 0, "a_parameter_of_pwm_three_phase_is_out_of_its_range"),
)
WHOLE = "FELTGATE_WHOLE" in os.environ  # not a share of them
TOPS = {"core": "feltgate_core", "checks": "feltgate_checks", "sequencer": "sequencer",
        "current_sense": "current_sense",
        "absolute_encoder": "absolute_encoder", "commutation": "commutation",
        "field_oriented": "field_oriented", "pwm_three_phase": "pwm_three_phase"}


def rtl_of(top):
    if top != "core":
        return list(RTL.glob(f"core/**/{TOPS[top]}.sv"))
    listed = (RTL / "feltgate_core.f").read_text(encoding="utf-8").splitlines()
    return [RTL / n for n in listed if n and not n.startswith("//") and "_pkg" not in n]


def front_ends(top, files):
    """{name: command} of those that are here."""
    files = [str(file) for file in files]
    found = {"verilator": [VERILATOR, "--lint-only", "-Wall", "--top-module", top, *files]}
    if shutil.which("iverilog"):
        found["icarus"] = ["iverilog", "-g2012", "-t", "null", "-s", top, *files]
    if shutil.which("yosys"):
        read = " ".join(f'"{file}"' for file in files)
        script = f"read_verilog -sv {read}; hierarchy -check -top {top}"
        found["yosys"] = ["yosys", "-q", "-p", script]
    if (VENV / "bin/python").exists():
        python = [str(VENV / "bin/python"), "-B", str(ROOT / "scripts/slang_lint.py")]
        found["slang"] = [*python, "--top", top, *files]
    return found


class Elaboration(Scratch):
    def changed(self, top, constant, value):
        """Files of the top, with the constant changed in a package or in the top itself."""
        files, changed = [], 0
        for path in (PACKAGE, MAP, *RTL.glob(f"core/**/{TOPS[top]}.sv")):
            text, count = re.subn(
                rf"((?:localparam|parameter) [^=;]*\b{constant} *= )[^;,\n]+?( *(?:[;,]|//))", rf"\g<1>{value}\2",
                path.read_text(encoding="utf-8"),
            )
            files.append(self.put(path.name, text))
            changed += count
        self.assertTrue(changed, f"no constant {constant}")
        return [*files, *(path for path in rtl_of(top) if path.name != files[2].name)]

    def test_bad(self):
        for top, constant, value, wanted in BAD if WHOLE else BAD[week() % 12 :: 12]:
            files = self.changed(top, constant, value)
            for name, command in front_ends(TOPS[top], files).items():
                with self.subTest(f"{constant} = {value} by {name}"):
                    done = ran(*command, cwd=self.folder)
                    self.assertNotEqual(done.returncode, 0)
                    self.assertIn(wanted, done.stdout + done.stderr)

    def test_every_check_is_tried(self):
        names = set()
        for path in RTL.glob("core/**/*.sv"):
            names |= set(re.findall(r"^\s*(\w+) missing \(\);", path.read_text(), re.M))
        tried = {name for name in names for bad in BAD if name.startswith(bad[3])}
        self.assertEqual(sorted(names - tried), [])


if __name__ == "__main__":
    unittest.main()
