// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The exit code of commands that make a law. Documentation: docs/devices/shapes.md
#include "apps/commands/made_law.hpp"

#include "catch.hpp"

TEST_CASE("a law whose proof failed ends its command with 1, a warning does not") {
  using namespace feltgate;
  CHECK(end_of({}) == exit_ok);
  CHECK(end_of({{}, {"the bound is 2 % of its range"}}) == exit_ok);
  CHECK(end_of({{"1 Nm was measured, the bound is 0.1 Nm"}, {}}) == exit_failed);
}
