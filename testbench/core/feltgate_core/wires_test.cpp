// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_core: signals between its blocks that random runs hardly change; each test makes one
// visible at an output; and the torque of programs. Documentation: docs/architecture.md
#include <algorithm>

#include "core_life.hpp"

using namespace feltgate::test;
using feltgate::Fault;
using feltgate::Map;
using D = feltgate::test::Design;

namespace {

constexpr int kSampled = Map::first_wave_clock + Map::T::law_torque;

std::int32_t torque(double nm) {
  return static_cast<std::int32_t>(nm * (1 << D::f.torque.fraction));
}

}  // namespace

TEST_CASE("axis: none is armed before all ask and may be; all are disarmed with one") {
  Life s;
  s.write(A::self_test_pulse, 0);
  s.in.axis_silent = true;
  s.write(C::control, kHost | 1u << C::control_arm);
  s.ticks(3);
  CHECK_FALSE(s.out().armed);
  s.in.axis_silent = false;  // the last axis requests arming
  s.ticks(1);
  CHECK(s.out().armed);
  s.in.axis_silent = true;
  s.ticks(1);
  CHECK_FALSE(s.out().armed);
  s.in.axis_blocked = true;
  s.in.axis_silent = false;
  s.ticks(3);
  CHECK_FALSE(s.out().armed);
  s.in.axis_blocked = false;  // a refused request must fall first
  s.ticks(3);
  CHECK_FALSE(s.out().armed);
  s.in.axis_silent = true;  // its own, not that of the other axis
  s.ticks(1);
  s.in.axis_silent = false;
  s.ticks(1);
  CHECK_FALSE(s.out().armed);
  s.write(C::control, kHost);
  s.write(C::control, kHost | 1u << C::control_arm);
  s.ticks(1);
  CHECK(s.out().armed);
  s.in.axis_blocked = true;  // once armed, this input has no effect
  s.ticks(3);
  CHECK(s.out().armed);
  s.play();
}

TEST_CASE("axis: a fault of another one disarms in every scene") {
  Life s;
  s.arm(D::S::setpoint);
  s.in.axis_fault = true;
  s.ticks(1);
  CHECK_FALSE(s.out().armed);
  CHECK(s.only(Fault::axis));
  s.play();
}

TEST_CASE("axis: its own test waits for that of another axis") {
  Life s;
  s.write(A::self_test_quiet, 1);
  s.write(A::self_test_pulse, 1);
  s.ticks(2);
  s.in.axis_waits = true;
  s.write(C::control, kHost | 1u << C::control_arm);
  constexpr std::int64_t unit = std::int64_t{1} << Map::self_test_unit_bits;
  s.ticks(4 * unit);
  CHECK(s.out().armed);
  CHECK(s.shown().tau_ref == 0);
  s.in.axis_waits = false;
  std::int64_t ticks = 0;
  while (s.shown().tau_ref == 0 && ticks < 4 * unit) s.ticks(1), ++ticks;
  CHECK(s.shown().tau_ref == static_cast<std::int32_t>(word_of_design(A::self_test_torque)));
  s.play();
}

TEST_CASE("core: a stop that is written is a fault, and the first one") {
  Life s;
  s.arm(D::S::setpoint);
  s.to_clock(5);
  s.in.reg_addr = C::command;
  s.in.reg_wdata = 1u << C::command_stop;
  s.in.reg_write = true;
  s.clocks(1);
  s.in.reg_write = false;
  s.clocks(2);
  CHECK_FALSE(s.out().gates_enable);
  CHECK(s.only(Fault::stop));
  s.ticks(2);
  s.play();
}

TEST_CASE("core: a pulse of the self-test has all bits of its torque") {
  for (const std::uint32_t torque : {0x1555u, 0x0aaau}) {
    Life s;
    s.write(A::self_test_quiet, 1);
    s.write(A::self_test_pulse, 1);
    s.write(A::self_test_torque, torque);
    s.ticks(2);
    s.write(C::control, kHost | 1u << C::control_arm);
    bool whole = false;
    for (int tick = 0; tick < 8 << Map::self_test_unit_bits; ++tick) {
      s.ticks(1);
      whole = whole || s.shown().tau_ref == static_cast<std::int32_t>(torque);
    }
    CHECK(whole);
    s.play();
  }
}

