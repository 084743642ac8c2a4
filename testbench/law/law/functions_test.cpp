// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// sin, cos, exp, log, sqrt of binary128 against long double and against each other. Documentation:
// docs/laws.md
#include "feltgate/real_functions.hpp"

#include <cmath>

#include "catch.hpp"

using feltgate::Quad;
using namespace feltgate::law;

namespace {

double off(Quad a, Quad b) { return std::fabs(static_cast<double>(a - b)); }

}  // namespace

TEST_CASE("Quad: as long double, to its digits") {
  for (long double x = -40; x < 40; x += 0.173L) {
    const Quad q = x;
    CHECK(off(sine_of(q), std::sin(x)) < 1e-18);
    CHECK(off(cosine_of(q), std::cos(x)) < 1e-18);
    CHECK(off(exponential_of(q), std::exp(x)) <= 1e-18 * std::exp(static_cast<double>(x)));
    CHECK(off(arctangent_of(q), std::atan(x)) < 1e-18);
    if (x > 0) CHECK(off(logarithm_of(q), std::log(x)) < 1e-18);
    CHECK(off(root_of(Quad{q * q}), std::fabs(x)) < 1e-17);
    CHECK(off(floor_of(q), std::floor(x)) == 0);
  }
}

TEST_CASE("Quad: against each other, to its own digits") {
  for (int i = -300; i < 300; ++i) {
    const Quad x = static_cast<Quad>(i) / 17;
    const Quad s = sine_of(x), c = cosine_of(x);
    CHECK(off(s * s + c * c, 1) < 1e-31);
    CHECK(off(sine_of(2 * x), 2 * s * c) < 1e-31);
    CHECK(off(exponential_of(x) * exponential_of(-x), 1) < 1e-28);
    CHECK(off(logarithm_of(exponential_of(x)), x) < 1e-30);
    const Quad r = root_of(x * x + 1);
    CHECK(off(r * r, x * x + 1) < 1e-30);
  }
  CHECK(floor_of(static_cast<Quad>(-3)) == static_cast<Quad>(-3));
  CHECK(root_of(Quad{0}) == Quad{0});
}
