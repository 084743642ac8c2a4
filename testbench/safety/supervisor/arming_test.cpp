// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: which request arms, which waits and for how long, which is refused, and what a change
// of control does. Documentation: docs/blocks/supervisor.md
#include <limits>

#include "bench.hpp"
#include "catch.hpp"

using namespace feltgate::test;
using feltgate::Fault;

TEST_CASE("supervisor: arming asks for a rising request, no fault and no stop") {
  Script s;
  s.now.arm = true;  // stuck high from reset on
  s.ticks(5);
  REQUIRE_FALSE(s.out().armed);
  s.now.arm = false;
  s.ticks(1);
  s.now.arm = true;
  s.clocks(kTick - 1);
  REQUIRE_FALSE(s.out().armed);  // arming takes effect when the tick ends
  s.clocks(1);
  REQUIRE((s.out().armed && s.out().gates_enable));
  s.clocks(10);
  s.now.arm = false;
  s.clocks(kTick - 11);
  REQUIRE((s.out().armed && s.out().gates_enable));
  s.clocks(1);
  REQUIRE_FALSE((s.out().armed || s.out().gates_enable));
  REQUIRE(s.out().faults == 0);

  s.now.stop = true;  // a request during a stop is lost
  s.arm();
  REQUIRE_FALSE(s.out().armed);
  s.now.stop = false;
  s.ticks(5);
  REQUIRE_FALSE(s.out().armed);
  REQUIRE(s.out().faults == 0);
  s.arm();
  REQUIRE(s.out().armed);

  s.now.velocity = std::numeric_limits<std::int32_t>::max();
  s.ticks(1);
  REQUIRE(only(s, Fault::speed));
  s.now.velocity = 0;
  s.now.clear_faults = true;  // does not act while the request is high
  REQUIRE(only(s.ticks(3), Fault::speed));
  s.now.clear_faults = false;
  s.arm();  // a request during a fault is lost
  s.ticks(2);
  REQUIRE_FALSE(s.out().armed);
  s.clear();
  REQUIRE((s.out().faults == 0 && s.out().first_fault == 0 && !s.out().armed));
  s.arm();
  REQUIRE(s.out().armed);
  s.play();
}

TEST_CASE("supervisor: whoever gets the say must be seen to ask for nothing first") {
  for (const bool to_host : {false, true}) {   // the side that gets control while it requests
    for (const bool of_old : {false, true}) {  // the request of the other side at that time
      Script s;
      bool& gets = to_host ? s.now.host_arm : s.now.arm;
      bool& other = to_host ? s.now.arm : s.now.host_arm;
      s.now.host = !to_host;
      s.ticks(2);
      gets = true;  // while the other side has control
      other = of_old;
      s.ticks(2);
      REQUIRE(s.out().armed == of_old);
      other = false;
      s.ticks(2);
      REQUIRE_FALSE(s.out().armed);
      s.now.host = to_host;
      s.ticks(5);
      REQUIRE_FALSE(s.out().gates_enable);
      s.now.clear_faults = true;
      s.ticks(2);
      s.now.clear_faults = false;
      REQUIRE_FALSE(s.out().gates_enable);
      gets = false;
      s.ticks(1);
      gets = true;
      s.ticks(1);
      REQUIRE(s.out().gates_enable);
      s.play();
    }
  }
}

TEST_CASE("supervisor: a change of control disarms, whatever the new owner asks") {
  for (const bool to_host : {false, true}) {
    for (const bool before : {false, true}) {  // the new owner's request rose, or rises with it
      Script s;
      bool& gets = to_host ? s.now.host_arm : s.now.arm;
      bool& other = to_host ? s.now.arm : s.now.host_arm;
      s.now.host = !to_host;
      s.ticks(1);
      other = true;
      s.ticks(2);
      gets = before;
      s.ticks(2);
      REQUIRE(s.out().gates_enable);
      gets = true;
      s.now.host = to_host;
      s.ticks(1);
      REQUIRE_FALSE(s.out().gates_enable);
      s.ticks(3);
      REQUIRE_FALSE(s.out().gates_enable);
      s.now.host = !to_host;  // nor does giving it back arm
      s.ticks(3);
      REQUIRE_FALSE(s.out().gates_enable);
      gets = other = false;
      s.ticks(1);
      gets = true;  // of a motor that is off, a request that begins with the change counts
      s.now.host = to_host;
      s.ticks(1);
      REQUIRE(s.out().gates_enable);
      s.play();
    }
  }
}

