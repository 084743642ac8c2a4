// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Axes: RTL against twin, every output of each axis on every clock, and the properties between
// axes. AXES is the number of axes. Documentation: docs/architecture.md
#include "feltgate/feltgate_axes.hpp"

#include "axes_life.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using D = Design;

}  // namespace

TEST_CASE("axes: random levers, host and panel") {
  if (kEngine) return;  // arming takes longer: engine_test.cpp
  Tally tally;
  const auto lives = static_cast<std::uint64_t>(scaled_clocks(kAxes == 1 ? 1 : 2));
  for (std::uint64_t seed = 31; seed < 31 + lives; ++seed) {
    AxesBench bench("feltgate_axes", seed);
    bench.run(AxesStimulus<D, kAxes>(seed), 600'000, {}, Watch{&tally});
  }
  std::string met = "armed " + std::to_string(tally.armed) + " of " + std::to_string(tally.clocks);
  for (int n = 0; n < kAxes; ++n) {
    met += ", axis " + std::to_string(n) + ": own " + std::to_string(tally.own[n]) + " spread " +
           std::to_string(tally.spread[n]) + " test clocks " + std::to_string(tally.tests[n]);
  }
  INFO(met);
  CHECK(tally.armed > tally.clocks / 10);
  for (int n = 0; n < kAxes; ++n) {
    CHECK(tally.own[n] >= 2);
    if (kAxes > 1) CHECK(tally.spread[n] >= 1);
  }
}

TEST_CASE("axes: resets at random times") {
  AxesBench bench("feltgate_axes", 77);
  bench.run(AxesStimulus<D, kAxes>(77), 150'000, {15'000});
}

TEST_CASE("axes: each has its words at its own addresses, and nothing lies between") {
  Life s;
  for (int n = 0; n < kAxes; ++n) s.write(n, A::torque_limit, 1000u + static_cast<unsigned>(n));
  for (int n = 0; n < kAxes; ++n) {
    CHECK(s.read(n, A::torque_limit) == 1000u + static_cast<unsigned>(n));
    s.axis(n).encoder = {((n + 1) & 2) != 0, ((n + 1) & 1) != 0, false};
  }
  for (int n = 0; n < kAxes; ++n) {
    CHECK(s.read(n, 0x2ff) == 0);
    CHECK(s.read(n, C::snapshot + Map::R::tick) == s.out(n).tick_count - 1);
  }
  for (const int n : {kAxes, 4, 15, kEngine ? 20 : 16, 63}) {
    s.write(n, A::torque_limit, 7);
    CHECK(s.read(n, A::torque_limit) == 0);
  }
  CHECK(s.read(0, A::torque_limit) == 1000u);
  s.play();
}

TEST_CASE("axes: the port is busy with the write of the axis that is addressed") {
  Life s;
  s.to_clock(3);
  s.in.reg_addr = A::torque_limit;
  s.in.reg_wdata = 5;
  s.in.reg_write = true;
  s.clocks(1);
  s.in.reg_write = false;
  s.clocks(1);
  CHECK(s.twin().out().reg_busy);
  s.in.reg_addr = static_cast<std::uint16_t>(axes_stride + A::torque_limit);
  s.clocks(1);
  CHECK_FALSE(s.twin().out().reg_busy);
  s.in.reg_wdata = 6;
  s.in.reg_write = kAxes > 1;
  s.clocks(1);
  s.in.reg_write = false;
  s.ticks(1);
  CHECK(s.read(0, A::torque_limit) == 5);
  CHECK(s.read(1, A::torque_limit) == (kAxes > 1 ? 6u : 0u));
  s.play();
}

TEST_CASE("axes: armed when the last one asks, disarmed with the first that does not") {
  if (kEngine) return;  // arming takes longer: engine_test.cpp
  Life s;
  s.write_all(A::self_test_pulse, 0);
  for (int n = 0; n < kAxes; ++n) {
    for (int m = 0; m < kAxes; ++m) CHECK_FALSE(s.out(m).armed);
    s.control(n, D::S::setpoint, true);
    s.ticks(2);
  }
  for (int m = 0; m < kAxes; ++m) CHECK(s.out(m).armed);
  s.control(kAxes - 1, D::S::setpoint, false);
  for (int m = 0; m < kAxes; ++m) CHECK_FALSE(s.out(m).armed);
  s.play();
}

TEST_CASE("axes: a fault of any opens the gates of all, and each keeps its first cause") {
  if (kEngine) return;  // arming takes longer: engine_test.cpp
  for (int n = 0; n < kAxes; ++n) {
    Life s;
    s.arm(D::S::setpoint);
    s.write(n, C::command, 1u << C::command_stop);
    for (int m = 0; m < kAxes; ++m) {
      INFO("axis " << m << ", the stop is that of " << n);
      CHECK_FALSE(s.out(m).gates_enable);
      CHECK(s.out(m).first_fault == static_cast<unsigned>(m == n ? Fault::stop : Fault::axis));
      CHECK(s.out(m).faults == fault_bit(m == n ? Fault::stop : Fault::axis));
    }
    // No axis is armed before the faults of all axes are cleared.
    s.ticks(1);
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, false);
    for (int m = 0; m < kAxes; ++m) {
      if (m != n) s.write(m, C::command, 1u << C::command_clear_faults);
    }
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, true);
    s.ticks(1);
    for (int m = 0; m < kAxes; ++m) CHECK_FALSE(s.out(m).armed);
    s.arm(D::S::setpoint);
    s.play();
  }
}

