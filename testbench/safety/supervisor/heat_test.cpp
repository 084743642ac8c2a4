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

/// RTL and twin side by side; the test chooses when to reset them.
class Pair {
 public:
  Scenario now;

  void reset(int clocks) {
    for (int k = 0; k < clocks; ++k) {
      rtl_->rst_ni = 0;
      SupervisorAdapter::drive(*rtl_, {});
      twin_.reset();
      rtl_.clock();
      compare({});
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
      compare(in);
    }
  }
  bool hot() const { return (rtl_->faults_o & fault_bit(Fault::i2t)) != 0; }

 private:
  void compare(const Twin::In& in) {
    Check check;
    SupervisorAdapter::compare(check, *rtl_, twin_.peek(in));
    REQUIRE(!check.failed());
  }

  feltgate::RtlModel<Vsupervisor> rtl_{5};
  Clock clock_;
  Bus bus_{1};
  WholeTwin twin_;
};

}  // namespace

TEST_CASE("supervisor: power-up begins with half the heat, a reset forgets none") {
  constexpr std::uint32_t start = Design::i2t_start;
  Pair s;
  s.now.words.nominal_current_squared = 0;
  s.now.voltage = 5 * kVolt;
  const auto expect = [&](bool hot, double budget) {  // the heat stays constant
    s.now.words.i2t_budget = static_cast<std::uint32_t>(budget);
    s.reset(3);
    s.ticks(2);
    REQUIRE(s.hot() == hot);
  };
  expect(false, start + 1);
  expect(true, start);
  // Armed ticks add one square each. A reset of any length does not change the heat.
  s.now.words.i2t_budget = 0xffffffffU;
  s.reset(3);
  s.now.arm = false;
  s.ticks(2);
  s.now.arm = true;
  s.ticks(101);  // the first of them is the tick of arming
  s.now.arm = false;
  s.ticks(2);
  const double estimate = 5.0 / 0.42;
  const double heat = 101 * estimate * estimate * 4;
  expect(true, start + 0.98 * heat);
  expect(true, start + 0.98 * heat);
  expect(false, start + 1.02 * heat);
  // The heat falls as before: one nominal square per tick.
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
    // The largest budget that the heat reaches in `ticks` armed ticks.
    s.now.words.i2t_budget = static_cast<std::uint32_t>(square + (ticks - 1) * (square - 100));
    s.arm();
    REQUIRE(s.clocks_to_fall(200 * kTick) == ticks * kTick + kHeat);
    s.now.words.nominal_current_squared = (1U << 31) - 1;  // the heat falls to 0 at once, not below
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
