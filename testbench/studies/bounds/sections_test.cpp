// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Peak gains of the sections against plain sums in 113 bits. Documentation: docs/error-bounds.md
#include "studies/bounds/sections.hpp"

#include "catch.hpp"
#include "feltgate/quad.hpp"
#include "studies/bounds/interval.hpp"

namespace feltgate::bounds {

namespace {

Quad magnitude_of(Quad x) { return x < 0 ? -x : x; }

TEST_CASE("an interval contains the exact result of every operation") {
  const double values[] = {0.1, 1.0 / 3, -7.3e-12, 5.0e-4, 1.0, -1e20, 0.0};
  for (const double x : values) {
    for (const double y : values) {
      const Interval a(x), b(y);
      const Quad qx = x, qy = y;
      const auto holds = [](const Interval& i, Quad exact) {
        return static_cast<Quad>(i.lower()) < exact && exact < static_cast<Quad>(i.upper());
      };
      CHECK(holds(a + b, qx + qy));
      CHECK(holds(a - b, qx - qy));
      if (x != 0 && y != 0) CHECK(holds(a * b, qx * qy));
      if (x != 0 && y != 0) CHECK(holds(a / b, qx / qy));
    }
  }
}

TEST_CASE("what has no bound has none after any sum") {
  const double endless = std::numeric_limits<double>::infinity();
  const Interval none(endless, endless);
  CHECK((none + Interval(1.0)).upper() == endless);
  CHECK((Interval(0.5) * (Interval(2.0) + none)).upper() == endless);
  CHECK((Interval(1.0) - none).lower() == -endless);
}

TEST_CASE("the gain of one pole is the sum of its powers") {
  for (const double pole : {0.0, 0.5, 0.9995, -0.7, 1 - 5e-6}) {
    Quad sum = 0, power = 1;
    for (long k = 0; k < 60'000'000 && power != 0; ++k) {
      sum += magnitude_of(power);
      power *= pole;
      if (magnitude_of(power) < static_cast<Quad>(1e-25)) break;
    }
    const Interval gain = one_pole_gain(Interval(pole));
    CHECK(gain.upper() >= static_cast<double>(sum));
    CHECK(gain.upper() <= static_cast<double>(sum) * (1 + 1e-9));
  }
  CHECK(one_pole_gain(Interval(1.0)).upper() == std::numeric_limits<double>::infinity());
}

TEST_CASE("the gain of an exchanged coefficient covers the summed difference") {
  const double pairs[][2] = {{5.0e-4, 5.00003e-4}, {0.3, 0.31}, {0.01, 0.0099}, {1.0, 0.999}};
  for (const auto& [p, q] : pairs) {
    Quad sum = 0, a = p, b = q;
    for (long k = 0; k < 400'000; ++k) {
      sum += magnitude_of(a - b);
      a *= 1 - static_cast<Quad>(p);
      b *= 1 - static_cast<Quad>(q);
    }
    const double gain = lowpass_change_gain(Interval(p), Interval(q));
    INFO("coefficients " << p << ", " << q);
    CHECK(gain >= static_cast<double>(sum));
    if (p < 0.1) CHECK(gain <= static_cast<double>(sum) * 1.02);
  }
  CHECK(lowpass_change_gain(Interval(0.0), Interval(0.1)) ==
        std::numeric_limits<double>::infinity());
}

TEST_CASE("the gain behind a high-pass is the variation of the cascade's response") {
  const double pairs[][2] = {
      {0.9995, 0.9995}, {0.9995, 0.9996084}, {0.995, 0.9995}, {0.0, 0.5}, {0.5, -0.5}};
  for (const auto& [p, q] : pairs) {
    Quad response = 0, before = 0, power = 1, sum = 0, peak = 0;
    for (long k = 0; k < 120'000; ++k) {
      response = q * response + power;
      power *= p;
      sum += magnitude_of(response - before);
      peak = response > peak ? response : peak;
      before = response;
    }
    const double gain = high_passed_gain(Interval(p), Interval(q));
    INFO("poles " << p << ", " << q);
    CHECK(gain >= static_cast<double>(sum));
    CHECK(gain <= static_cast<double>(sum) * 1.001);
    // Both poles positive: the response rises once and falls once.
    if (q >= 0) CHECK(static_cast<double>(sum) <= static_cast<double>(2 * peak) * (1 + 1e-12));
  }
  CHECK(high_passed_gain(Interval(1.0), Interval(0.5)) == std::numeric_limits<double>::infinity());
}

}  // namespace

}  // namespace feltgate::bounds
