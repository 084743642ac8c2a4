// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_core: panel and host take control from each other, and this alone never arms the motor.
// Documentation: docs/architecture.md
#include "core_life.hpp"

using namespace feltgate::test;
using feltgate::Fault;
using D = feltgate::test::Design;

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
