// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: each cause of fault at its exact border, and what is latched.
// Documentation: docs/blocks/supervisor.md
#include <limits>

#include "bench.hpp"
#include "catch.hpp"

using namespace feltgate::test;
using feltgate::Fault;

TEST_CASE("supervisor: over-speed at the limit plus one bit, either way") {
  Script s;
  const auto limit = static_cast<std::int32_t>(s.now.words.overspeed);
  for (const std::int32_t bad : {limit + 1, -limit - 1, std::numeric_limits<std::int32_t>::max(),
                                 std::numeric_limits<std::int32_t>::min()}) {
    s.now.velocity = bad > 0 ? limit : -limit;
    s.arm().ticks(3);
    REQUIRE(s.out().armed);
    s.now.velocity = bad;
    REQUIRE(s.clocks_to_fall(kTick) == kSpeed);
    REQUIRE(only(s, Fault::speed));
    REQUIRE(s.out().armed);  // the wave still runs
    s.until(0);
    REQUIRE_FALSE(s.out().armed);
    s.clear().ticks(1);
    REQUIRE(s.out().faults == fault_bit(Fault::speed));  // the cause is still present
    s.now.velocity = 0;
    s.clear().clear();
    REQUIRE(s.out().faults == 0);
  }
  s.play();
}

TEST_CASE("supervisor: the host watchdog sleeps until the first kick and then counts exactly") {
  Script s;
  s.now.words.watchdog_ticks = 30;
  s.arm().ticks(200);
  REQUIRE(s.out().armed);  // never kicked
  const auto kick_after = [&s](int ticks) {
    s.ticks(ticks - 1);
    s.now.kick = true;
    s.ticks(1);
    s.now.kick = false;
  };
  for (int k = 0; k < 5; ++k) kick_after(30);
  REQUIRE(s.out().armed);
  REQUIRE(s.clocks_to_fall(100 * kTick) == 30 * kTick + kWatchdog);  // in the 31st tick
  REQUIRE(only(s, Fault::watchdog));
  s.clear().ticks(100);
  REQUIRE(s.out().faults == 0);  // only while armed
  s.arm();
  REQUIRE(s.clocks_to_fall(100 * kTick) == 30 * kTick + kWatchdog);
  s.clear();
  s.now.words.watchdog_ticks = 0;
  s.arm();
  REQUIRE(s.clocks_to_fall(100 * kTick) == kWatchdog);
  s.play();
}

TEST_CASE(
    "supervisor: a negative watchdog is silent at once, a negative nominal current cools nothing") {
  Script s;
  s.now.words.watchdog_ticks = 0x80000005U;
  s.now.kick = true;
  s.arm();
  s.now.kick = false;
  REQUIRE(s.clocks_to_fall(100 * kTick) == kWatchdog);
  REQUIRE(only(s, Fault::watchdog));
  s.now.words = Scenario::design_words();
  s.clear().clear();
  s.now.words.nominal_current_squared = 0x80000000U;
  s.ticks(3);  // nearly half the budget, as at power-up
  s.now.words.i2t_budget = Design::i2t_start / 2;
  s.ticks(2);
  REQUIRE(only(s, Fault::i2t));
  s.play();
}

TEST_CASE("supervisor: times beyond the counters are not shortened by their low bits") {
  Script s;
  s.now.words.watchdog_ticks = (1U << 24) + 3;
  s.now.words.polarity_ticks = (1U << 24) + 3;
  s.now.kick = true;
  s.ticks(1);
  s.now.kick = false;
  s.now.current_ref = -static_cast<std::int32_t>(s.now.words.polarity_current) - 1;
  s.arm();
  for (int k = 0; k < 50; ++k) {
    s.now.velocity += 10 * kRadS;
    s.ticks(1);
  }
  REQUIRE(s.out().armed);
  s.play();
}

TEST_CASE("supervisor: the external stop takes three clocks and stays") {
  for (int phase = 0; phase < kTick; ++phase) {
    Script s;
    s.arm().clocks(phase);
    s.now.stop = true;
    s.clocks(1);
    s.now.stop = false;
    REQUIRE(s.out().gates_enable);
    REQUIRE(s.clocks_to_fall(10) == 2);
    REQUIRE(only(s, Fault::stop));
    REQUIRE(only(s.ticks(2), Fault::stop));
    s.clear().arm();
    REQUIRE(s.out().armed);
    s.play();
  }
}

