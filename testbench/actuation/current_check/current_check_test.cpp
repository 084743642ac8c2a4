// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// current_check: RTL against twin, and against the law in double, in every clock; its words; and
// the twin beside current_control around the averaged winding of `lever`: which windings and steps
// it lets pass, and when a current that is not seen is missing. Documentation:
// docs/blocks/current.md
#include "feltgate/current_check.hpp"

#include <Vcurrent_check.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "figures_record.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr std::int32_t kMost = 131071;  // of the two words

struct Adapter {
  static void drive(Vcurrent_check& rtl, const CurrentCheck::In& in) {
    FELTGATE_DRIVE(rtl, in, armed, valid);
    rtl.resistive_i = port_bits<19, std::uint32_t>(in.resistive);
    rtl.across_i = port_bits<19, std::uint32_t>(in.across);
    rtl.current_i = port_bits<21, std::uint32_t>(in.current);
    rtl.resistance_i = static_cast<std::uint32_t>(in.resistance);
    rtl.margin_i = static_cast<std::uint32_t>(in.margin);
  }
  template <class Check>
  static void compare(Check& check, const Vcurrent_check& rtl, const CurrentCheck::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, missing);
  }
};

using Bench = LockStep<Vcurrent_check, CurrentCheck, Adapter>;

/// Kinds of inputs, each for a while: anything in each clock, the ends of all ranges, and voltages
/// at a multiple of the margin from what the current needs.
struct RandomInputs {
  Random random;
  CurrentCheck::In in{};
  enum Kind { anything, ends, near, kinds } kind = anything;
  int every = 19;

  CurrentCheck::In operator()(std::int64_t clock, const CurrentCheck::Out& out) {
    if (random.one_in(1500)) {
      kind = static_cast<Kind>(random.below(kinds));
      every = random.one_in(4) ? 1 : static_cast<int>(random.between(15, 40));
    }
    if (random.one_in(!in.armed ? 20 : out.missing ? 60 : 4000)) in.armed = !in.armed;
    in.valid = clock % every == 0;
    if (kind == near) {
      if (in.valid) close_by();
      return in;
    }
    in.resistive = number(1 << 18);
    in.across = random.coin() ? 0 : number(1 << 18);
    in.current = number(1 << 20);
    in.resistance = random.coin() ? word(kMost) : word(9000);
    in.margin = random.coin() ? kMost - word(9) : word(kMost);
    return in;
  }

 private:
  /// At a margin, rarely within it, so that there are rows of 16; or a voltage at four.
  void close_by() {
    in.margin = word(random.coin() ? 60'000 : kMost);
    in.resistance = 1 + word(9000);
    const auto most = std::fmin((1 << 20) - 1, 2.0 * 8192 * in.margin / in.resistance);
    in.current = number(1 + static_cast<std::int32_t>(most));
    const double needed = std::floor(std::ldexp(1.0 * in.current * in.resistance, -13));
    const bool at_far = random.one_in(12);
    const double times = at_far ? 4 : random.one_in(50) ? 0.5 : 1;
    const double beyond = at_far              ? static_cast<double>(random.between(-1, 1))
                          : random.one_in(40) ? 0
                          : times == 1        ? 1
                                              : -1;
    const double off = (random.coin() ? 1 : -1) * (times * in.margin + beyond);
    in.across = random.one_in(9) ? static_cast<std::int32_t>(bounded(off)) : 0;
    in.resistive =
        static_cast<std::int32_t>(bounded((at_far ? 0 : needed) + (in.across != 0 ? 0 : off)));
  }
  static double bounded(double value) { return std::fmax(-262144, std::fmin(262143, value)); }
  std::int32_t word(std::int32_t most) {
    return static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(most) + 1));
  }
  std::int32_t number(std::int32_t end) {
    if (kind == ends && !random.one_in(4)) return random.coin() ? end - 1 : -end;
    return static_cast<std::int32_t>(random.between(-end, end - 1));
  }
};

/// The law in double, in which each number here is exact.
class Reference {
 public:
  std::int64_t results = 0, astray = 0, by_patience = 0, at_once = 0;

