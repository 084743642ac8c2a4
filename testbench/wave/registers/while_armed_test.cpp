// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The effect of a write while the core is armed, and the class that gives this effect to a chain
// without a port. Documentation: docs/registers.md
#include "feltgate/while_armed.hpp"

#include "catch.hpp"
#include "feltgate/generated/map.hpp"

namespace {

using namespace feltgate;
using A = Map::A;
using C = Map::C;
using S = Map::S;

constexpr std::uint32_t bit(int n) { return std::uint32_t{1} << n; }
constexpr std::uint32_t armed_by_host = bit(C::control_host) | bit(C::control_arm);
constexpr std::uint32_t mode(unsigned m) { return std::uint32_t{m} << C::control_mode; }

}  // namespace

TEST_CASE("while armed: which parameters act at once, ramp, or are refused") {
  CHECK(while_armed(A::torque_constant, S::wall) == WhileArmed::refused);
  CHECK(while_armed(A::torque_limit, S::wall) == WhileArmed::ramps);
  CHECK(while_armed(A::ramp_step, S::wall) == WhileArmed::acts);
  CHECK(while_armed(A::wall_stiffness, S::wall) == WhileArmed::ramps);
  CHECK(while_armed(A::wall_stiffness, S::damper) == WhileArmed::acts);
  CHECK(while_armed(A::setpoint_torque, S::setpoint) == WhileArmed::acts);
  // Words below 64 belong to no scene, whatever number is in force.
  for (const int address : {57, 62, 63}) CHECK(while_armed(address, 1) == WhileArmed::acts);
}

TEST_CASE("while armed: a host disarms by what it says, others do not") {
  CHECK(disarms(bit(C::control_host)));
  CHECK_FALSE(disarms(armed_by_host));
  CHECK_FALSE(disarms(0));
}

TEST_CASE("while armed: the control word's fields hold") {
  HostBeside host(mode(1));
  CHECK(host.mode() == 1);
  CHECK_FALSE(host.write(C::control, armed_by_host | mode(2), false));
  CHECK(host.mode() == 2);
  host.restart(true, S::wall);
  CHECK_FALSE(host.write(C::control, armed_by_host | mode(3), true));
  CHECK(host.mode() == 2);
  // If the host does not have control, its writes do not disarm.
  CHECK_FALSE(host.write(C::control, mode(3), true));
  CHECK(host.mode() == 2);
  SECTION("until it disarms") {
    CHECK_FALSE(host.write(C::control, bit(C::control_host) | mode(3), true));
    CHECK(host.mode() == 3);
  }
  SECTION("or a disarm came in the same tick") {
    CHECK_FALSE(host.write(C::control, armed_by_host | mode(3), true, true));
    CHECK(host.mode() == 3);
  }
  SECTION("or it is disarmed") {
    host.restart(false, S::wall);
    CHECK_FALSE(host.write(C::control, armed_by_host | mode(0), false));
    CHECK(host.mode() == 0);
  }
}

TEST_CASE("while armed: what is carried out as it is armed comes too late") {
  HostBeside host(mode(2));
  CHECK_FALSE(host.write(C::control, armed_by_host | mode(1), true));
  CHECK(host.mode() == 2);
  CHECK_FALSE(host.write(A::torque_constant, 1, true));
}

TEST_CASE("while armed: the mode has its bits and no others") {
  const std::uint32_t others = ~mode((1U << C::control_mode_width) - 1);
  CHECK(HostBeside(others).mode() == 0);
  CHECK(HostBeside(others | mode(2)).mode() == 2);
}

TEST_CASE("while armed: before the first tick it is disarmed, free, and no ramp begins") {
  HostBeside host(0);
  CHECK_FALSE(host.restart(false, S::free));
  HostBeside other(0);
  CHECK(other.write(A::torque_constant, 1, false));
  CHECK_FALSE(other.restart(false, S::free));
  // Scene 0 is in force: words of other numbers do not begin a ramp.
  HostBeside third(0);
  CHECK(third.write(A::wall_stiffness, 1, false));
  CHECK(third.write(32 * S::membrane + 1, 1, false));
  CHECK_FALSE(third.restart(false, S::free));
}

TEST_CASE("while armed: parameters that a chain is to take, and ramps that begin") {
  HostBeside host(0);
  host.restart(true, S::wall);
  CHECK_FALSE(host.write(A::torque_constant, 1, true));
  CHECK_FALSE(host.restart(true, S::wall));
  CHECK(host.write(A::ramp_step, 1, true));
  CHECK_FALSE(host.restart(true, S::wall));
  CHECK(host.write(A::wall_stiffness, 1, true));
  CHECK(host.restart(true, S::wall));
  CHECK_FALSE(host.restart(true, S::wall));
  // A requested ramp stays requested, independent of other writes in the same tick.
  CHECK(host.write(A::torque_limit, 1, true));
  CHECK(host.write(A::ramp_step, 1, true));
  CHECK(host.restart(true, S::wall));
  host.restart(false, S::wall);
  CHECK(host.write(A::torque_constant, 1, false));
  CHECK(host.write(C::control - 1, 1, false));  // the last parameter
  CHECK_FALSE(host.write(C::control, 0, false));
  CHECK_FALSE(host.write(C::command + 1, 1, false));  // neither a parameter nor control or command
}

TEST_CASE("while armed: a new zero begins a ramp, but where the torque is an input") {
  for (const int scene : {S::wall, S::setpoint}) {
    INFO("scene " << scene);
    HostBeside host(0);
    host.restart(true, scene);
    CHECK_FALSE(host.write(C::command, ~bit(C::command_set_zero), true));
    CHECK_FALSE(host.restart(true, scene));
    CHECK_FALSE(host.write(C::command, bit(C::command_set_zero), true));
    CHECK(host.restart(true, scene) == (scene == S::wall));
    host.zero();
    CHECK(host.restart(true, scene) == (scene == S::wall));
    // Not the commands: the same bits in another word.
    CHECK_FALSE(host.write(C::control, ~std::uint32_t{0}, true));
    CHECK_FALSE(host.restart(true, scene));
  }
  HostBeside host(0);
  host.restart(true, S::setpoint);
  host.write(A::torque_limit, 1, true);
  host.zero();
  CHECK(host.restart(true, S::setpoint));
}