TEST_CASE(
    "axes: none arms by the panel's old request, whichever the host gives the say back first") {
  if (kEngine) return;  // arming takes longer: engine_test.cpp
  constexpr std::uint32_t panel = kHost & ~(1u << C::control_host);
  for (int first = 0; first < kAxes; ++first) {
    for (const bool by_fault : {false, true}) {
      Life s;
      s.write_all(A::self_test_pulse, 0);
      s.in.arm = true;
      s.ticks(2);
      for (int n = 0; n < kAxes; ++n) REQUIRE(s.out(n).gates_enable);
      if (by_fault) {
        s.in.stop = true;
        s.ticks(1);
        s.in.stop = false;
      }
      for (int n = 0; n < kAxes; ++n) s.control(n, D::S::setpoint, false);
      s.write_all(C::command, 1u << C::command_clear_faults);
      for (int n = 0; n < kAxes; ++n) {
        s.write((first + n) % kAxes, C::control, panel);
        s.ticks(2);
      }
      for (int n = 0; n < kAxes; ++n) CHECK_FALSE(s.out(n).gates_enable);
      // No axis is armed if the host arms one axis and the panel controls the others.
      s.control(first, D::S::setpoint, false);
      s.control(first, D::S::setpoint, true);
      s.ticks(2);
      for (int n = 0; n < kAxes; ++n) CHECK(s.out(n).gates_enable == (kAxes == 1));
      s.play();
    }
  }
}

TEST_CASE("axes: a change of control of one disarms all, and each must ask anew") {
  if (kEngine) return;  // arming takes longer: engine_test.cpp
  for (int n = 0; n < kAxes; ++n) {
    Life s;
    s.arm(D::S::setpoint);
    s.in.arm = true;
    s.write(n, C::control, kHost & ~(1u << C::control_host));
    s.ticks(2);
    for (int m = 0; m < kAxes; ++m) CHECK_FALSE(s.out(m).gates_enable);
    s.in.arm = false;
    s.ticks(1);
    s.in.arm = true;
    s.ticks(2);
    for (int m = 0; m < kAxes; ++m) CHECK(s.out(m).gates_enable == (kAxes == 1));
    s.arm(D::S::setpoint);
    s.play();
  }
}

TEST_CASE("axes: own scene and polarity, programmed torque by axis, duties in one period") {
  if (kEngine) return;  // it has no program: engine_test.cpp
  Life s;
  s.arm(D::S::law);
  for (int n = 0; n < kAxes; ++n) s.axis(n).law_torque = torque(0.1 * (n + 1));
  s.ticks(3);
  for (int n = 0; n < kAxes; ++n) CHECK(s.out(n).tau_ref == torque(0.1 * (n + 1)));
  // The duties of one tick take effect in the same clock.
  std::int64_t changed[3] = {-1, -1, -1};
  for (int n = 0; n < kAxes; ++n) s.axis(n).law_torque = torque(-0.1 * (n + 1));
  for (std::int64_t c = 0; c < 3 * D::pwm_period; ++c) {
    s.clocks(1);
    for (int n = 0; n < kAxes; ++n) {
      if (changed[n] < 0 && s.out(n).duty_active < 0) changed[n] = c;
    }
  }
  for (int n = 0; n < kAxes; ++n) {
    CHECK(changed[n] > 0);
    CHECK(changed[n] == changed[0]);
  }
  s.play();
}

TEST_CASE("axes: self-tests in turn, the others at 0") {
  if (kEngine) return;  // it has no program: engine_test.cpp
  Life s;
  s.write_all(A::self_test_quiet, 1);
  s.arm(D::S::law, 2);
  for (int n = 0; n < kAxes; ++n) s.axis(n).law_torque = torque(0.2);
  int order[8] = {}, seen = 0;
  for (int tick = 0; tick < (kAxes + 1) * 8 << Map::self_test_unit_bits; ++tick) {
    s.ticks(1);
    bool testing = false;
    for (int n = 0; n < kAxes; ++n) testing = testing || s.twin().core(n).testing();
    if (!testing) break;
    for (int n = 0; n < kAxes; ++n) {
      if (s.out(n).tau_ref == 0) continue;
      REQUIRE(s.twin().core(n).testing());
      if (seen == 0 || order[seen - 1] != n) {
        REQUIRE(seen < 8);
        order[seen++] = n;
      }
    }
  }
  CHECK(seen == kAxes);
  for (int n = 0; n < seen; ++n) CHECK(order[n] == n);
  s.ticks(3);
  for (int n = 0; n < kAxes; ++n) CHECK(s.out(n).tau_ref == torque(0.2));
  s.play();
}
