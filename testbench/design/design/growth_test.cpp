// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// No sum or product of the chain can overflow for any register values: interval arithmetic over the
// formats. Documentation: docs/designs.md
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "design_fixture.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"

using namespace feltgate;
using namespace feltgate::design;

namespace {

/// 113 bits: exact for every number here.
using Real113 = boost::multiprecision::cpp_bin_float_quad;

Real113 power(int k) { return ldexp(Real113(1), k); }

struct Interval {
  Real113 low, high;
};

/// The whole range of a format.
Interval range(Format f) {
  return {-f.sign * power(f.integer), power(f.integer) - power(-f.fraction)};
}

Interval operator+(const Interval& a, const Interval& b) {
  return {a.low + b.low, a.high + b.high};
}
Interval operator-(const Interval& a, const Interval& b) {
  return {a.low - b.high, a.high - b.low};
}
Interval operator*(const Interval& a, const Interval& b) {
  const auto [low, high] = std::minmax({Real113(a.low * b.low), Real113(a.low * b.high),
                                        Real113(a.high * b.low), Real113(a.high * b.high)});
  return {low, high};
}

/// Drops the bits below 2^-fraction.
Interval truncated(const Interval& x, int fraction) {
  return {floor(x.low * power(fraction)) * power(-fraction),
          floor(x.high * power(fraction)) * power(-fraction)};
}

Interval rounded(const Interval& x, int fraction) {
  const Real113 half = power(-fraction - 1);
  return truncated({x.low + half, x.high + half}, fraction);
}

bool fits(const Interval& x, Format f) { return x.low >= range(f).low && x.high <= range(f).high; }

/// Fits, and would not with one integer bit less.
bool fits_tightly(const Interval& x, Format f) {
  return fits(x, f) && !fits(x, {f.sign, f.integer - 1, f.fraction});
}

template <class D>
void check_intervals() {
  using P = typename D::P;
  constexpr Formats f = D::f;
  const Interval velocity = range(f.velocity), torque = range(f.torque), current = range(f.current);

  const Interval counts = range(f.travel_difference);
  CHECK(fits_tightly(counts * Interval{power(D::velocity_shift), power(D::velocity_shift)},
                     f.velocity_raw));
  CHECK(fits_tightly(truncated(velocity - velocity, f.velocity_difference.fraction),
                     f.velocity_difference));

  const Interval inertia = truncated(velocity * range(P::inertia_gain), f.inertia_torque.fraction);
  const Interval drive = truncated(current * range(P::torque_constant), f.drive_torque.fraction);
  const Interval state = range(f.observer);
  CHECK(fits_tightly(inertia, f.inertia_torque));
  CHECK(fits_tightly(drive, f.drive_torque));
  CHECK(fits_tightly(drive + inertia, f.observer));
  CHECK(fits_tightly(truncated(state - state, f.observer_difference.fraction),
                     f.observer_difference));
  CHECK(fits_tightly(state - inertia, f.observed));

  const int amperes = f.current_part.fraction;
  const Interval by_ref = truncated(torque * range(P::torque_gain), amperes);
  const Interval by_hat = truncated(torque * range(P::observer_gain), amperes);
  CHECK(fits(by_ref, f.current_part));
  CHECK(fits(by_hat, f.current_part));
  CHECK((fits_tightly(by_ref, f.current_part) || fits_tightly(by_hat, f.current_part)));
  CHECK(fits_tightly(range(f.current_part) + range(f.current_part), f.current_sum));
  CHECK(fits(truncated(range(f.voltage) * range(P::voltage_to_current), amperes), f.current_sum));

  const int volts = f.voltage_part.fraction;
  const Interval emf = truncated(velocity * range(P::emf_constant), volts);
  const Interval slope = truncated(torque * range(P::dead_voltage_slope), volts);
  const Interval resistive = truncated(current * range(P::voltage_gain), volts);
  CHECK(P::voltage_gain == P::voltage_gain_high);
  for (const Interval& part : {emf, slope, resistive}) CHECK(fits(part, f.voltage_part));
  // The dead voltage is the slope's product or its limit, a word in the format of a voltage.
  const Interval limit = range(P::dead_voltage);
  const Interval dead{std::min(slope.low, limit.low), std::max(slope.high, limit.high)};
  CHECK(fits(emf, f.emf));
  CHECK(fits(dead - emf, f.voltage_sum));
  CHECK(fits(range(f.voltage) - emf, f.voltage_sum));
  CHECK(fits(dead + resistive - emf, f.voltage_sum));

  const Interval applied = range(f.applied);
  CHECK(fits(range(f.voltage) + emf, f.applied));
  CHECK(fits_tightly(rounded(applied * range(P::duty_gain), 0), f.duty_sum));

  const int estimate = f.current_estimate_part.fraction;
  const Interval v_part = truncated(range(f.voltage) * range(P::inverse_resistance), estimate);
  const Interval w_part = truncated(velocity * range(P::emf_over_resistance), estimate);
  CHECK(fits(v_part, f.current_estimate_part));
  CHECK(fits(w_part, f.current_estimate_part));
  CHECK(fits(v_part - w_part, f.current_estimate));
  const Interval seen = range(f.current_estimate);
  const Interval square{0, std::max(Real113(seen.low * seen.low), Real113(seen.high * seen.high))};
  CHECK(fits(truncated(square, f.current_squared.fraction), f.current_squared));
}

}  // namespace

TEST_CASE("every intermediate format holds its extremes: paper", "[growth]") {
  check_intervals<Paper>();
}

TEST_CASE("every intermediate format holds its extremes: lever", "[growth]") {
  check_intervals<Lever>();
}
