// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// current_control: RTL against twin and against the textbook's PI with tracking in every clock; the
// integrator against the winding's equation; arming; gains; steps around the averaged winding of
// `lever`, beside other ways against wind-up. Documentation: docs/blocks/current.md
#include <Vcurrent_control.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "catch.hpp"
#include "feltgate/current_control.hpp"
#include "feltgate/largest.hpp"
#include "figures_record.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr std::int32_t kMost = 131071;  // of limit and gains

struct Adapter {
  static void drive(Vcurrent_control& rtl, const CurrentControl::In& in) {
    FELTGATE_DRIVE(rtl, in, armed, valid);
    rtl.reference_i = static_cast<std::uint32_t>(in.reference) & 0x7ffffU;
    rtl.current_i = static_cast<std::uint32_t>(in.current) & 0x7ffffU;
    rtl.emf_i = static_cast<std::uint32_t>(in.emf) & 0x3ffffU;
    rtl.proportional_i = static_cast<std::uint32_t>(in.proportional);
    rtl.integral_i = static_cast<std::uint32_t>(in.integral);
    rtl.limit_i = static_cast<std::uint32_t>(in.limit);
  }
  template <class Check>
  static void compare(Check& check, const Vcurrent_control& rtl, const CurrentControl::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, valid, saturated);
    check("voltage", sign_extend<18>(rtl.voltage_o), std::int64_t{out.voltage});
    check("resistive", sign_extend<19>(rtl.resistive_o), std::int64_t{out.resistive});
  }
};

using Bench = LockStep<Vcurrent_control, CurrentControl, Adapter>;

/// Kinds of inputs, each for a while: anything in each clock, the ends of all ranges, small
/// numbers, and a winding in the loop.
struct RandomInputs {
  Random random;
  CurrentControl::In in{};
  enum Kind { anything, ends, small, winding, kinds } kind = anything;
  int every = 39;
  double current = 0;

  CurrentControl::In operator()(std::int64_t clock, const CurrentControl::Out& out) {
    if (random.one_in(3000)) {
      kind = static_cast<Kind>(random.below(kinds));
      every = random.one_in(4) ? 1 : static_cast<int>(random.between(30, 300));
      in.proportional = random.coin() ? 11842 : word(kMost);
      in.integral = random.coin() ? 12762 : word(kMost);
      in.limit = word(kMost);
    }
    if (random.one_in(in.armed ? 5000 : 30)) in.armed = !in.armed;
    in.valid = clock % every == 0;
    if (kind == winding) {
      if (random.one_in(4000)) in.reference = sign() * word(1 << 17);
      if (random.one_in(2000)) in.emf = sign() * word(1 << 16);
      if (out.valid) current += 0.0975 * (1.7857 * (out.voltage - in.emf) - current);
      in.current = static_cast<std::int32_t>(std::fmax(-262144, std::fmin(262143, current)));
      return in;
    }
    in.reference = number(1 << 18);
    in.current = number(1 << 18);
    in.emf = number(1 << 17);
    if (kind == anything || kind == ends) {
      in.proportional = random.coin() ? word(kMost) : kMost;
      in.integral = random.coin() ? word(kMost) : kMost;
      in.limit = random.coin() ? word(kMost) : kMost;
    } else {
      in.limit = word(20);
      if (random.one_in(8)) in.proportional = 4096 * word(7);  // halves
    }
    return in;
  }

 private:
  std::int32_t sign() { return random.coin() ? 1 : -1; }
  std::int32_t word(std::int32_t most) {
    return static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(most) + 1));
  }
  std::int32_t number(std::int32_t end) {
    if (kind == ends && !random.one_in(4)) return random.coin() ? end - 1 : -end;
    const std::int32_t below = kind == small ? 8 : end;
    return static_cast<std::int32_t>(random.between(-below, below - 1));
  }
};

/// The block as in a textbook, in double, where each number here is exact: the integral adds its
/// gain times the proportional part and, for tracking, times what the limit takes.
class Reference {
 public:
  std::int64_t results = 0, up = 0, down = 0;

