// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin from event to event against the twin clock by clock through every fault, every word
// read, and what it says of clocks to come. Documentation: docs/blocks/feltgate_core.md
#include "../feltgate_core/core_stimulus.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "skip_compare.hpp"
#include "trip_stimulus.hpp"

using namespace feltgate;
using test::compare_by_event;
using test::scaled_clocks;
using test::TripStimulus;

TEST_CASE("every fault trips in the same clock from event to event") {
  test::Met met;
  for (const std::uint32_t longest : {9u, 60u, 3000u}) {
    const std::int64_t clocks = scaled_clocks(2'000'000);
    compare_by_event<Lever>(TripStimulus<Lever>(longest), 31 + longest, clocks, longest, &met);
    compare_by_event<Paper>(TripStimulus<Paper>(longest + 1), 41 + longest, clocks, longest, &met);
    compare_by_event<Lever, false>(TripStimulus<Lever>(longest + 2), 51, clocks / 4, longest, &met);
  }
  for (const Fault f : {Fault::encoder, Fault::speed, Fault::polarity, Fault::i2t, Fault::watchdog,
                        Fault::stop, Fault::self_test, Fault::channel, Fault::index, Fault::word}) {
    INFO("fault " << static_cast<int>(f));
    CHECK(met.faults.count(static_cast<int>(f)) == 1);
  }
  CHECK(met.resets > 20);
  CHECK(met.flips > 200);
  // "Not calm" is always right, so how often it is said is all that there is to check of it.
  CAPTURE(met.armed_starts, met.armed_calm, met.idle_starts, met.idle_calm);
  CHECK(met.armed_calm * 10 > met.armed_starts);
  CHECK(met.idle_calm * 10 > met.idle_starts);
}