TEST_CASE("core: the torque's limit is obeyed in a pulse of the self-test and in a held torque") {
  Life s;
  const auto limit_is = [&s](std::int32_t most, int ticks) {
    std::int32_t seen = 0;
    for (int tick = 0; tick < ticks; ++tick) {
      s.ticks(1);
      seen = std::max(seen, std::abs(s.shown().tau_ref));
    }
    CHECK(seen == most);
  };
  const int unit = 1 << Map::self_test_unit_bits;
  s.write(A::self_test_quiet, 1);
  s.write(A::self_test_pulse, 1);
  s.write(A::torque_limit, 655);
  s.write(A::hold_time, 0xffffffff);
  s.write(A::hold_limit, 300);
  s.write(A::hold_torque, 200);
  s.write(A::ramp_step, 1u << 24);
  s.write(A::setpoint_torque, 17u << D::f.torque.fraction);  // too large: +, and not -
  s.ticks(2);
  s.write(C::control, kHost | 1u << C::control_arm | D::S::setpoint << C::control_scene);
  limit_is(655, 8 * unit);
  CHECK(s.shown().tau_ref == 300);  // held for too long
  CHECK(((s.shown().limits >> Map::L::hold) & 1u) == 1);
  s.write(A::torque_limit, 100);
  s.ticks(3);
  CHECK(s.shown().tau_ref == 100);
  s.write(A::torque_limit, 0x80008000);
  s.ticks(3);
  CHECK(s.shown().tau_ref == 0);
  s.play();
}

TEST_CASE("core: no gate gets a pulse that is shorter than 0.2 us") {
  Life s;
  s.arm(D::S::free, 2);
  int on[4] = {}, shortest = D::pwm_period;
  for (int duty = -40; duty <= 40; ++duty) {
    const double volts = duty * D::supply_v / D::pwm_period;
    s.write(A::voltage_setpoint,
            static_cast<std::uint32_t>(std::lround(std::ldexp(volts, D::f.voltage.fraction))));
    for (int clock = 0; clock < 2 * D::pwm_period; ++clock) {
      s.clocks(1);
      for (int gate = 0; gate < 4; ++gate) {
        const bool now = ((s.out().gates >> gate) & 1) != 0;
        if (!now && on[gate] > 0) shortest = std::min(shortest, on[gate]);
        on[gate] = now ? on[gate] + 1 : 0;
      }
    }
  }
  CHECK(s.out().gates_enable);
  CHECK(shortest >= 0.2e-6 * D::clock_hz);
  CHECK(shortest < 0.3e-6 * D::clock_hz);
  s.play();
}

TEST_CASE("core: what an engine says is no matter outside of the scene of programs") {
  Life s;
  s.write(A::setpoint_torque, 3000);
  s.arm(D::S::setpoint);
  s.in.law_late = s.in.law_restart = true;
  s.write(A::ramp_step, 1u << 20);
  for (const std::int32_t torque : {0x15555, -0x15556}) {
    s.in.law_torque = torque;
    s.write(A::setpoint_torque, static_cast<std::uint32_t>(-torque / 64));
    s.ticks(40);
    CHECK(s.out().armed);
    CHECK(s.shown().tau_ref == -torque / 64);
  }
  s.play();
}

TEST_CASE("law: the torque of the port in its clock is the tick's, limited") {
  if (!kPrograms) return;
  Life s;
  s.arm(Map::S::law);
  s.ticks(2);
  // The input matters only in its clock; before and after it may have any value.
  for (const double nm : {0.1, -0.2, 0.0, 0.3}) {
    s.to_clock(kSampled);
    s.in.law_torque = torque(nm);
    s.clocks(1);
    s.in.law_torque = torque(0.4);
    s.to_clock(0);
    CHECK(s.shown().tau_ref == torque(nm));
  }
  s.in.law_torque = torque(3.0);
  s.ticks(1);
  CHECK(s.shown().tau_ref == static_cast<std::int32_t>(word_of_design(A::torque_limit)));
  CHECK((s.shown().limits >> Map::L::torque & 1u) == 1);
  // Another scene ignores the input, and when disarmed the torque is 0.
  s.write(C::control, kHost | 1u << C::control_arm);
  s.ticks(400);
  CHECK(s.shown().tau_ref == 0);
  s.disarm();
  s.ticks(400);
  CHECK(s.shown().tau_ref == 0);
  s.play();
}

TEST_CASE("law: a late engine is a fault in the scene of programs alone, and no torque") {
  if (!kPrograms) return;
  Life s;
  s.in.law_torque = torque(0.2);
  s.arm(D::S::setpoint);
  s.in.law_late = true;
  s.ticks(3);
  CHECK(s.out().gates_enable);
  s.disarm();
  s.in.law_late = false;
  s.arm(Map::S::law);
  s.ticks(3);
  CHECK(s.shown().tau_ref == torque(0.2));
  s.to_clock(kSampled - 1);
  s.in.law_late = true;
  s.clocks(1);
  CHECK_FALSE(s.out().gates_enable);
  CHECK(s.only(Fault::engine));
  s.to_clock(0);
  CHECK(s.shown().tau_ref == 0);
  CHECK_FALSE(s.out().armed);
  s.play();
}