  const char* operator()(const CurrentControl::In& in, const Vcurrent_control& rtl,
                         const CurrentControl&, bool in_reset) {
    ++clock_;
    if (in_reset || !in.armed) {
      integral_ = voltage_ = 0;
      saturated_ = false;
      taken_ = -1000;
    }
    if (!in_reset && in.armed && in.valid) take(in);
    const bool result = clock_ == taken_ + 19;
    if (result) limit(in);
    if (clock_ == taken_ + 20) {
      integral_ += std::ldexp(in.integral, -17) * proportional_;
      integral_ += std::ldexp(in.integral, -17) * (voltage_ - unlimited_);
    }
    if ((rtl.valid_o != 0) != result) return "a result 20 clocks after a current";
    if (sign_extend<18>(rtl.voltage_o) != static_cast<std::int64_t>(voltage_)) {
      return "the voltage is that of the textbook";
    }
    return (rtl.saturated_o != 0) == saturated_ ? nullptr : "saturated is limited";
  }

 private:
  void take(const CurrentControl::In& in) {
    if (clock_ < taken_ + 39) return;
    taken_ = clock_;
    const double error = static_cast<double>(in.reference) - in.current;
    const double product = std::ldexp(error * in.proportional, -13);
    proportional_ = std::floor(product + 0.5);
    unlimited_ = proportional_ + std::floor(integral_) + in.emf;
  }
  void limit(const CurrentControl::In& in) {
    voltage_ = std::fmax(-in.limit, std::fmin(in.limit, unlimited_));
    saturated_ = voltage_ != unlimited_;
    ++results;
    up += voltage_ < unlimited_;
    down += voltage_ > unlimited_;
  }

  std::int64_t clock_ = 0, taken_ = -1000;
  double proportional_ = 0, unlimited_ = 0, integral_ = 0, voltage_ = 0;
  bool saturated_ = false;
};

/// One result of the twin.
std::int32_t result(CurrentControl& twin, CurrentControl::In in) {
  for (int clock = 0; clock < CurrentControl::kBusyClocks; ++clock) {
    in.valid = clock == 0;
    twin.clock(in);
  }
  return twin.out().voltage;
}

constexpr double kOhm = 0.42, kHenry = 82e-6, kSupplyV = 24, kFullScaleA = 32, kPeriodS = 20e-6;
constexpr double kHz = 2000, kLimitV = 0.95 * kSupplyV;

/// The block, in volts and amperes.
class Block {
 public:
  explicit Block(double bandwidth_hz) {
    const CurrentGains gains =
        current_gains(kOhm, kHenry, bandwidth_hz, kPeriodS, kFullScaleA, kSupplyV);
    in_.armed = true;
    in_.proportional = gains.proportional;
    in_.integral = gains.integral;
    in_.limit = word(kLimitV / kSupplyV);
  }
  double operator()(double reference_a, double current_a, double emf_v) {
    in_.reference = word(reference_a / kFullScaleA);
    in_.current = word(current_a / kFullScaleA);
    in_.emf = word(emf_v / kSupplyV);
    return kSupplyV * std::ldexp(result(twin_, in_), -17);
  }

 private:
  static std::int32_t word(double part) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(part, 17)));
  }
  CurrentControl twin_;
  CurrentControl::In in_;
};

/// The same gains in double, with other ways against wind-up.
struct Other {
  enum Way { none, frozen, back_calculated } way;
  double bandwidth_hz, integral = 0;
  double operator()(double reference_a, double current_a, double emf_v) {
    const double part = -std::expm1(-kOhm * kPeriodS / kHenry);
    const double proportional =
        2 * M_PI * bandwidth_hz * kPeriodS * kOhm / part * (reference_a - current_a);
    const double wanted = proportional + integral + emf_v;
    const double applied = std::fmax(-kLimitV, std::fmin(kLimitV, wanted));
    if (way == none || applied == wanted) {
      integral += part * proportional;
    } else if (way == back_calculated) {
      integral = applied - emf_v - proportional;
    }
    return applied;
  }
};

struct Step {
  double settled_ms = 0, overshoot = 0;  // 2 %, part of the step
};

