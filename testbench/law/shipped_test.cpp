// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every shipped law against its formula, written here by hand. Documentation: docs/laws.md
#include <cmath>

#include "catch.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

TEST_CASE("detent: the sine of a click") {
  Running<> law(shipped("detent"));
  CHECK(law.law().name == "detent");
  CHECK(law.law().summary == "a knob with soft clicks");
  CHECK(law.law().parameters[1].comment == "per turn");
  for (double x = -7; x < 7; x += 0.01) {
    CHECK(law.torque({{"position", x}}) == Approx(-0.05 * std::sin(24 * x)).margin(1e-15));
  }
  law.set("amplitude", 0.3);
  law.set("clicks", 100);
  CHECK(law.torque({{"position", 0.4}}) == Approx(-0.3 * std::sin(40)));
}
