// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Directed tests of faults: watchdog, I2t and wrong polarity trip at their time. Twin against
// expected values, RTL against twin. Documentation: docs/blocks/feltgate_core.md
#include "core_life.hpp"

using namespace feltgate::test;
using feltgate::Fault;
using feltgate::Map;
using D = feltgate::test::Design;

TEST_CASE("core: the watchdog is fed by a kick alone, and by one beside a clear") {
  constexpr int ticks = 40;
  for (const std::uint32_t others : {0u, 1u << C::command_clear_faults}) {
    Life s;
    s.write(A::watchdog_ticks, ticks);
    s.arm(D::S::free);
    s.ticks(3 * ticks);
    REQUIRE(s.out().gates_enable);  // the watchdog is off
    for (int k = 0; k < 4; ++k) {
      s.write(C::command, 1u << C::command_kick | others);
      s.ticks(ticks - 2);
    }
    REQUIRE(s.out().gates_enable);
    REQUIRE(s.ticks_to_fall(2 * ticks) <= 4);
    REQUIRE(s.only(Fault::watchdog));
    s.play();
  }
}

TEST_CASE("core: a jump of the speed trips once the estimate has come to the limit") {
  Life s;
  s.arm(D::S::free);
  int ticks = 0;
  for (; s.out().faults == 0 && ticks < 3000; ++ticks) {  // 2397 rad/s, a count every 32 clocks
    for (int at = 0; at < kTick; ++at) {
      if ((ticks * kTick + at) % 32 == 0) s.step(true);
      s.clocks(1);
    }
  }
  INFO(ticks << " ticks");
  CHECK(s.only(Fault::speed));
  // Its low-pass of 2 ms, up to 613.6 of the 1024 rad/s that it can show.
  CHECK(ticks > 1900);
  CHECK(ticks < 2000);
  s.play();
}

TEST_CASE("core: heat is that of the voltage less the back-EMF") {
  const auto design = [](int address) {
    for (const auto& p : D::parameters) {
      if (p.address == address) return std::ldexp(static_cast<double>(p.raw), -p.format.fraction);
    }
    return 0.0;
  };
  for (const int direction : {1, -1}) {
    Life s;
    s.write(A::overspeed, 0x7fffffff);
    s.write(A::polarity_speed, 0x7fffffff);
    s.write(A::nominal_current_squared, 0x7fffffff);
    s.write(A::voltage_window, (1u << (D::f.voltage.width() - 1)) - 1);
    s.write(A::voltage_setpoint, low(std::int64_t{6} << D::f.voltage.fraction));
    s.arm(D::S::free, Map::mode_voltage);
    s.move(direction * 1000, 2 * kTick);
    REQUIRE(s.out().gates_enable);
    // The sum is 0 until here; a tick adds the square of what voltage and velocity of the tick
    // before make.
    const auto current = [&](bool with_emf) {
      const double v = std::ldexp(s.shown().voltage, -D::f.voltage.fraction);
      const double w = std::ldexp(static_cast<double>(s.shown().velocity), -D::f.velocity.fraction);
      return v * design(A::inverse_resistance) -
             (with_emf ? w * design(A::emf_over_resistance) : 0.0);
    };
    const double budget = 150 * current(true) * current(true);
    REQUIRE(std::fabs(current(true) * current(true) / (current(false) * current(false)) - 1) > 0.2);
    s.write(A::i2t_budget, low(std::llround(4 * budget)));
    s.write(A::nominal_current_squared, 0);
    double sum = 0;
    int n = 0;
    while (s.out().gates_enable && n < 1'000) {
      if (n % 2 == 0) s.step(direction > 0);
      sum += current(true) * current(true);
      s.ticks(1);
      ++n;
    }
    INFO("direction " << direction << ", ticks " << n << ", sum " << sum << ", budget " << budget);
    REQUIRE(s.only(Fault::i2t));
    CHECK(n > 80);
    CHECK(std::fabs(sum / budget - 1) < 0.03);
    s.play();
  }
}

TEST_CASE("core: heat while the lever gathers speed is that of the velocity of each tick") {
  // Currents from 14 A to almost 0: a tick too early or too late would become many ticks at the
  // end.
  std::int64_t budget = 0xffffffff;
  for (const bool first : {true, false}) {
    Life s;
    s.write(A::overspeed, 0x7fffffff);
    s.write(A::polarity_speed, 0x7fffffff);
    s.write(A::nominal_current_squared, 0x7fffffff);
    s.write(A::voltage_setpoint, low(std::int64_t{6} << D::f.voltage.fraction));
    s.arm(D::S::free, Map::mode_voltage);
    s.ticks(4);
    s.write(A::i2t_budget, low(budget));
    s.write(A::nominal_current_squared, 0);
    const auto current = [&s] {
      const double v = std::ldexp(s.shown().voltage, -D::f.voltage.fraction);
      const double w = std::ldexp(static_cast<double>(s.shown().velocity), -D::f.velocity.fraction);
      return (v - 0.0302 * w) / 0.42;
    };
    double sum = 0;
    int n = 0;
    for (; s.out().gates_enable && (!first || current() > 2) && n < 2'000; ++n) {
      s.step(true);
      s.ticks(1);
      sum += current() * current();
    }
    INFO("ticks " << n << ", current " << current() << ", sum " << sum);
    REQUIRE(n < 2'000);
    if (first) {
      REQUIRE(s.out().gates_enable);
      budget = std::llround(4 * sum);
      continue;
    }
    REQUIRE(s.only(Fault::i2t));
    CHECK(std::fabs(current()) < 5);
    s.play();
  }
}

TEST_CASE(
    "core: a lever that gathers speed against the current trips, one that follows it does not") {
  for (const bool against : {false, true}) {
    Life s;
    s.write(A::overspeed, 0x7fffffff);
    s.write(A::polarity_ticks, 100);
    s.write(A::polarity_speed, low(std::int64_t{1} << D::f.velocity.fraction));
    s.write(A::voltage_setpoint, low(std::int64_t{6} << D::f.voltage.fraction));
    s.arm(D::S::free, Map::mode_voltage);
    s.ticks(10);
    REQUIRE(s.out().current_ref > static_cast<std::int32_t>(word_of_design(A::polarity_current)));
    for (int spacing = 2'000; spacing > 100 && s.out().gates_enable; spacing -= spacing / 40) {
      s.step(!against);
      s.clocks(spacing);
    }
    CAPTURE(against, s.out().first_fault, s.out().velocity);
    REQUIRE(s.out().gates_enable == !against);
    if (against) REQUIRE(s.only(Fault::polarity));
    s.play();
  }
}
