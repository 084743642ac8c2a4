// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: the heat of the motor, cause 4.
// Documentation: docs/blocks/supervisor.md
#include <cmath>

#include "bench.hpp"
#include "catch.hpp"

using namespace feltgate::test;
using feltgate::Fault;

namespace {

constexpr int kTick = Design::clocks_per_tick;
constexpr std::int32_t kRadS = 1 << Design::f.velocity.fraction;
constexpr std::int32_t kVolt = 1 << Design::f.voltage.fraction;

/// Lets the heat of power-up go at once.
void cool(Script& s) {
  const std::uint32_t nominal = s.now.words.nominal_current_squared;
  s.now.words.nominal_current_squared = (1U << 31) - 1;
  s.ticks(2);
  s.now.words.nominal_current_squared = nominal;
}

/// RTL and twin side by side, reset when the test wants.
class Pair {
 public:
  Scenario now;

  void reset(int clocks) {
    for (int k = 0; k < clocks; ++k) {
      rtl_->rst_ni = 0;
      SupervisorAdapter::drive(*rtl_, {});
      twin_.reset();
      rtl_.clock();
      compare();
    }
    rtl_->rst_ni = 1;
    clock_.reset();
  }
  void ticks(std::int64_t n) {
    for (n *= kTick; n > 0; --n) {
      const auto in = bus_.clock(clock_.out(), now, twin_.out().current_estimate);
      clock_.clock({});
      SupervisorAdapter::drive(*rtl_, in);
      rtl_.clock();
      twin_.clock(in);
      compare();
    }
  }
  bool hot() const { return (rtl_->faults_o & fault_bit(Fault::i2t)) != 0; }

 private:
  void compare() {
    Check check;
    SupervisorAdapter::compare(check, *rtl_, twin_.out());
    REQUIRE(!check.failed());
  }

  feltgate::RtlModel<Vsupervisor> rtl_{5};
  Clock clock_;
  Bus bus_{1};
  Twin twin_;
};

}  // namespace

TEST_CASE("supervisor: power-up begins with half the heat, a reset forgets none") {
  constexpr std::uint32_t start = Design::i2t_start;
  Pair s;
  s.now.words.nominal_current_squared = 0;
  s.now.voltage = 5 * kVolt;
  const auto expect = [&](bool hot, double budget) {  // nothing cools, nothing heats
    s.now.words.i2t_budget = static_cast<std::uint32_t>(budget);
    s.reset(3);
    s.ticks(2);
    REQUIRE(s.hot() == hot);
  };
  expect(false, start + 1);
  expect(true, start);
  // Armed for a while: hotter by so many squares, and a reset of any length changes nothing.
  s.now.words.i2t_budget = 0xffffffffU;
  s.reset(3);
  s.now.arm = false;
  s.ticks(2);
  s.now.arm = true;
  s.ticks(101);  // of which one is the arming's
  s.now.arm = false;
  s.ticks(2);
  const double estimate = 5.0 / 0.42;
  const double heat = 101 * estimate * estimate * 4;
  expect(true, start + 0.98 * heat);
  expect(true, start + 0.98 * heat);
  expect(false, start + 1.02 * heat);
  // It decays as ever: a nominal square per tick.
  s.now.words.nominal_current_squared = start;
  s.now.words.i2t_budget = start;
  s.reset(1);
  s.ticks(3);
  s.now.words.nominal_current_squared = 0;
  expect(false, 0.02 * heat);
}

TEST_CASE("supervisor: I2t in integers, on the estimate of voltage and speed") {
  Script s;
  cool(s);
  s.now.words.nominal_current_squared = 100;
  s.now.voltage = 5 * kVolt;
  s.now.velocity = 40 * kRadS;
  s.ticks(2);
  const double current = (5.0 - 0.0302 * 40.0) / 0.42;
  REQUIRE(std::fabs(s.out().current_estimate / 256.0 - current) <= 2.0 / 256.0);
  const std::int64_t estimate = s.out().current_estimate;
  const std::int64_t square = estimate * estimate / (1 << 14);
  for (const int ticks : {1, 2, 3, 100}) {
    // The largest budget that so many armed ticks reach.
    s.now.words.i2t_budget = static_cast<std::uint32_t>(square + (ticks - 1) * (square - 100));
    s.arm();
    REQUIRE(s.clocks_to_fall(200 * kTick) == ticks * kTick + kHeat);
    s.now.words.nominal_current_squared = (1U << 31) - 1;  // cold at once, and never below
    s.ticks(4);
    s.now.words.nominal_current_squared = 100;
    s.clear().clear();
    REQUIRE(s.out().faults == 0);
  }
  s.play();
}