TEST_CASE("supervisor: a request waits for less than 20 ms, then it must be given anew") {
  static_assert((Twin::wait_ticks + 1) * kTick * 50 == Design::clock_hz);
  for (const bool host : {false, true}) {
    for (const bool late : {false, true}) {
      Script s;
      bool& asks = host ? s.now.host_arm : s.now.arm;
      s.now.host = host;
      s.ticks(5);
      s.now.axis_silent = true;  // a sensor starts, another axis does not ask
      asks = true;
      s.ticks(Twin::wait_ticks - (late ? 0 : 1));
      REQUIRE_FALSE(s.out().armed);
      s.now.axis_silent = false;
      s.ticks(1);
      REQUIRE(s.out().gates_enable == !late);
      s.now.axis_silent = late;
      s.ticks(2);
      s.now.axis_silent = false;
      s.ticks(2);
      REQUIRE(s.out().gates_enable == !late);
      asks = false;
      s.ticks(1);
      asks = true;
      s.ticks(1);
      REQUIRE(s.out().gates_enable);
      s.play();
    }
  }
}

TEST_CASE("supervisor: what refuses a request, however briefly, refuses it for good") {
  enum Why { blocked, missing, stopped, disarmed, fault, opened };
  for (const Why why : {blocked, missing, stopped, disarmed, fault, opened}) {
    CAPTURE(why);
    Script s;
    s.ticks(5);
    s.now.axis_silent = why != opened;
    s.now.arm = true;
    s.ticks(2);
    REQUIRE(s.out().gates_enable == (why == opened));
    s.now.axis_blocked = why == blocked || why == missing;  // a sensor that is missing is both
    s.now.axis_silent = why != missing;
    s.now.disarm = why == disarmed;
    s.clocks(10);
    s.now.stop = why == stopped;
    s.now.trips = static_cast<std::uint16_t>(why == fault ? fault_bit(Fault::current) : 0);
    s.clocks(1);
    s.now.stop = false;
    s.now.trips = 0;
    s.until(0);
    REQUIRE_FALSE(s.out().gates_enable);
    s.now.axis_blocked = s.now.axis_silent = s.now.disarm = false;
    s.ticks(3);
    REQUIRE_FALSE(s.out().gates_enable);
    s.clear();
    s.arm();
    REQUIRE(s.out().gates_enable);
    s.play();
  }
}

TEST_CASE("supervisor: a request of before a stop or a fault is not one after it") {
  for (const bool gates_on : {true, false}) {
    Script s;
    s.ticks(1);
    s.now.axis_silent = !gates_on;
    s.now.arm = true;
    s.ticks(1);
    REQUIRE(s.out().armed == gates_on);
    s.now.stop = true;
    s.ticks(1);
    s.now.stop = false;
    s.ticks(1);
    REQUIRE(only(s, Fault::stop) == gates_on);
    s.now.axis_silent = true;  // another axis stops its request, clears its faults, requests again
    s.now.clear_faults = true;
    s.ticks(2);
    REQUIRE(only(s, Fault::stop) == gates_on);
    s.now.clear_faults = false;
    s.now.axis_silent = false;
    s.ticks(3);
    REQUIRE_FALSE(s.out().armed);
    s.now.host = true;  // the host takes control, clears the faults, and gives control back
    s.now.clear_faults = true;
    s.ticks(2);
    REQUIRE(s.out().faults == 0);
    s.now.clear_faults = false;
    s.now.host = false;
    s.ticks(3);
    REQUIRE_FALSE(s.out().gates_enable);
    s.arm();
    REQUIRE(s.out().gates_enable);
    s.play();
  }
}

TEST_CASE("supervisor: a stop shortly before arming prevents it, or is a fault of what it armed") {
  for (int before = 1; before <= 10; ++before) {  // clocks; in the last of them the motor is armed
    Script s;
    s.ticks(1).clocks(kTick - before);
    s.now.arm = true;
    s.now.stop = true;
    s.clocks(1);
    s.now.stop = false;
    if (before > 1) s.until(0);
    CAPTURE(before);
    REQUIRE(s.out().armed == (before < 3));
    s.clocks(5);
    REQUIRE_FALSE(s.out().gates_enable);
    REQUIRE(s.out().faults == (before < 3 ? fault_bit(Fault::stop) : 0));
    s.play();
  }
}