  const char* operator()(const CurrentCheck::In& in, const Vcurrent_check& rtl, const CurrentCheck&,
                         bool in_reset) {
    ++clock_;
    if (in_reset || !in.armed) {
      row_ = 0;
      missing_ = false;
      taken_ = -100;
    } else if (in.valid) {
      take(in);
    }
    if (clock_ == taken_ + 18) judge(in.margin);
    return (rtl.missing_o != 0) == missing_ ? nullptr : "a current is missing by the law";
  }

 private:
  void take(const CurrentCheck::In& in) {
    if (clock_ < taken_ + 19) return;
    taken_ = clock_;
    resistive_ = in.resistive;
    across_ = std::fabs(in.across);
    apart_ = std::fabs(resistive_ - std::floor(std::ldexp(1.0 * in.current * in.resistance, -13)));
  }
  void judge(double margin) {
    const bool strays = larger(apart_, across_) > margin;
    const bool far = larger(std::fabs(resistive_), across_) > std::fmin(4 * margin, (1 << 18) - 1);
    row_ = strays ? row_ + 1 : 0;
    ++results;
    astray += strays;
    if (!missing_ && (row_ >= 16 || far)) ++(far ? at_once : by_patience);
    missing_ = missing_ || row_ >= 16 || far;
  }

  std::int64_t clock_ = 0, taken_ = -100;
  double resistive_ = 0, across_ = 0, apart_ = 0;
  int row_ = 0;
  bool missing_ = false;
};

constexpr double kOhm = 0.42, kHenry = 82e-6, kSupplyV = 24, kFullScaleA = 32, kPeriodS = 20e-6;
constexpr double kLimitA = 16.6, kLimitV = 0.95 * kSupplyV;

/// Controller and check around an averaged winding; a current is sampled in each period and its
/// voltage acts in the next one.
class Loop {
 public:
  Loop(double ohm, double henry) : ohm_(ohm), part_(-std::expm1(-ohm * kPeriodS / henry)) {
    const CurrentGains gains = current_gains(kOhm, kHenry, 2000, kPeriodS, kFullScaleA, kSupplyV);
    const CurrentCheckWords words = current_check_words(kOhm, kLimitA, kFullScaleA, kSupplyV);
    in_.armed = check_.armed = true;
    in_.proportional = gains.proportional;
    in_.integral = gains.integral;
    in_.limit = word(kLimitV / kSupplyV);
    check_.resistance = words.resistance;
    check_.margin = words.margin;
  }
  /// So many periods; `seen` is the part of the current that is measured. Returns the periods until
  /// a current is missing, or -1.
  int run(double reference_a, int periods, double seen = 1, double emf_v = 0) {
    in_.reference = word(reference_a / kFullScaleA);
    for (int period = 0; period < periods; ++period) {
      in_.current = word(seen * current_a / kFullScaleA);
      for (int clock = 0; clock < CurrentControl::kBusyClocks; ++clock) {
        in_.valid = check_.valid = clock == 0;
        check_.resistive = control_.out().resistive;
        check_.current = in_.current;
        control_.clock(in_);
        twin_.clock(check_);
      }
      current_a += part_ * ((applied_ - emf_v) / ohm_ - current_a);
      applied_ = kSupplyV * std::ldexp(control_.out().voltage, -17);
      most_a = larger(most_a, std::fabs(current_a));
      if (twin_.out().missing) return period + 1;
    }
    return -1;
  }
  double current_a = 0, most_a = 0;

 private:
  static std::int32_t word(double part) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(part, 17)));
  }
  CurrentControl control_;
  CurrentControl::In in_;
  CurrentCheck twin_;
  CurrentCheck::In check_;
  double ohm_, part_, applied_ = 0;
};

}  // namespace

