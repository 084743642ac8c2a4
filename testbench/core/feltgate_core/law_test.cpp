// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Directed tests of the scene for programs and of the signals from other axes: twin against
// expected values, RTL against twin. Documentation: docs/architecture.md
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

TEST_CASE("law: the torque of the port in its clock is the tick's, limited") {
  Life s;
  s.arm(D::S::law);
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
  Life s;
  s.in.law_torque = torque(0.2);
  s.arm(D::S::setpoint);
  s.in.law_late = true;
  s.ticks(3);
  CHECK(s.out().gates_enable);
  s.disarm();
  s.in.law_late = false;
  s.arm(D::S::law);
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

TEST_CASE("law: while it may jump the torque ramps") {
  Life s;
  s.arm(D::S::law);
  s.write(A::ramp_step, 1u << 8);
  s.in.law_restart = true;
  s.ticks(5);
  s.in.law_torque = torque(0.2);
  s.ticks(3);
  CHECK(s.shown().tau_ref < torque(0.2) / 100);
  CHECK((s.shown().limits >> Map::L::ramp & 1u) == 1);
  s.in.law_restart = false;
  s.ticks(1);
  s.write(A::ramp_step, 0x7ffffff);
  s.ticks(3);
  CHECK(s.shown().tau_ref == torque(0.2));
  s.in.law_torque = torque(-0.2);
  s.ticks(1);
  CHECK(s.shown().tau_ref == torque(-0.2));
  s.play();
}

TEST_CASE(
    "axis: a fault of another opens the gates in the next clock, and only while they are on") {
  Life s;
  s.in.axis_fault = true;
  s.ticks(2);
  CHECK(s.out().faults == 0);
  s.in.axis_fault = false;
  s.arm(D::S::setpoint);
  s.to_clock(31);
  s.in.axis_fault = true;
  s.clocks(1);
  CHECK_FALSE(s.out().gates_enable);
  CHECK(s.only(Fault::axis));
  s.ticks(1);
  CHECK_FALSE(s.out().armed);
  s.play();
}

TEST_CASE("axis: while another tests itself the scene waits") {
  Life s;
  s.in.law_torque = torque(0.2);
  s.arm(D::S::law);
  s.ticks(2);
  s.in.axis_testing = true;
  s.ticks(2);
  CHECK(s.shown().tau_ref == 0);
  CHECK((s.read(C::snapshot + Map::R::status) >> C::status_testing & 1u) == 1);
  s.to_clock(0);
  s.in.axis_testing = false;
  s.ticks(3);
  CHECK(s.shown().tau_ref == torque(0.2));
  s.play();
}
