// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin with velocity by M/T, from event to event against clock by clock, and what
// may_trip() may promise. docs/blocks/velocity.md
#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/causes.hpp"
#include "random.hpp"
#include "twins.hpp"

#include FELTGATE_DESIGN_HEADER

namespace {

using namespace feltgate;
using D = FELTGATE_DESIGN;
using Core = test::CoreOf<D>;

CoreIn at_count(std::uint32_t count) {
  const unsigned phase = count & 3u;
  CoreIn in;
  in.encoder = {phase >= 2, phase == 1 || phase == 2, false};
  return in;
}

}  // namespace

TEST_CASE("velocity by M/T: from event to event is as clock by clock") {
  static_assert(D::mt_counts != 0);
  test::Random random(31);
  Core by_clock, by_event;
  CoreIn in;
  std::uint32_t count = 0, step = 1;
  for (int k = 0; k < 1'000; ++k) {
    const unsigned longest = 1U << random.between(6, 13);  // clocks of a count
    if (random.one_in(3)) step = 0U - step;
    in.arm = !random.one_in(50);
    for (std::uint32_t n = random.below(20); n > 0; --n) {
      in.encoder = at_count(count += step).encoder;
      const int clocks = 4 + static_cast<int>(random.below(longest));
      for (int c = 0; c < clocks; ++c) by_clock.clock(in);
      by_event.run(in, clocks, [] {});
      REQUIRE(by_clock.out() == by_event.out());
    }
  }
  CHECK(by_event.whole_ticks() > 40'000);
}

TEST_CASE("velocity by M/T: may_trip() sees the velocity that edges have told") {
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
  bool may_trip = false;
  std::int64_t ticks = 0, calm_ticks = 0;
  for (; core.out().gates_enable && ticks < 100; ++ticks) {
    REQUIRE(core.clock_of_tick() == 0);
    in.encoder = at_count(static_cast<std::uint32_t>(ticks / 10)).encoder;
    may_trip = core.may_trip(in);
    calm_ticks += !may_trip;
    for (int k = 0; k < D::clocks_per_tick; ++k) core.clock(in);
  }
  CHECK(core.out().faults == fault_bit(Fault::speed));
  CHECK(calm_ticks > ticks / 2);
  CHECK(may_trip);
}