TEST_CASE("supervisor: the tick in which the gates fall still heats") {
  Script s;
  cool(s);
  s.now.words.nominal_current_squared = 0;
  s.now.voltage = 5 * kVolt;
  s.ticks(2);
  const std::int64_t estimate = s.out().current_estimate;
  s.now.words.i2t_budget = static_cast<std::uint32_t>(estimate * estimate / (1 << 14));
  s.arm();
  s.now.stop = true;  // before the square is taken
  s.ticks(1);
  REQUIRE(only(s, Fault::stop));
  s.ticks(1);
  REQUIRE(s.out().faults == (fault_bit(Fault::stop) | fault_bit(Fault::i2t)));
  s.play();
}

TEST_CASE("supervisor: the I2t sum does not wrap at the largest budget") {
  Script s;
  cool(s);
  s.now.words.nominal_current_squared = 0;
  s.now.words.i2t_budget = 0xffffffffU;
  s.now.words.inverse_resistance = 0x1ffff;
  s.now.voltage = 31 * kVolt;
  s.arm();
  s.ticks(2);
  const std::int64_t square =
      std::int64_t{s.out().current_estimate} * s.out().current_estimate / (1 << 14);
  const std::int64_t ticks = (0xffffffffLL + square - 1) / square;
  REQUIRE(s.clocks_to_fall(2 * ticks * kTick) > 0);
  REQUIRE(only(s, Fault::i2t));
  for (int k = 0; k < 10; ++k) {
    s.clear().ticks(1);
    REQUIRE(s.out().faults == fault_bit(Fault::i2t));
  }
  // Nothing was added in the tick of the fault: at most 8 ticks more, and it is below the budget.
  s.now.words.nominal_current_squared = static_cast<std::uint32_t>(square / 8 + 1);
  for (int k = 0; k < 5; ++k) s.clear();
  REQUIRE(s.out().faults == 0);
  s.play();
}

TEST_CASE("supervisor: I2t trips when the closed form says") {
  const double lsb = std::ldexp(1.0, -Design::f.current_estimate.fraction);
  for (const double volts : {3.0, 6.95, 12.0, -9.5}) {
    Script s;
    cool(s);
    s.now.voltage = static_cast<std::int32_t>(volts * kVolt);
    const double current = volts / 0.42;
    const double nominal = s.now.words.nominal_current_squared / 4.0;
    const double excess = current * current - nominal;
    const double budget = 3000.0 * excess + current * current;
    s.now.words.i2t_budget = static_cast<std::uint32_t>(budget * 4.0);
    s.arm();
    // The sum is I^2 after the first armed tick and is compared in the tick after.
    const std::int64_t clocks = s.clocks_to_fall(4000 * kTick);
    REQUIRE(only(s, Fault::i2t));
    REQUIRE((clocks - kHeat) % kTick == 0);
    const auto ticks = static_cast<double>((clocks - kHeat) / kTick);
    // I is one LSB off at most and I^2 loses up to a quarter more.
    const double error = (3 * lsb * std::fabs(current) + 0.25) / excess * 3000.0 + 2.0;
    REQUIRE(std::fabs(ticks - 3001.0) <= error);
    // The heat is not forgotten with the fault: it goes by the nominal square per tick.
    for (int k = 0; k < 100 && s.out().faults != 0; ++k) s.clear().ticks(1);
    s.arm();
    REQUIRE(s.clocks_to_fall(60 * kTick) > 0);
    REQUIRE(only(s, Fault::i2t));
    s.now.arm = false;
    s.now.words.nominal_current_squared = 1U << 18;
    s.ticks(static_cast<std::int64_t>(budget * 4.0 / (1 << 18)) + 2);
    s.clear().clear();
    REQUIRE(s.out().faults == 0);
    s.play();
  }
}
