// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// No sum or product of the chain can overflow for any register values: interval arithmetic over the
// formats, and the laws at every corner. Documentation: docs/designs.md
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "design_fixture.hpp"
#include "feltgate/dob.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/generated/reader.hpp"
#include "feltgate/torque_control.hpp"
#include "feltgate/velocity_n.hpp"

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

  using Law = TorqueControlLaw<D, Fixed>;
  CHECK(fits(range(P::voltage_window), Format::from_key(Law::kVoltageKey)));
  CHECK(fits(torque, Format::from_key(Law::kBorderKey)));
  CHECK(fits(range(f.duty), Format::from_key(Law::kDutyKey)));
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

/// Both ends, 0 and the last bit on either side.
template <class X>
std::array<X, 5> corners() {
  return {X::min(), X::from_raw(X::format.sign == 1 ? -1 : 0), X{}, X::from_raw(1), X::max()};
}

template <class X>
double real(X x) {
  return x.to_double();
}

/// A wrapped sum is off by its whole range; rounding only by last bits.
template <class X>
void check_value(X x, double exact, int last_bits) {
  CHECK(std::abs(real(x) - exact) <= last_bits * std::ldexp(1.0, -X::format.fraction));
}

template <class D>
void check_observer() {
  using P = typename D::P;
  using Law = DobLaw<D, Fixed>;
  using Velocity = typename VelocityLaw<D, Fixed>::Velocity;
  using Filter = typename VelocityLaw<D, Fixed>::Filter;
  const auto gain = fixed_of<P::inertia_gain.key()>::max();
  const auto ktn = fixed_of<P::torque_constant.key()>::max();
  for (const auto w : corners<Velocity>()) {
    for (const auto i : corners<fixed_of<D::f.current.key()>>()) {
      const auto inertia = Law::inertia(w * gain);
      const auto drive = Law::drive(i * ktn);
      check_value(inertia, real(w) * real(gain), 1);
      check_value(drive, real(i) * real(ktn), 1);
      check_value(Law::input(drive, inertia), real(drive) + real(inertia), 0);
    }
  }
  // One step of the filters from any state to any input stays between them, at any a1 below 1.
  using State = typename Law::State;
  for (const auto x : corners<State>()) {
    for (const auto y : corners<State>()) {
      for (const auto a1 : corners<fixed_of<P::observer_a1.key()>>()) {
        const auto next = Law::Filter::next(y, Law::Filter::operand(x, y) * a1);
        // The operand gives up low bits, so the step may fall short of the larger by some.
        const auto slack = std::int64_t{1}
                           << (D::f.observer.fraction - D::f.observer_difference.fraction);
        CHECK(next.raw() >= std::min(x.raw(), y.raw()) - slack);
        CHECK(next.raw() <= std::max(x.raw(), y.raw()));
      }
    }
  }
  for (const auto x : corners<Velocity>()) {
    for (const auto y : corners<Velocity>()) {
      for (const auto a1 : corners<fixed_of<P::velocity_a1.key()>>()) {
        const auto next = Filter::next(y, Filter::operand(x, y) * a1);
        CHECK(next.raw() >= std::min(x.raw(), y.raw()));
        CHECK(next.raw() <= std::max(x.raw(), y.raw()));
      }
    }
  }
}

/// Every parameter at the upper end of its word, the observer's signed gain at either; voltage and
/// duty limited to what their ports hold.
template <class D>
struct CornerWords : ParameterReader<D, CornerWords<D>> {
  explicit CornerWords(bool low) : observer_low(low) {}
  bool observer_low;
  template <int Key>
  fixed_of<Key> get(int address) const {
    if (address == D::A::observer_gain && observer_low) return fixed_of<Key>::min();
    if (address == D::A::duty_limit)
      return fixed_of<Key>::from_raw(fixed_of<D::f.duty.key()>::max_raw());
    if (address == D::A::voltage_window)
      return fixed_of<Key>::from_raw(fixed_of<D::f.voltage.key()>::max_raw());
    return fixed_of<Key>::max();
  }
};

double clamped(double x, double limit) { return std::clamp(x, -limit, limit); }

template <class D>
void check_control_at(const CornerWords<D>& words,
                      typename TorqueControlLaw<D, Fixed>::Torque tau_ref,
                      typename TorqueControlLaw<D, Fixed>::Torque tau_hat,
                      fixed_of<D::f.velocity.key()> w) {
  using P = typename D::P;
  using Law = TorqueControlLaw<D, Fixed>;
  TorqueControlStep<D, Fixed> step;
  step.tick(words, true, Mode::closed_loop, tau_ref, tau_hat, w);
  const double wanted_a =
      real(tau_ref) * real(words.torque_gain()) + real(tau_hat) * real(words.observer_gain());
  check_value(step.current, clamped(wanted_a, real(fixed_of<D::f.current.key()>::max())), 2);
  const double limit = real(fixed_of<Law::kVoltageKey>::max());
  const double slope = real(tau_ref) * real(words.dead_voltage_slope());
  const double emf = real(w) * real(words.emf_constant());
  const double wanted_v = clamped(slope, limit) + real(step.current) * real(words.voltage_gain()) -
                          (D::emf_in_law != 0 ? 0.0 : emf);
  const double most_v = real(fixed_of<D::f.voltage.key()>::max());
  const double duty = (clamped(wanted_v, most_v) + emf) * real(words.duty_gain());
  // What the truncated parts of the voltage lose, and the rounding of the duty.
  const int last_bits = 2 + static_cast<int>(std::ldexp(
                                3.0, P::duty_gain.integer - Law::LimitedVoltage::format.fraction));
  check_value(step.duty, clamped(duty, real(fixed_of<D::f.duty.key()>::max())), last_bits);
}

template <class D>
void check_control() {
  using Law = TorqueControlLaw<D, Fixed>;
  for (const bool low : {false, true}) {
    for (const auto tau_ref : corners<typename Law::Torque>()) {
      for (const auto tau_hat : corners<typename Law::Torque>()) {
        for (const auto w : corners<fixed_of<D::f.velocity.key()>>()) {
          check_control_at<D>(CornerWords<D>(low), tau_ref, tau_hat, w);
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("every intermediate format holds its extremes: paper", "[growth]") {
  check_intervals<Paper>();
}

TEST_CASE("every intermediate format holds its extremes: lever", "[growth]") {
  check_intervals<Lever>();
}

TEST_CASE("observer and filters at the corners", "[growth]") {
  check_observer<Paper>();
  check_observer<Lever>();
}

TEST_CASE("torque control at the corners", "[growth]") {
  check_control<Paper>();
  check_control<Lever>();
}
