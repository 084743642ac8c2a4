// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked: the limits and the faults of the core at the pins of the lamps, brought about by
// a host and a lever. Documentation: docs/blocks/feltgate_linked.md
#include "linked_life.hpp"

using namespace feltgate;
using namespace feltgate::test;
using A = D::A;

namespace {

constexpr std::uint32_t kMost = 0x7fffffff;
constexpr std::uint32_t kTorque = 1U << (D::f.torque.fraction - 4);  // 1/16 Nm

/// One that came is told by name, and all is armed again without it.
void check_fault(Life& s, Fault cause) {
  CAPTURE(s.out().core.faults);
  CHECK_FALSE(s.out().core.gates_enable);
  CHECK(s.out().core.first_fault == static_cast<unsigned>(cause));
}
void both_channels(Life& s) {
  s.in.encoder.a = !s.in.encoder.a;
  s.in.encoder.b = !s.in.encoder.b;
  s.ticks(1);
}
/// An index of one tick.
void index(Life& s) {
  s.in.encoder.z = true;
  s.ticks(1);
  s.in.encoder.z = false;
  s.ticks(1);
}
std::uint32_t raw(int address) {
  for (const auto& p : D::parameters) {
    if (p.address == address) return static_cast<std::uint32_t>(p.raw);
  }
  return 0;
}

}  // namespace

TEST_CASE("feltgate_linked: lamps for every limit that a host can set") {
  Life s;
  s.clocks(5000);
  unsigned limits = 0;
  const auto meet = [&](int ticks) {
    for (; ticks > 0; --ticks) {
      s.ticks(1);
      limits |= s.out().core.limits;
    }
  };
  const auto rearm = [&](std::initializer_list<std::pair<int, std::uint32_t>> words) {
    s.control(false, D::S::setpoint);
    for (const auto& [address, word] : words) s.write(static_cast<std::uint32_t>(address), word);
    s.arm(D::S::setpoint);
    meet(8);
  };
  rearm({{A::setpoint_torque, kTorque}, {A::duty_limit, 1}});
  CHECK((limits & limit::duty) != 0);
  rearm({{A::duty_limit, raw(A::duty_limit)}, {A::voltage_window, 0}, {A::current_limit, 1}});
  CHECK((limits & limit::voltage) != 0);
  CHECK((limits & limit::current) != 0);
  rearm({{A::voltage_window, raw(A::voltage_window)},
         {A::current_limit, raw(A::current_limit)},
         {A::hold_torque, 0},
         {A::hold_time, 1}});
  meet(3 << Map::hold_unit_bits);
  CHECK((limits & limit::hold) != 0);
  CHECK((limits & limit::ramp) != 0);
  for (int k = 0; k < 3; ++k) {  // one channel alone, again and again: chatter
    s.step(true, 100);
    s.step(false, 100);
    meet(1);
  }
  for (int k = 0; k < 40; ++k) {
    s.step(k % 2 == 0, 100);
    meet(1);
  }
  CHECK((limits & limit::chatter) != 0);
  s.play();
}

TEST_CASE("feltgate_linked: lamps for every fault that a lever and a host can cause") {
  Life s;
  s.clocks(5000);
  s.arm(D::S::setpoint);
  for (int k = 0; k < 200 && s.out().core.gates_enable; ++k) both_channels(s);
  check_fault(s, Fault::encoder);

  s.write(A::watchdog_ticks, 3000);
  s.arm(D::S::setpoint);
  s.write(D::C::command, 1U << D::C::command_kick);
  s.ticks(4000);
  check_fault(s, Fault::watchdog);
  s.write(A::watchdog_ticks, 0xffffff);

  s.arm(D::S::setpoint);
  index(s);
  for (int k = 0; k < 40; ++k) s.step(true);
  index(s);
  check_fault(s, Fault::index);

  s.write(A::setpoint_torque, kTorque);
  s.arm(D::S::setpoint);
  for (int k = 0; k < 300 && s.out().core.gates_enable; ++k) {
    for (int n = 0; n < 100 && s.out().core.gates_enable; ++n) s.step(n % 2 == 0, 20);
  }
  check_fault(s, Fault::channel);

  const std::uint32_t overspeed = raw(A::overspeed);
  s.write(A::overspeed, 1);
  s.arm(D::S::setpoint);
  for (int k = 0; k < 100 && s.out().core.gates_enable; ++k) s.step(true);
  check_fault(s, Fault::speed);
  s.write(A::overspeed, kMost);

  s.write(A::polarity_ticks, 20);
  s.write(A::polarity_speed, 1);
  s.write(A::polarity_current, 0);
  s.arm(D::S::setpoint);
  for (int gap = 40; gap > 2 && s.out().core.gates_enable; gap -= 1 + gap / 20) s.step(false, gap);
  check_fault(s, Fault::polarity);
  s.write(A::polarity_speed, kMost);
  s.write(A::overspeed, overspeed);

  s.write(A::nominal_current_squared, 0);
  s.write(A::i2t_budget, 1);
  s.arm(D::S::setpoint);
  s.ticks(400);
  check_fault(s, Fault::i2t);
  s.write(A::i2t_budget, 0xffffffff);

  s.arm(D::S::law);  // no law is loaded: nothing comes
  s.ticks(4000);
  check_fault(s, Fault::engine);
  s.arm(D::S::setpoint);
  REQUIRE(s.out().core.gates_enable);
  s.play();
}
