// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// field_oriented: RTL against twin in every clock, and each voltage against the law in double with
// cosines of its own, within a bound; arming, direct voltage, the watch on an open phase; the
// longest voltage in several periods. Documentation: docs/blocks/three_phase.md
#include "feltgate/field_oriented.hpp"

#include <Vfield_oriented.h>

#include <cmath>

#include "catch.hpp"
#include "feltgate/commutation.hpp"
#include "feltgate/largest.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr int kPeriod = FIELD_PERIOD;
constexpr std::int32_t kMost = 131071;  // of limit and gains
constexpr int kLatency = 261, kBusy = 349;
constexpr double kOne = 131072;  // LSB of full scale and of supply/root 3
constexpr double kThirdOfTurn = 2 * M_PI / 3;

struct Adapter {
  static void drive(Vfield_oriented& rtl, const FieldOriented::In& in) {
    FELTGATE_DRIVE(rtl, in, armed, valid, direct, gain, offset, polarity, proportional, integral,
                   limit);
    rtl.reference_i = port_bits<19, std::uint32_t>(in.reference);
    rtl.current_a_i = port_bits<19, std::uint32_t>(in.current_a);
    rtl.current_b_i = port_bits<19, std::uint32_t>(in.current_b);
    rtl.emf_i = port_bits<18, std::uint32_t>(in.emf);
    rtl.position_i = static_cast<std::uint32_t>(in.position);
  }
  template <class Check>
  static void compare(Check& check, const Vfield_oriented& rtl, const FieldOriented::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, open, saturated, on_a, on_b, on_c, valid);
    check("current_q", sign_extend<21>(rtl.current_q_o), std::int64_t{out.current_q});
    check("resistive", sign_extend<19>(rtl.resistive_o), std::int64_t{out.resistive});
    check("across", sign_extend<19>(rtl.across_o), std::int64_t{out.across});
  }
};

using Bench = LockStep<Vfield_oriented, FieldOriented, Adapter>;

struct Vector {
  double x = 0, y = 0;
  Vector turned(double rad) const {
    return {x * std::cos(rad) - y * std::sin(rad), x * std::sin(rad) + y * std::cos(rad)};
  }
  double length() const { return std::hypot(x, y); }
};

/// Kinds of inputs, each for a while: anything in each clock, the ends of all ranges, small
/// numbers, and three windings in the loop, of which one may be open.
struct RandomInputs {
  Random random;
  FieldOriented::In in{};
  enum Kind { anything, ends, small, winding, kinds } kind = anything;
  int every = kBusy, open = 3;
  double speed = 0, angle = 0;  // counts per clock, counts
  Vector current{};             // of the stator

