// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: the long tests. They are linked last, so that a shorter test finds a defect first.
// Documentation: docs/blocks/supervisor.md
#include <array>
#include <cmath>

#include "bench.hpp"
#include "catch.hpp"
#include "random_core.hpp"

using namespace feltgate::test;
using feltgate::Fault;

TEST_CASE("supervisor: eight encoder errors trip, one is forgiven every 1024 ticks") {
  Script s;
  s.arm();
  s.errors(7);
  s.clocks(20);
  REQUIRE(s.out().armed);
  s.errors(1);
  REQUIRE_FALSE(s.out().gates_enable);
  REQUIRE(only(s, Fault::encoder));
  s.clear().arm();
  s.errors(7);
  s.ticks(1024);
  s.errors(1);
  REQUIRE(s.out().gates_enable);
  s.errors(1);
  REQUIRE(only(s, Fault::encoder));
  s.clear();
  for (int k = 0; k < 30; ++k) {  // less than one error in 1024 ticks: never a fault
    s.errors(1);
    s.ticks(1030);
  }
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
    // After the first armed tick the sum is I^2; it is compared in the next tick.
    const std::int64_t clocks = s.clocks_to_fall(4000 * kTick);
    REQUIRE(only(s, Fault::i2t));
    REQUIRE((clocks - kHeat) % kTick == 0);
    const auto ticks = static_cast<double>((clocks - kHeat) / kTick);
    // I has an error of at most one LSB, and I^2 loses up to 0.25 more.
    const double error = (3 * lsb * std::fabs(current) + 0.25) / excess * 3000.0 + 2.0;
    REQUIRE(std::fabs(ticks - 3001.0) <= error);
    // Clearing the fault does not clear the heat: the heat falls by the nominal square per tick.
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

TEST_CASE("supervisor: a window beyond the counter has 65536 ticks", "[endurance]") {
  Script s;
  s.now.words.polarity_ticks = 0x7fffffff;
  s.now.current_ref = -10 * kAmpere;
  s.arm();
  s.now.velocity = 100 * kRadS;
  s.ticks(65536);
  s.now.velocity = 200 * kRadS;
  s.ticks(65535);
  REQUIRE(s.clocks_to_fall(2 * kTick) == kPolarity);
  REQUIRE(only(s, Fault::polarity));
  s.play();
}

TEST_CASE("supervisor: the I2t sum does not wrap at the largest budget", "[endurance]") {
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
  // The tick of the fault adds no heat: after at most 8 more ticks the heat is below the budget.
  s.now.words.nominal_current_squared = static_cast<std::uint32_t>(square / 8 + 1);
  for (int k = 0; k < 5; ++k) s.clear();
  REQUIRE(s.out().faults == 0);
  s.play();
}

TEST_CASE("supervisor: anything at any time, with and without resets") {
  std::array<std::int64_t, 16> trips{};
  std::int64_t armings = 0;
  for (std::uint64_t seed = 1; seed <= seeds_of(16); ++seed) {
    const ResetPlan plan{seed % 2 == 0 ? 20000U : 0U};
    SupervisorBench bench("supervisor", seed);
    Watch watch(&trips, &armings);
    bench.run(RandomCore(seed, plan), scaled_clocks(400000), plan, watch);
  }
  if (defects_run()) return;
  // Each cause was often enough the first cause while the motor was armed.
  for (std::size_t cause = 1; cause < trips.size(); ++cause) {
    CAPTURE(cause, trips[cause]);
    CHECK(trips[cause] >= (cause <= 6 || cause == 9 ? 16 : 2));
  }
  CHECK(armings >= 300);
}