TEST_CASE("core: a thousand wrong edges are counted up to the port") {
  Life s;
  s.arm(D::S::free);
  s.ticks(1);
  for (int k = 0; k < 1100; ++k) {
    s.in.encoder.a = !s.in.encoder.a;
    s.in.encoder.b = !s.in.encoder.b;
    s.clocks(3 + k % 3);
  }
  s.ticks(2);
  CHECK((s.read(C::snapshot + Map::R::encoder) & 0xffff) == 1100);
  s.play();
}

TEST_CASE("core: a torque is held for the time that the word says, not for less") {
  Life s;
  s.write(A::hold_time, 8);
  s.write(A::hold_torque, 100);
  s.write(A::setpoint_torque, 3000);
  s.arm(D::S::setpoint);
  s.ticks(std::int64_t{3} << Map::hold_unit_bits);
  CHECK(s.shown().tau_ref == 3000);
  s.play();
}

TEST_CASE("core: factors that are powers of two, whose products end in ties") {
  if ((D::scene_mask >> D::S::spring_tension & 1u) == 0) return;  // a design without springs
  int pushed = 0;
  for (int bit = 0; bit < D::coefficient_bits; ++bit) {
    Life s;
    s.write(A::tension_stiffness, 1u << bit);
    s.write(A::velocity_a1, 1u << bit);
    s.arm(D::S::spring_tension);
    s.move(9, kTick);
    s.move(-22, kTick);
    s.ticks(3);
    pushed += s.shown().tau_ref != 0 ? 1 : 0;
    s.play();
  }
  CHECK(pushed > 5);
}

TEST_CASE("core: a factor beyond its format is the largest that there is, and none is negative") {
  constexpr std::uint32_t most = (1u << D::coefficient_bits) - 1;
  const auto lives = [](int address, std::uint32_t word) {
    Life s;
    s.write(address, word);
    s.write(A::setpoint_torque, 3000);
    s.arm(D::S::setpoint);
    s.move(40, kTick);
    s.ticks(30);
    CHECK(s.out().armed);
    s.play();
    return s.shown();
  };
  for (const int address : {A::velocity_a1, A::observer_a1, A::voltage_gain, A::torque_gain}) {
    for (const std::uint32_t fits : {most, 0u}) {
      const feltgate::CoreOut with = lives(address, fits != 0 ? most + 1 : 0x80000001),
                              without = lives(address, fits);
      CHECK(with.velocity == without.velocity);
      CHECK(with.tau_hat == without.tau_hat);
      CHECK(with.current_ref == without.current_ref);
      CHECK(with.duty == without.duty);
    }
  }
}

TEST_CASE("core: budgets of heat that last up to some hundred ticks, RTL and twin to the tick") {
  int fell = 0, longest = 0;
  for (int bit = 6; bit < 24; bit += 2) {
    Life s;
    s.write(A::nominal_current_squared, 0);  // it does not cool
    s.write(A::i2t_budget, static_cast<std::uint32_t>(D::i2t_start) + (1u << bit));
    s.write(A::setpoint_torque, 0x45d3);
    s.arm(D::S::setpoint);
    const int ticks = s.ticks_to_fall(600);
    if (!s.out().gates_enable) {
      CHECK(s.only(Fault::i2t));
      ++fell;
      longest = std::max(longest, ticks);
    }
    s.play();
  }
  CHECK(fell > 3);
  CHECK(longest > 100);  // 1 % of the heat is one tick
}

TEST_CASE("core: words that make the heat are at most the largest of their format") {
  const auto lives = [](std::uint32_t word) {
    Life s;
    s.write(A::nominal_current_squared, 0);
    s.write(A::i2t_budget, static_cast<std::uint32_t>(D::i2t_start) + (1u << 13));
    for (const int address : {A::inverse_resistance, A::emf_over_resistance}) {
      s.write(address, word == 0 ? word_of_design(address) : word);
    }
    s.write(A::setpoint_torque, 0x45d3);
    s.arm(D::S::setpoint);
    int ticks = 0;
    for (; s.out().gates_enable && ticks < 600; ++ticks) {
      if (ticks % 20 == 0) s.step(false);
      s.ticks(1);
    }
    CHECK(s.only(Fault::i2t));
    s.play();
    return ticks;
  };
  const int ticks = lives(0);
  CHECK(ticks > 5);
  CHECK(lives(1u << D::coefficient_bits) == lives((1u << D::coefficient_bits) - 1));
}

// Panel and host take control from each other, and this alone never arms the motor.

