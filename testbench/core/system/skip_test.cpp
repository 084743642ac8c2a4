// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin from event to event against the twin clock by clock: the same outputs, registers read
// back and gate times, on long random runs. Documentation: docs/architecture.md
#include "../feltgate_core/core_stimulus.hpp"
#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/generated/paper.hpp"
#include "skip_compare.hpp"
#include "twins.hpp"

namespace {

using namespace feltgate;

template <class D>
void compare(std::uint64_t seed, std::int64_t clocks, std::uint32_t longest = 40'000) {
  test::compare_by_event<D>(test::CoreStimulus<D>(seed), seed, clocks, longest);
}

}  // namespace

TEST_CASE("skipping from event to event changes nothing") {
  for (const std::uint64_t seed : {21u, 22u}) {
    compare<Lever>(seed, test::scaled_clocks(5'000'000));
    compare<Paper>(seed + 100, test::scaled_clocks(5'000'000));
    compare<LeverLaw>(seed + 200, test::scaled_clocks(3'000'000));
  }
}

TEST_CASE("nor does stopping anywhere in a tick") {
  for (const std::uint32_t longest : {7u, 40u, 120u}) {
    compare<Lever>(longest, test::scaled_clocks(1'000'000), longest);
    compare<Paper>(longest + 1, test::scaled_clocks(1'000'000), longest);
    compare<LeverLaw>(longest + 2, test::scaled_clocks(1'000'000), longest);
  }
}

TEST_CASE("a stop of one clock is a fault in every clock of a tick, by clocks and by events") {
  for (int at = 0; at < Lever::clocks_per_tick; ++at) {
    test::CoreOf<Lever> by_clock, by_event;
    CoreIn in;
    const auto both = [&](int clocks) {
      for (int k = 0; k < clocks; ++k) by_clock.clock(in);
      by_event.run(in, clocks, [] {});
    };
    both(10 * Lever::clocks_per_tick);
    in.arm = true;
    both(10 * Lever::clocks_per_tick + at);
    in.stop = true;
    both(1);
    in.stop = false;
    both(3);
    INFO("clock " << at);
    CHECK(by_event.out().faults == fault_bit(Fault::stop));
    CHECK_FALSE(by_event.out().gates_enable);
    both(10 * Lever::clocks_per_tick);
    CHECK(by_clock.out() == by_event.out());
  }
}

// What only the twin of the core has: what it is before a reset, what waits, writes carried out, a
// core that is not read.

using A = Lever::A;
using C = Lever::C;

namespace {

constexpr int kTick = Lever::clocks_per_tick;

template <bool ReadBack = true>
struct Core {
  test::CoreOf<Lever, ReadBack> core;
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
