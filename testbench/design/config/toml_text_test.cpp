// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Letters beyond ASCII in a TOML file: welcome in strings and comments, refused elsewhere.
// Documentation: docs/testing.md
#include "files/toml/toml_text.hpp"

#include "catch.hpp"

using feltgate::config::stray_line;

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