  FieldOriented::In operator()(std::int64_t clock, const FieldOriented::Out& out) {
    if (random.one_in(12'000)) begin();
    if (random.one_in(in.armed ? 40'000 : 30)) in.armed = !in.armed;
    in.valid = clock % every == 0;
    if (kind == winding) {
      angle = std::fmod(angle + speed, 16384 * 8);
      in.position = static_cast<std::int32_t>(std::lround(angle));
      if (random.one_in(9000)) in.reference = sign() * word(1 << 17);
      if (random.one_in(4000)) in.emf = sign() * word(1 << 16);
      if (out.valid) turn_on(out);
      return in;
    }
    in.reference = number(1 << 18);
    in.current_a = number(1 << 18);
    in.current_b = number(1 << 18);
    in.emf = number(1 << 17);
    in.position = static_cast<std::int32_t>(random.bits());
    in.gain = static_cast<std::uint32_t>(random.bits());
    // Multiples of an eighth of a turn, and others.
    in.offset = static_cast<std::uint32_t>(random.bits());
    if (random.coin()) {
      in.gain = 0;
      in.offset = (in.offset & 0xe0000000U) + static_cast<std::uint32_t>(random.between(-9, 9));
    }
    if (random.one_in(200)) in.polarity = !in.polarity;
    if (random.one_in(2000)) in.direct = !in.direct;
    if (kind != small) {
      in.proportional = random.coin() ? word(kMost) : word(9999);
      in.integral = random.coin() ? word(kMost) : kMost;
      in.limit = random.coin() ? word(kMost) : kMost;
    } else {
      in.limit = word(200);
    }
    return in;
  }

 private:
  void begin() {
    kind = static_cast<Kind>(random.below(kinds));
    every = random.one_in(4)   ? kBusy
            : random.one_in(4) ? 1
                               : static_cast<int>(random.between(200, 999));
    in.proportional = random.coin() ? 30'000 : word(kMost);
    in.integral = random.coin() ? 7400 : word(kMost);
    in.limit = word(kMost);
    in.gain = commutation_gain(11, 16384);
    in.polarity = random.coin();
    in.direct = random.one_in(4);
    open = random.coin() ? 3 : static_cast<int>(random.below(3));
    speed = static_cast<double>(random.between(-9, 9)) / 1000;
  }
  /// Windings that go a part of their way to what the voltage asks for; one may be open.
  void turn_on(const FieldOriented::Out& out) {
    const double scale = 0.06 * 1.7 * kOne / kPeriod;
    const Vector v = {scale * (2 * out.on_a - out.on_b - out.on_c) / 3.0,
                      scale * (out.on_b - out.on_c) / std::sqrt(3)};
    current = {0.94 * current.x + v.x, 0.94 * current.y + v.y};
    double phases[3];
    for (int n = 0; n < 3; ++n) phases[n] = current.turned(-n * kThirdOfTurn).x;
    if (open < 3) {
      const double rest = (phases[(open + 1) % 3] - phases[(open + 2) % 3]) / 2;
      phases[open] = static_cast<double>(random.between(-99, 99));
      phases[(open + 1) % 3] = rest;
      phases[(open + 2) % 3] = -rest;
    }
    in.current_a = static_cast<std::int32_t>(std::fmax(-262144, std::fmin(262143, phases[0])));
    in.current_b = static_cast<std::int32_t>(std::fmax(-262144, std::fmin(262143, phases[1])));
  }
  std::int32_t sign() { return random.coin() ? 1 : -1; }
  std::uint32_t word(std::int32_t most) {
    return static_cast<std::uint32_t>(random.below(static_cast<std::uint64_t>(most) + 1));
  }
  std::int32_t number(std::int32_t end) {
    if (kind == ends && !random.one_in(4)) return random.coin() ? end - 1 : -end;
    const std::int32_t below = kind == small ? 99 : end;
    return static_cast<std::int32_t>(random.between(-below, below - 1));
  }
};

/// The law in double, of vectors along the axis of torque (x) and a quarter turn ahead. `off_`
/// bounds how far the block may be from it, LSB.
class Reference {
 public:
  /// So near the limit that `saturated` is not judged.
  bool near() const { return near_; }

  const char* operator()(const FieldOriented::In& in, const Vfield_oriented& rtl,
                         const FieldOriented&, bool in_reset) {
    ++clock_;
    const double a = rtl.on_a_o, b = rtl.on_b_o, c = rtl.on_c_o;
    if (in_reset || !in.armed) {
      *this = Reference{};
      const bool none = 2 * a == kPeriod && a == b && a == c && !rtl.open_o && !rtl.saturated_o;
      return none && rtl.current_q_o == 0 && !rtl.valid_o ? nullptr : "disarmed there is nothing";
    }
    if (in.valid) take(in);
    const std::int64_t at = clock_ - taken_;
    if (at == 73) proportional_across_ = in.proportional;
    if (at == 92) proportional_ = in.proportional;
    if (at == 164) limit(in);
    if (at == 311) integral_across_ = in.integral;
    if (at == 330) integrate(in);
    if ((rtl.valid_o != 0) != (at == kLatency - 1)) return "a result 261 clocks after a current";
    if (at < 72 || taken_ < 0) return nullptr;
    if (std::fabs(static_cast<double>(sign_extend<21>(rtl.current_q_o)) - current_.x) >
        off_current_)
      return "the current along the axis of torque";
    return at == kLatency - 1 ? judge(a, b, c, rtl.saturated_o != 0) : nullptr;
  }

 private:
  void take(const FieldOriented::In& in) {
    if (clock_ < taken_ + kBusy) return;
    taken_ = clock_;
    taken_in_ = in;
    const std::int64_t product = std::int64_t{in.position} * std::int64_t{in.gain};
    const auto turn = static_cast<double>(product % (std::int64_t{1} << 32)) + in.offset;
    angle_ = std::ldexp(turn, -32) * 2 * M_PI;
    double b = in.current_b;
    if (in.polarity) b = -b - in.current_a;  // the motor's B is the leg C
    const Vector at_stator = {static_cast<double>(in.current_a),
                              (in.current_a + 2 * b) / std::sqrt(3)};
    current_ = at_stator.turned(-angle_);
    off_current_ = 2 + 6e-5 * current_.length();
    if (in.direct) integral_ = {}, off_integral_ = 0;
  }
  void limit(const FieldOriented::In& in) {
    const double across = taken_in_.direct ? 0 : proportional_across_ / 8192.0;
    const double along = taken_in_.direct ? 0 : proportional_ / 8192.0;
    wanted_ = {along * (taken_in_.reference - current_.x) + integral_.x + taken_in_.emf,
               -across * current_.y + integral_.y};
    // A part of the voltage is cut at 16 times the supply.
    const double end = 16 * kOne;
    wanted_.x = std::fmax(-end, std::fmin(end, wanted_.x));
    wanted_.y = std::fmax(-end, std::fmin(end, wanted_.y));
    off_ = 1.5 * larger(across, along) * off_current_ + off_integral_ + 3;
    // The CORDIC: an LSB in each of its 16 steps, and its angle.
    const double at_angle = off_ + 20 + 6e-5 * wanted_.length();
    const double most = in.limit, length = wanted_.length();
    limited_ = length > most;
    near_ = std::fabs(length - most) <= at_angle;
    const double part = limited_ ? most / length : 1;
    applied_ = {part * wanted_.x, part * wanted_.y};
    // A limit brings two vectors no farther apart; beyond it only the direction is left.
    off_applied_ = off_ + 20 + 6e-5 * applied_.length() + (limited_ ? 20 * part : 0);
  }
  void integrate(const FieldOriented::In& in) {
    const double along = taken_in_.direct ? 0 : std::ldexp(in.integral, -17);
    const double across = taken_in_.direct ? 0 : std::ldexp(integral_across_, -17);
    integral_.x += along * (applied_.x - taken_in_.emf - integral_.x);
    integral_.y += across * (applied_.y - integral_.y);
    off_integral_ = larger(off_integral_, off_applied_ + 2);
  }
  const char* judge(double a, double b, double c, bool saturated) {
    if (!near_ && saturated != limited_) return "saturated is limited";
    if (std::fmin(a, std::fmin(b, c)) < 0) return "no on-time is below 0";
    if (std::fmax(a, std::fmax(b, c)) > kPeriod) return "no on-time is above the period";
    const double outer = std::fmax(a, std::fmax(b, c)) + std::fmin(a, std::fmin(b, c));
    if (std::fabs(outer - kPeriod) > 1) return "the outer legs lie around the middle";
    if (taken_in_.polarity) std::swap(b, c);
    const Vector is = {(2 * a - b - c) / 3, (b - c) / std::sqrt(3)};
    const Vector at_rotor = applied_.turned(angle_);
    const double scale = kPeriod / std::sqrt(3) / kOne;
    const double x = is.x - scale * at_rotor.x, y = is.y - scale * at_rotor.y;
    const double bound = 0.75 + scale * (off_applied_ + 20 + 1e-4 * applied_.length());
    return std::hypot(x, y) <= bound ? nullptr : "the voltage is that of the law";
  }

  std::int64_t clock_ = 0, taken_ = -1000;
  FieldOriented::In taken_in_{};
  double angle_ = 0, off_ = 0, off_current_ = 0, off_integral_ = 0, off_applied_ = 0;
  std::uint32_t proportional_ = 0, proportional_across_ = 0, integral_across_ = 0;
  Vector current_{}, wanted_{}, applied_{}, integral_{};
  bool limited_ = false, near_ = false;
};

}  // namespace

TEST_CASE("field_oriented: all inputs, limits, arming and resets") {
  Bench bench("field_oriented", 1, FieldOriented(kPeriod));
  std::int64_t results = 0, limited = 0, near = 0;
  const auto watch = [&, reference = Reference{}](
                         const FieldOriented::In& in, const Vfield_oriented& rtl,
                         const FieldOriented& twin, bool in_reset) mutable {
    const char* broken = reference(in, rtl, twin, in_reset);
    results += rtl.valid_o;
    limited += rtl.valid_o != 0 && rtl.saturated_o != 0;
    near += rtl.valid_o != 0 && reference.near();
    return broken;
  };
  bench.run(RandomInputs{Random(1)}, scaled_clocks(6'000'000), {200'000}, watch);
  INFO("results " << results << ", limited " << limited << ", near the limit " << near);
  REQUIRE(limited > 3000);
  REQUIRE(results - limited > 1000);
  REQUIRE(near < results / 4);
}

TEST_CASE("field_oriented: the longest voltage at every angle stays within any period") {
  std::int64_t outside = 0, short_ones = 0;
  for (const int period : {4, 6, 24, 1000, 2500, 4094}) {
    FieldOriented twin(period);
    for (std::uint32_t turn = 0; turn < 3000; ++turn) {
      FieldOriented::In in;
      in.armed = in.direct = true;
      in.emf = turn % 2 == 0 ? kMost : -kMost;
      in.limit = static_cast<std::uint32_t>(kMost);
      in.offset = turn * 1431656U;
      for (int clock = 0; clock < kBusy; ++clock) {
        in.valid = clock == 0;
        twin.clock(in);
      }
      const double a = twin.out().on_a, b = twin.out().on_b, c = twin.out().on_c;
      outside += smaller(a, smaller(b, c)) < 0 || larger(a, larger(b, c)) > period;
      const double length = std::hypot((2 * a - b - c) / 3, (b - c) / std::sqrt(3));
      short_ones += length < period / std::sqrt(3) * (1 - 1e-4) - 0.75;
    }
  }
  CHECK(outside == 0);
  CHECK(short_ones == 0);
}
