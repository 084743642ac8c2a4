// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The suggestion for a misspelt name, and the cases without a suggestion; letters beyond ASCII in a
// TOML file: welcome in strings and comments, refused elsewhere. Documentation: docs/designs.md,
// docs/testing.md
#include <set>

#include "catch.hpp"
#include "feltgate/nearest.hpp"
#include "files/toml/toml_reader.hpp"

using namespace feltgate::config;

namespace {

const std::set<std::string> scenes{"charge_attract", "charge_repel",       "damper",
                                   "membrane",       "spring_compression", "spring_tension",
                                   "torque_step",    "torque_step_cord",   "wall"};

}  // namespace

TEST_CASE("a mistake is a letter more, less, other or swapped") {
  CHECK(mistakes_between("", "") == 0);
  CHECK(mistakes_between("wall", "") == 4);
  CHECK(mistakes_between("", "wall") == 4);
  CHECK(mistakes_between("wall", "wall") == 0);
  CHECK(mistakes_between("wal", "wall") == 1);
  CHECK(mistakes_between("walll", "wall") == 1);
  CHECK(mistakes_between("wahl", "wall") == 1);
  CHECK(mistakes_between("wlal", "wall") == 1);
  CHECK(mistakes_between("WALL", "wall") == 0);
  CHECK(mistakes_between("torque-step", "torque_step") == 0);
  CHECK(mistakes_between("kitten", "sitting") == 3);
}

TEST_CASE("the nearest name is suggested") {
  CHECK(nearest("membrnae", scenes) == "membrane");
  CHECK(nearest("Damper", scenes) == "damper");
  CHECK(nearest("wal", scenes) == "wall");
  CHECK(nearest("torque_stp", scenes) == "torque_step");
  CHECK(nearest("charge_repell", scenes) == "charge_repel");
  CHECK(nearest("torque-step-cord", scenes) == "torque_step_cord");
  CHECK(nearest("spring_comp", scenes) == "spring_compression");  // goes on to one name only
  CHECK(did_you_mean("membrnae", scenes) == "did you mean \"membrane\"? ");
}

TEST_CASE("what resembles nothing suggests nothing") {
  CHECK(nearest("", scenes).empty());
  CHECK(nearest("ox", scenes).empty());
  CHECK(nearest("spring", scenes).empty());  // two begin so, and neither is near
  CHECK(nearest("gravity", scenes).empty());
  CHECK(nearest("J", std::vector<std::string>{"K", "B"}).empty());
  CHECK(nearest(std::string(100000, 'm'), scenes).empty());
  CHECK(nearest("wall", std::vector<std::string>{}).empty());
  CHECK(did_you_mean("gravity", scenes).empty());
}

TEST_CASE("letters beyond ASCII may stand in strings and comments", "[toml]") {
  CHECK(stray_line("") == 0);
  CHECK(stray_line("# ω\na = \"ω²\" # τ̂\nb = 'ω'\n") == 0);
  CHECK(stray_line("\xef\xbb\xbf"
                   "a = 1\n") == 0);
  CHECK(stray_line("a = \"\\\"ω\"\nb = \"\"\"ω\n\"ω\"\n\\\"\"\"ω\"\"\"\n") == 0);
  CHECK(stray_line("a = '''ω\nω'''\n") == 0);
}

TEST_CASE("and nowhere else", "[toml]") {
  CHECK(stray_line("ω = 1\n") == 1);
  CHECK(stray_line("a = 1\nω = 1\n") == 2);
  CHECK(stray_line("a = \"x\"ω\n") == 1);
  CHECK(stray_line("a = 'x\\'ω\n") == 1);
  CHECK(stray_line("a = \"x\nω = 1\n") == 2);
  CHECK(stray_line("a = \"\"\"x\"\"\"\nb = ω") == 2);
  CHECK(stray_line("# c\n\n  ω") == 3);
}
