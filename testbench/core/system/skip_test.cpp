// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin from event to event against the twin clock by clock: the same outputs, registers read
// back and gate times, on long random runs. Documentation: docs/architecture.md
#include "../feltgate_core/core_stimulus.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/generated/paper.hpp"
#include "skip_compare.hpp"

namespace {

using namespace feltgate;

template <class D>
void compare(std::uint64_t seed, std::int64_t clocks, std::uint32_t longest = 40'000) {
  test::compare_by_event<D>(test::CoreStimulus<D>(seed), seed, clocks, longest);
}

}  // namespace

TEST_CASE("skipping from event to event changes nothing") {
  for (const std::uint64_t seed : {21u, 22u, 23u}) {
    compare<Lever>(seed, test::scaled_clocks(8'000'000));
    compare<Paper>(seed + 100, test::scaled_clocks(8'000'000));
    compare<LeverLaw>(seed + 200, test::scaled_clocks(4'000'000));
  }
}

TEST_CASE("nor does stopping anywhere in a tick") {
  for (const std::uint32_t longest : {7u, 40u, 120u}) {
    compare<Lever>(longest, test::scaled_clocks(3'000'000), longest);
    compare<Paper>(longest + 1, test::scaled_clocks(3'000'000), longest);
    compare<LeverLaw>(longest + 2, test::scaled_clocks(1'000'000), longest);
  }
}

TEST_CASE("a stop of one clock is a fault in every clock of a tick, by clocks and by events") {
  for (int at = 0; at < Lever::clocks_per_tick; ++at) {
    FeltgateCore<Lever> by_clock, by_event;
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