namespace {

constexpr std::uint32_t kArm = 1u << C::control_arm;
constexpr std::uint32_t kPanel = kHost & ~(1u << C::control_host);

bool opens(Life& s, int ticks) {
  for (int k = 0; k < ticks; ++k) {
    s.ticks(1);
    if (s.out().gates_enable) return true;
  }
  return false;
}

/// Lowers and raises the panel's request.
bool key_arms(Life& s) {
  s.in.arm = false;
  s.ticks(2);
  s.in.arm = true;
  s.ticks(1);
  return s.out().gates_enable;
}

}  // namespace

TEST_CASE("say: the host gives it back, and what the panel asked for before does not arm") {
  Life s;
  s.ticks(2);
  REQUIRE(key_arms(s));
  s.write(C::control, kHost | kArm);
  s.ticks(1);
  CHECK_FALSE(s.out().gates_enable);  // a change of control disarms
  CHECK_FALSE(opens(s, 20));
  s.write(C::control, kHost);
  s.write(C::control, kHost | kArm);
  CHECK(opens(s, 1));
  s.write(C::control, kPanel);  // the panel's request is from before
  s.ticks(1);
  CHECK_FALSE(s.out().gates_enable);
  CHECK_FALSE(opens(s, 20));
  CHECK(key_arms(s));
  s.play();
}

TEST_CASE("say: the panel asks while the host has the say, and is given it later") {
  Life s;
  s.write(C::control, kHost);
  s.in.arm = true;
  CHECK_FALSE(opens(s, 3));
  s.write(C::control, kPanel);
  CHECK_FALSE(opens(s, 20));
  CHECK(key_arms(s));
  s.play();
}

TEST_CASE("say: the panel asks through a stop, the host takes the say, clears and gives it back") {
  Life s;
  s.ticks(2);
  REQUIRE(key_arms(s));
  s.in.stop = true;
  s.ticks(1);
  s.in.stop = false;
  s.ticks(1);
  REQUIRE(s.only(Fault::stop));
  s.write(C::control, kHost);
  s.command(C::command_clear_faults);
  CHECK(s.out().faults == 0);
  s.write(C::control, kPanel);
  CHECK_FALSE(opens(s, 20));
  CHECK(key_arms(s));
  s.play();
}

TEST_CASE("say: a host that asks before it has the say asks in vain") {
  Life s;
  s.write(C::control, kPanel | kArm);
  CHECK_FALSE(opens(s, 3));
  s.write(C::control, kHost | kArm);
  CHECK_FALSE(opens(s, 20));
  s.write(C::control, kHost);
  s.write(C::control, kHost | kArm);
  CHECK(opens(s, 1));
  s.write(C::control, kPanel);  // the panel does not request arming
  s.ticks(1);
  CHECK_FALSE(s.out().gates_enable);
  s.write(C::control, kHost | kArm);  // the arm bit was low: one write is enough
  CHECK(opens(s, 1));
  s.play();
}

TEST_CASE("say: what is written in the tick in which the motor arms is held or refused") {
  constexpr std::uint32_t kMode = 3u << C::control_mode;
  constexpr std::uint32_t kVoltage = std::uint32_t{feltgate::Map::mode_voltage} << C::control_mode;
  Life s;
  s.write(A::self_test_pulse, 39);
  s.write(C::control, (kPanel & ~kMode) | kVoltage);
  s.ticks(2);
  s.in.arm = true;
  s.write(C::control, kPanel & ~kMode);  // asks for closed loop, which had no self-test
  CHECK(s.out().gates_enable);
  CHECK((s.read(C::control) & kMode) == kVoltage);
  s.in.arm = false;
  s.ticks(1);
  s.write(C::control, kPanel & ~kMode);
  CHECK((s.read(C::control) & kMode) == 0);
  s.in.arm = true;
  s.write(A::self_test_pulse, 0);
  CHECK(s.out().gates_enable);
  CHECK(s.read(A::self_test_pulse) == 39);
  s.ticks(5);
  CHECK(s.out().tau_ref == 0);  // the self-test continues
  s.play();
}

TEST_CASE("say: a clear of faults while armed leaves what the encoder has shown") {
  if (D::index_counts == 0) return;
  Life s;
  s.arm(D::S::free);
  const auto index = [&s] {
    s.in.encoder.z = true;
    s.clocks(20);
    s.in.encoder.z = false;
    s.clocks(20);
  };
  index();
  s.move(100, 40);  // a slip: the index appears at a wrong position
  s.command(C::command_clear_faults);
  CHECK(s.out().armed);
  index();
  s.ticks(3);
  CHECK(s.only(Fault::index));
  s.play();
}