TEST_CASE("current_check: all inputs, arming and resets") {
  Bench bench("current_check", 1);
  Reference seen;
  bench.run(RandomInputs{Random(1)}, scaled_clocks(3'000'000), {100'000}, std::ref(seen));
  REQUIRE(seen.astray > 1000);
  REQUIRE(seen.results - seen.astray > 1000);
  REQUIRE(seen.by_patience > 50);
  REQUIRE(seen.at_once > 50);
}

TEST_CASE("current_check: words of a winding") {
  const CurrentCheckWords lever = current_check_words(0.42, 16.6, 32, 24);
  CHECK(lever.in_range);
  CHECK(lever.resistance / 8192.0 == Approx(0.42 * 32 / 24).epsilon(2e-4));
  CHECK(lever.margin / 131072.0 == Approx(0.42 * 16.6 / 2 / 24).epsilon(1e-4));
  CHECK_FALSE(current_check_words(16, 1, 32, 24).in_range);
  CHECK_FALSE(current_check_words(1e-4, 0.5, 1, 24).in_range);
  // A motor whose supply cannot give twice its current: the margin's end, and it still compares.
  const CurrentCheckWords large = current_check_words(8, 8, 16, 24);
  CHECK(large.in_range);
  CHECK(large.margin == kMost);
}

TEST_CASE(
    "current_check: a winding that differs passes, steps and reversals of the largest current") {
  for (const double ohm : {0.8, 1.0, 1.2, 1.4}) {
    for (const double henry : {0.67, 1.0, 1.5}) {
      INFO("R times " << ohm << ", L times " << henry);
      Loop loop(ohm * kOhm, henry * kHenry);
      CHECK(loop.run(kLimitA, 300) == -1);
      CHECK(loop.run(-kLimitA, 300) == -1);
      CHECK(loop.run(kLimitA / 2, 300) == -1);
      CHECK(loop.run(kLimitA / 2, 300, 1, 2) == -1);  // a back-EMF that is not fed forward
    }
  }
}

TEST_CASE("current_check: a current that is measured as 0 or half: when it is missing") {
  std::string figures =
      "| asked for, A | measured: 0, ms | largest current, A | half of it, ms | largest, A "
      "|\n|---|---|---|---|---|\n";
  for (const double reference_a : {0.05, 0.5, 2.0, 8.0, 16.6}) {
    figures += fmt::format("| {:g} ", reference_a);
    for (const double seen : {0.0, 0.5}) {
      INFO("reference " << reference_a << " A, seen " << seen);
      Loop loop(kOhm, kHenry);
      const int periods = loop.run(reference_a, 20'000, seen);
      CHECK((periods > 0) == (seen == 0 || reference_a > kLimitA / 2));
      CHECK(loop.most_a < 2.2 * kLimitA);
      figures += periods < 0
                     ? fmt::format("| never | {:.1f} ", loop.most_a)
                     : fmt::format("| {:.2f} | {:.1f} ", 1e3 * kPeriodS * periods, loop.most_a);
    }
    figures += "|\n";
  }
  // Over all references, and what a factor passes for ever: 1 over the factor is the torque.
  figures +=
      "\n| resistance | largest current with wires off, of the limit | largest that passes with a "
      "wrong "
      "factor, of the limit | at most |\n|---|---|---|---|\n";
  for (const double ohm : {1.0, 0.9, 0.8}) {
    double off = 0, passes = 0;
    for (double reference_a = 0.2; reference_a <= kLimitA; reference_a += 0.2) {
      Loop loop(ohm * kOhm, kHenry);
      CHECK(loop.run(reference_a, 2000, 0) > 0);
      off = larger(off, loop.most_a / kLimitA);
    }
    for (double factor = 1; factor > 0.4; factor -= 0.01) {
      Loop loop(ohm * kOhm, kHenry);
      if (loop.run(kLimitA, 500, factor) < 0) passes = larger(passes, loop.current_a / kLimitA);
    }
    CHECK(off < 2.5);
    // At rest up to (1 + 1/2)/r; a step to it overshoots, and is missing earlier.
    CHECK(passes > 1.4);
    CHECK(passes < 1.5 / ohm + 0.01);
    figures += fmt::format("| {:g} of the design's | {:.2f} | {:.2f} | {:.2f} |\n", ohm, off,
                           passes, 1.5 / ohm);
  }
  check_figures("current_check", figures);
}
