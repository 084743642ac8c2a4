// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What only the twin of the core has: what it is before a reset, what waits, writes carried out, a
// core that is not read. Documentation: docs/architecture.md
#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"

using namespace feltgate;
using A = Lever::A;
using C = Lever::C;

namespace {

constexpr int kTick = Lever::clocks_per_tick;

template <bool ReadBack = true>
struct Core {
  FeltgateCore<Lever, ReadBack> core;
  CoreIn in;

  void clocks(int n) {
    for (int k = 0; k < n; ++k) core.clock(in);
  }
  void to_end_of_tick() { clocks((kTick - core.clock_of_tick()) % kTick); }
  void ask(int address, std::uint32_t word) {
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = word;
    in.reg_write = true;
    clocks(1);
    in.reg_write = false;
  }
  void write(int address, std::uint32_t word) {
    ask(address, word);
    to_end_of_tick();
  }
};

}  // namespace

TEST_CASE("a new core is one that was reset") {
  Core<> fresh, reset;
  reset.core.reset();
  CHECK(fresh.core.out() == reset.core.out());
  CHECK(fresh.core.out().limits != 0);  // the gates are closed
}

TEST_CASE("a write waits until its tick ends, and is counted when it is carried out") {
  Core<> c;
  c.clocks(2 * kTick);
  CHECK(c.core.at_rest());
  CHECK(c.core.writes() == 0);
  c.clocks(5);
  c.ask(C::control, static_cast<std::uint32_t>(Lever::control_reset));
  CHECK_FALSE(c.core.at_rest());
  CHECK(c.core.writes() == 0);
  c.to_end_of_tick();
  CHECK(c.core.at_rest());
  CHECK(c.core.writes() == 1);
  c.clocks(3 * kTick);
  CHECK(c.core.writes() == 1);
  c.write(A::setpoint_torque, 7);
  CHECK(c.core.writes() == 2);
  c.core.reset();
  CHECK(c.core.writes() == 0);
  c.write(A::setpoint_torque, 8);
  CHECK(c.core.writes() == 1);
}

TEST_CASE("a core that is not read shows no word") {
  Core<false> c;
  for (int k = 0; k < 3 * kTick; ++k) {
    c.clocks(1);
    REQUIRE_FALSE(c.core.out().word_valid);
    REQUIRE(c.core.out().word_slot == 0);
    REQUIRE(c.core.out().word_data == 0);
  }
  CHECK(c.core.out().tick_count == 3);
}
