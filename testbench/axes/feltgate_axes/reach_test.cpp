// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Axes: directed tests of limits and faults in each axis; random runs reach each only in some axis.
// Documentation: docs/architecture.md
#include "axes_life.hpp"

using namespace feltgate;
using namespace feltgate::test;
using D = Design;

namespace {

constexpr std::uint32_t kMost = 0x7fffffff;

/// Returns the limits that acted in the next `ticks` ticks.
unsigned met(Life& s, int n, int ticks) {
  unsigned limits = 0;
  for (; ticks > 0; --ticks) {
    s.ticks(1);
    limits |= s.out(n).limits;
  }
  return limits;
}
void check_met(Life& s, int n, unsigned limit, int ticks) {
  const unsigned limits = met(s, n, ticks);
  CAPTURE(n, limit, limits);
  CHECK((limits & limit) != 0);
}
void check_fault(Life& s, int n, Fault cause) {
  CAPTURE(n, s.out(n).faults);
  CHECK(s.out(n).first_fault == static_cast<unsigned>(cause));
  for (int m = 0; m < kAxes; ++m) {
    CHECK_FALSE(s.out(m).gates_enable);
    if (m != n) CHECK(s.out(m).first_fault == static_cast<unsigned>(Fault::axis));
  }
}

}  // namespace

TEST_CASE("axes: each comes to its own limits") {
  if (kEngine) return;  // arming takes longer: engine_test.cpp
  for (int n = 0; n < kAxes; ++n) {
    Life s;
    s.write(n, A::duty_limit, 1);
    s.write(n, A::hold_torque, 0);
    s.write(n, A::hold_time, 1);
    s.write(n, A::setpoint_torque, static_cast<std::uint32_t>(torque(0.05)));
    s.arm(D::S::setpoint);
    check_met(s, n, limit::duty, 4);
    check_met(s, n, limit::hold, 3 << Map::hold_unit_bits);
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, false);
    s.write(n, A::voltage_window, 0);
    s.write(n, A::current_limit, 1);
    s.arm(D::S::setpoint);
    const unsigned limits = met(s, n, 4);
    CAPTURE(n, limits);
    CHECK((limits & limit::voltage) != 0);
    CHECK((limits & limit::current) != 0);
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, false);
    s.ticks(2);
    s.play();
  }
}

TEST_CASE("axes: each has its own faults, and tells the others") {
  if (kEngine) return;  // arming takes longer: engine_test.cpp
  for (int n = 0; n < kAxes; ++n) {
    Life s;
    s.write(n, A::watchdog_ticks, 40);
    s.arm(D::S::setpoint);
    s.write(n, C::command, 1U << C::command_kick);
    s.ticks(60);
    check_fault(s, n, Fault::watchdog);

    s.write(n, A::watchdog_ticks, 0xffffff);
    s.write(n, A::overspeed, kMost);
    s.write(n, A::polarity_ticks, 20);
    s.write(n, A::polarity_speed, 1);
    s.write(n, A::polarity_current, 0);
    s.write(n, A::setpoint_torque, static_cast<std::uint32_t>(torque(0.05)));
    s.arm(D::S::setpoint);
    for (int gap = 2'000; gap > 100 && s.out(n).gates_enable; gap -= gap / 20) {
      s.turn(n, false);
      s.clocks(gap);
    }
    check_fault(s, n, Fault::polarity);

    s.write(n, A::polarity_speed, kMost);
    s.write_all(A::self_test_quiet, 1);
    s.arm(D::S::setpoint, 4);
    for (int k = 0; k < 64 << Map::self_test_unit_bits && s.out(n).gates_enable; ++k) {
      s.ticks(1);
      const bool pulse = s.twin().core(n).testing() && s.out(n).tau_ref != 0;
      if (pulse && k % 8 == 0) s.turn(n, s.out(n).tau_ref < 0);
    }
    check_fault(s, n, Fault::self_test);
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, false);
    s.write_all(C::command, 1U << C::command_clear_faults);
    for (int m = 0; m < kAxes; ++m) CHECK(s.out(m).faults == 0);
    s.play();
  }
}

TEST_CASE("axes: a law that is late is a fault of all whose scene it is") {
  if (kEngine) return;
  Life s;
  s.arm(D::S::law);
  s.in.law_late = true;
  s.ticks(2);
  for (int n = 0; n < kAxes; ++n) {
    CHECK(s.out(n).first_fault == static_cast<unsigned>(Fault::engine));
  }
  s.in.law_late = false;
  s.arm(D::S::law);
  s.play();
}