TEST_CASE(
    "supervisor: ticks that stand, low or high, trip with the period after those that must hold "
    "one") {
  constexpr int periods = (kTick + Design::pwm_period - 1) / Design::pwm_period;
  for (const bool high : {false, true}) {
    for (int phase = 0; phase < kTick; ++phase) {
      Script s;
      const auto period = [&s](int clocks) {  // starts a PWM period that lasts `clocks`
        s.now.period_start = true;
        s.clocks(1);
        s.now.period_start = false;
        s.clocks(clocks - 1);
      };
      s.arm().clocks(phase);
      for (int k = 0; k < 3; ++k) period(Design::pwm_period);
      for (int k = 0; k < 3; ++k) period(periods == 1 ? kTick : Design::pwm_period);
      REQUIRE(s.out().faults == 0);
      s.until(7);
      (high ? s.now.tick_stuck : s.now.ticks_stand) = true;
      s.clocks(2);
      for (int k = 0; k < periods; ++k) period(kTick + phase);
      REQUIRE(s.out().gates_enable);
      REQUIRE(s.out().faults == 0);
      period(1);
      REQUIRE_FALSE(s.out().gates_enable);
      REQUIRE(only(s, Fault::tick));
      s.play();
    }
  }
}

TEST_CASE("supervisor: the first cause stays, of two at once the lower number") {
  Script s;
  s.now.words.i2t_budget = 0;  // trips in every tick
  s.now.velocity = std::numeric_limits<std::int32_t>::max();
  s.ticks(1);
  REQUIRE(s.out().faults == (fault_bit(Fault::speed) | fault_bit(Fault::i2t)));
  REQUIRE(s.out().first_fault == static_cast<unsigned>(Fault::speed));
  s.errors(16);
  REQUIRE(s.out().faults ==
          (fault_bit(Fault::speed) | fault_bit(Fault::i2t) | fault_bit(Fault::encoder)));
  REQUIRE(s.out().first_fault == static_cast<unsigned>(Fault::speed));
  s.now.words.i2t_budget = 0xffffffffU;
  s.now.velocity = 0;
  s.clear().clear();
  REQUIRE(s.out().faults == 0);
  // The eighth encoder error arrives in the clock in which over-speed is detected.
  for (const bool too_fast : {false, true}) {
    s.arm().errors(7);
    s.now.velocity = too_fast ? std::numeric_limits<std::int32_t>::min() : 0;
    s.until(Twin::speed_clock);
    REQUIRE(s.out().gates_enable);
    s.errors(1);
    REQUIRE(s.out().faults ==
            (fault_bit(Fault::encoder) | (too_fast ? fault_bit(Fault::speed) : 0)));
    REQUIRE(s.out().first_fault == static_cast<unsigned>(Fault::encoder));
    s.now.velocity = 0;
    s.clear().clear();
    REQUIRE(s.out().faults == 0);
  }
  s.play();
}

TEST_CASE("supervisor: a cause of another block, in every clock of a tick and beside our own") {
  Script s;
  for (int clock = 0; clock < Design::clocks_per_tick; ++clock) {
    for (const Fault cause : {Fault::self_test, Fault::current}) {
      s.arm();
      REQUIRE(s.out().armed);
      s.until(clock);
      s.now.trips = static_cast<std::uint16_t>(fault_bit(cause));
      s.clocks(1);
      s.now.trips = 0;
      REQUIRE((!s.out().gates_enable && only(s, cause)));
      s.clear().clear();
      REQUIRE(s.out().faults == 0);
    }
  }
  s.arm();
  s.now.trips = static_cast<std::uint16_t>(fault_bit(Fault::word) | fault_bit(Fault::jump));
  s.clocks(1);
  s.now.trips = 0;
  REQUIRE(s.out().faults == (fault_bit(Fault::word) | fault_bit(Fault::jump)));
  REQUIRE(s.out().first_fault == static_cast<unsigned>(Fault::word));
  s.play();
}

TEST_CASE("supervisor: a cause in the clock of the clear is latched") {
  Script s;
  s.errors(8).errors(7);
  s.now.clear_faults = true;
  s.until(kTick - 1);
  REQUIRE(only(s, Fault::encoder));
  s.errors(1);
  REQUIRE(only(s, Fault::encoder));
  s.clocks(kTick);
  REQUIRE(s.out().faults == 0);
  s.play();
}
