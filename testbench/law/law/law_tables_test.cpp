// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Tables of a law: what they compute. Documentation: docs/laws.md
#include <utility>

#include "catch.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

TEST_CASE("a table of a number is a number") {
  CHECK(torque_of("table f(x) on [0, 1] = x^2\nout torque = 1 Nm * (f(0.3) + f(7))") ==
        Approx(1.09));
  CHECK(
      torque_of("table f(x) periodic on [0, 1] through [0, 2, 0]\nout torque = 1 Nm * f(-3.75)") ==
      Approx(1));
}

TEST_CASE("tables: exact by their formula, or linear between samples") {
  const std::string text =
      "table f(x) on [0, 2] = x^2 with 4 segments\nout torque = 1 Nm * f(position)";
  Running<> exact(law_of(text)), sampled(law_of(text), Tables::sampled);
  const auto both = [&](double x) {
    return std::make_pair(exact.torque({{"position", x}}), sampled.torque({{"position", x}}));
  };
  CHECK(both(1.25) == std::make_pair(1.5625, 1.625));
  CHECK(both(1.5) == std::make_pair(2.25, 2.25));
  CHECK(both(2) == std::make_pair(4.0, 4.0));
  CHECK(both(7) == std::make_pair(4.0, 4.0));
  CHECK(both(-7) == std::make_pair(0.0, 0.0));
  Running<> scaled(
      law_of("table f(d) on [0, 20 mm] = 3 N/m * d\nout torque = 1 m * f(position * 1 m)"));
  CHECK(scaled.torque({{"position", 0.01}}) == Approx(0.03));
  Running<> nested(
      law_of("table f(x) on [0, 2] = x^2\ntable q(x) on [0, 2] = f(x) + 1\n"
             "let x = position\nout torque = 1 Nm * q(x)"));
  CHECK(nested.torque({{"position", 1.5}}) == Approx(3.25));
}

TEST_CASE("tables through points: linear between them, sampled or not") {
  const std::string text =
      "table f(x) on [1, 2] through [10, 30, 20] mNm\nout torque = f(position)";
  Running<> exact(law_of(text)), sampled(law_of(text), Tables::sampled);
  for (Running<>* one : {&exact, &sampled}) {
    CHECK(one->torque({{"position", 1.0}}) == Approx(0.010));
    CHECK(one->torque({{"position", 1.25}}) == Approx(0.020));
    CHECK(one->torque({{"position", 1.5}}) == Approx(0.030));
    CHECK(one->torque({{"position", 1.75}}) == Approx(0.025));
    CHECK(one->torque({{"position", 2.0}}) == Approx(0.020));
    CHECK(one->torque({{"position", 9.0}}) == Approx(0.020));
    CHECK(one->torque({{"position", -9.0}}) == Approx(0.010));
  }
  Running<> units(law_of("table f(x) on [0, 1] through [1 Nm, 2 Nm]\nout torque = f(position)"));
  CHECK(units.torque({{"position", 0.5}}) == Approx(1.5));
}

TEST_CASE("periodic tables go on as they began") {
  const std::string points =
      "table f(x) periodic on [1, 3] through [10, 30, 20, 0, 10] mNm\nout torque = f(position)";
  Running<> exact(law_of(points)), sampled(law_of(points), Tables::sampled);
  for (Running<>* one : {&exact, &sampled}) {
    for (const double turns : {0.0, 2.0, -2.0, 2000.0, -64.0}) {
      CHECK(one->torque({{"position", 1.0 + turns}}) == Approx(0.010));
      CHECK(one->torque({{"position", 1.25 + turns}}) == Approx(0.020));
      CHECK(one->torque({{"position", 2.75 + turns}}) == Approx(0.005));
    }
  }
  Running<> formula(
      law_of("table f(x) periodic on [-0.5, 0.5] = x^2\ntable q(x) on [-9, 9] = f(x + 0.25)\n"
             "out torque = 1 Nm * (f(position) + 10 * q(position))"));
  for (const double x : {-0.4, 0.1, 0.3, 7.2, -8.9}) {
    const double a = x - std::nearbyint(x), b = x + 0.25 - std::nearbyint(x + 0.25);
    CHECK(formula.torque({{"position", x}}) == Approx(a * a + 10 * b * b));
  }
}