/// A current is sampled in the middle of each period; its voltage acts from the next one's start.
template <class Control>
Step step(Control control, double amperes, double emf_v, double ohm = kOhm, double henry = kHenry) {
  constexpr int kSteps = 200;  // in half a period
  const double part = -std::expm1(-ohm / henry * kPeriodS / 2 / kSteps);
  Step found;
  double current = 0, applied = emf_v;
  for (int period = 0; period < 100; ++period) {
    const double next = control(amperes, current, emf_v);
    for (int k = 0; k < 2 * kSteps; ++k) {
      if (k == kSteps) applied = next;
      current += part * ((applied - emf_v) / ohm - current);
      const double now_ms = 1e3 * kPeriodS * (period + (k + 1.0) / (2 * kSteps));
      if (std::fabs(current - amperes) > 0.02 * amperes) found.settled_ms = now_ms;
      found.overshoot = larger(found.overshoot, current / amperes - 1);
    }
  }
  CHECK(std::fabs(current - amperes) < 0.001);
  return found;
}

}  // namespace

TEST_CASE("current_control: all inputs, limits, arming and resets") {
  Bench bench("current_control", 1);
  Reference seen;
  bench.run(RandomInputs{Random(1)}, scaled_clocks(1'500'000), {100'000}, std::ref(seen));
  REQUIRE(seen.up > 1000);
  REQUIRE(seen.down > 1000);
  REQUIRE(seen.results - seen.up - seen.down > 1000);
}

TEST_CASE("current_control: the integrator is the voltage at the winding's resistance") {
  // Any currents, limits and back-EMFs: a winding that has this gain for its pole and gets what is
  // applied. The integrator is above it by what its floor leaves, an LSB of the voltage at most.
  Random random(2);
  std::int64_t limited = 0, wrong = 0;
  for (int run = 0; run < 50; ++run) {
    CurrentControl twin;
    CurrentControl::In in;
    in.armed = true;
    in.integral = static_cast<std::int32_t>(random.between(1, kMost));
    in.proportional = static_cast<std::int32_t>(random.between(0, kMost));
    double resistive = 0;  // volts of the winding, LSB
    for (int k = 0; k < 400; ++k) {
      if (random.one_in(20))
        in.reference = static_cast<std::int32_t>(random.between(-262144, 262143));
      in.current = static_cast<std::int32_t>(random.between(-100'000, 100'000));
      in.emf = static_cast<std::int32_t>(random.between(-131072, 131071));
      in.limit = static_cast<std::int32_t>(random.between(0, kMost));
      const std::int32_t applied = result(twin, in);
      resistive += std::ldexp(in.integral, -17) * (applied - in.emf - resistive);
      const double above = std::ldexp(static_cast<double>(twin.integrator()), -17) - resistive;
      wrong += !(above > -1e-6 && above < 1 + 1e-6);
      limited += twin.out().saturated;
    }
  }
  CHECK(wrong == 0);
  CHECK(limited > 1000);
  CHECK(limited < 19'000);
}

TEST_CASE("current_control: arming a moving motor and other gains make no jump") {
  const CurrentGains gains = current_gains(kOhm, kHenry, kHz, kPeriodS, kFullScaleA, kSupplyV);
  CurrentControl twin;
  CurrentControl::In in;
  in.armed = true;
  in.emf = 60'000;
  in.limit = 124'518;
  in.proportional = gains.proportional;
  in.integral = gains.integral;
  CHECK(result(twin, in) == in.emf);  // no current yet: the back-EMF alone
  in.reference = 40'000;
  double current = 0;
  for (int k = 0; k < 200; ++k) {
    in.current = static_cast<std::int32_t>(std::lround(current));
    current += 0.0975 * (24 / 0.42 / 32 * (result(twin, in) - in.emf) - current);
  }
  CHECK(std::fabs(current - in.reference) < 1);
  in.current = in.reference;
  const std::int32_t before = result(twin, in);
  in.proportional *= 4;
  in.integral /= 2;
  CHECK(result(twin, in) == before);
  in.armed = false;
  twin.clock(in);
  CHECK(twin.out().voltage == 0);
  CHECK(twin.integrator() == 0);
}

TEST_CASE("current_control: gains are those of the winding") {
  const CurrentGains lever = current_gains(0.42, 82e-6, 2000, 20e-6, 32, 24);
  CHECK(lever.in_range);
  // With results far more often than the winding's time: 2 pi f L, and its share of R/L.
  const CurrentGains often = current_gains(0.42, 82e-6, 2000, 1e-6, 32, 24);
  CHECK(often.proportional ==
        Approx(8192 * 2 * 3.14159265 * 2000 * 82e-6 * 32 / 24).epsilon(0.003));
  CHECK(often.integral == Approx(131072 * 0.42 / 82e-6 * 1e-6).epsilon(0.003));
  // The pole that is left: in one sample the error falls by 2 pi f T.
  const double volts_per_ampere = lever.proportional / 8192.0 * 24 / 32;
  const double gone = lever.integral / 131072.0;
  CHECK(volts_per_ampere * gone / 0.42 == Approx(2 * 3.14159265 * 2000 * 20e-6).epsilon(1e-4));
  CHECK(gone == Approx(1 - std::exp(-0.42 * 20e-6 / 82e-6)).epsilon(1e-4));
  CHECK_FALSE(current_gains(0.42, 82e-6, 50'000, 20e-6, 32, 24).in_range);
  CHECK_FALSE(current_gains(1e-6, 82e-3, 2, 20e-6, 32, 24).in_range);
  CHECK_FALSE(current_gains(42, 1e-6, 2000, 20e-6, 32, 24).in_range);
}

TEST_CASE("current_control: steps of the averaged winding") {
  std::string figures =
      "| winding | 2 % after a step of 1 A, ms | of 16.6 A | overshoot |\n|---|---|---|---|\n";
  const struct {
    const char* name;
    double ohm, henry;
  } windings[] = {
      {"as the gains have it", 1, 1}, {"R -20 %", 0.8, 1}, {"R +20 %", 1.2, 1},
      {"L -33 %", 1, 0.67},           {"L +50 %", 1, 1.5}, {"R -20 %, L +50 %", 0.8, 1.5}};
  for (const auto& [name, ohm, henry] : windings) {
    const Step small = step(Block(kHz), 1, 0, ohm * kOhm, henry * kHenry);
    const Step large = step(Block(kHz), 16.6, 0, ohm * kOhm, henry * kHenry);
    CHECK(large.overshoot < 0.1);
    CHECK(small.settled_ms < 0.75);
    if (ohm == 1 && henry == 1) {
      CHECK(small.settled_ms <= 0.35);
      CHECK(large.settled_ms <= 0.35);
      CHECK(large.overshoot < 0.001);
    }
    figures += fmt::format("| {} | {:.3f} | {:.3f} | {:.1f} % |\n", name, small.settled_ms,
                           large.settled_ms, 100 * large.overshoot);
  }
  figures +=
      "\n| limited, 2 % and overshoot | 30 A at rest | 16.6 A at 12 V of back-EMF | the same, 5 "
      "kHz "
      "|\n|---|---|---|---|\n";
  const auto row = [&figures](const char* name, const auto& control) {
    const Step cases[] = {step(control(kHz), 30, 0), step(control(kHz), 16.6, 12),
                          step(control(5000), 16.6, 12)};
    figures += fmt::format("| {} ", name);
    for (const Step& one : cases) {
      figures += fmt::format("| {:.3f} ms, {:.1f} % ", one.settled_ms, 100 * one.overshoot);
    }
    figures += "|\n";
    return cases[0].settled_ms;
  };
  const double here = row("this block", [](double hz) { return Block(hz); });
  for (const auto& [name, way] :
       {std::pair("integrator frozen while limited", Other::frozen),
        std::pair("integrator set to what the limit leaves", Other::back_calculated),
        std::pair("nothing", Other::none)}) {
    CHECK(here < 0.7 * row(
                           name,
                           [way = way](double hz) {
                             return Other{way, hz};
                           }));
  }
  check_figures("current_control", figures);
}
