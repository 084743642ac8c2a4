// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin with velocity by M/T, from event to event against clock by clock, and what calm()
// may promise. docs/blocks/velocity.md
#include "../core/feltgate_core/core_stimulus.hpp"
#include "../core/system/skip_compare.hpp"

#include FELTGATE_DESIGN_HEADER

namespace {

using namespace feltgate;
using D = FELTGATE_DESIGN;
using Core = FeltgateCore<D>;

CoreIn at_count(std::uint32_t count) {
  const unsigned phase = count & 3u;
  CoreIn in;
  in.encoder = {phase >= 2, phase == 1 || phase == 2, false};
  return in;
}

}  // namespace

TEST_CASE("velocity by M/T: from event to event is as clock by clock") {
  static_assert(D::mt_counts != 0);
  for (const std::uint64_t seed : {31u, 32u}) {
    test::compare_by_event<D>(test::CoreStimulus<D>(seed), seed, test::scaled_clocks(3'000'000),
                              40'000);
    test::compare_by_event<D>(test::CoreStimulus<D>(seed), seed + 2, test::scaled_clocks(1'000'000),
                              40);
  }
}

TEST_CASE("velocity by M/T: calm() and may_trip() see the velocity that edges have told") {
  // From rest: one input of the low-pass is enough for a speed above the limit, and a tick before
  // it is known.
  Core core;
  CoreIn in;
  const auto write = [&](int address, std::uint32_t word) {
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = word;
    in.reg_write = true;
    core.clock(in);
    in.reg_write = false;
    for (int k = 0; k < 2 * D::clocks_per_tick - 1; ++k) core.clock(in);
  };
  write(D::A::self_test_pulse, 0);
  write(D::A::overspeed, (1u << D::f.velocity.fraction) / 100);
  in.arm = true;
  for (int k = 0; k < 4 * D::clocks_per_tick; ++k) core.clock(in);
  REQUIRE(core.out().gates_enable);
  bool calm = true, may_trip = false;
  std::int64_t ticks = 0, calm_ticks = 0;
  for (; core.out().gates_enable && ticks < 100; ++ticks) {
    REQUIRE(core.clock_of_tick() == 0);
    in.encoder = at_count(static_cast<std::uint32_t>(ticks / 10)).encoder;
    calm = core.calm(in, 20);
    may_trip = core.may_trip(in);
    calm_ticks += calm;
    for (int k = 0; k < D::clocks_per_tick; ++k) core.clock(in);
  }
  CHECK(core.out().faults == fault_bit(Fault::speed));
  CHECK(calm_ticks > ticks / 2);
  CHECK_FALSE(calm);
  CHECK(may_trip);
}
