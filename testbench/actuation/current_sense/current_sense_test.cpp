// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// current_sense: RTL against twin and against a convolution of all bits in every clock; the impulse
// response; the time to an over-current. Documentation: docs/blocks/current.md
#include "catch.hpp"
#include "current_sense_bench.hpp"

using namespace feltgate;
using namespace feltgate::test;

TEST_CASE("current_sense: all streams, strobes, arming, clears and resets") {
  Bench bench("current_sense", 1, CurrentSense(kSense));
  const std::int64_t average = std::int64_t{kSense.divider}
                               << (kSense.offset_log2 + kSense.decimation_log2);
  const std::int64_t clocks = std::max<std::int64_t>(1'500'000, 150 * average);
  std::int64_t results = 0, aligned = 0, latched = 0, offset_faults = 0;
  bool over = false, offset = false;
  const auto watch = [&, reference = Reference{}](const CurrentSense::In& in,
                                                  const Vcurrent_sense& rtl,
                                                  const CurrentSense& twin, bool in_reset) mutable {
    results += rtl.valid_o;
    aligned += rtl.aligned_o;
    latched += !over && rtl.overcurrent_o != 0;
    offset_faults += !offset && rtl.offset_fault_o != 0;
    over = rtl.overcurrent_o != 0, offset = rtl.offset_fault_o != 0;
    return reference(in, rtl, twin, in_reset);
  };
  bench.run(RandomStreams{Random(1), 2 * average}, scaled_clocks(clocks),
            {static_cast<std::uint32_t>(20 * average)}, watch);
  bench.run(RandomStreams{Random(2), 20'000}, scaled_clocks(1'500'000), {100'000}, watch);
  REQUIRE(aligned > 300);
  REQUIRE(results - aligned > 300);
  REQUIRE(latched > 50);
  REQUIRE(offset_faults > 3);
}

TEST_CASE("current_sense: one bit at every place gives the response of three boxes") {
  const int decimation = 1 << kSense.decimation_log2;
  const std::vector<std::int64_t> response = sinc3_response(decimation);
  CHECK(response.size() == static_cast<std::size_t>(3 * decimation - 2));
  std::int64_t gain = 0;
  for (const std::int64_t h : response) gain += h;
  CHECK(gain == 2 * kSense.full_scale());
  std::int64_t wrong = 0, tried = 0;
  for (int place = 0; place < decimation; ++place) {
    Fed fed;
    fed.in.armed = true;
    std::size_t results = 0;
    const std::int64_t one = 4 * decimation + place;
    while (results < 6) {
      fed.step([one](std::int64_t n) { return n == one; });
      if (!fed.twin.out().valid) continue;
      ++results;
      // The bit that was launched latency_clocks() ago; the first edge is that of clock 1.
      const std::int64_t launched = fed.clock - 1 - kSense.latency_clocks();
      wrong += launched % kSense.divider != 0;
      const std::int64_t newest = launched / kSense.divider;
      const std::int64_t j = newest - one;
      const bool inside = j >= 0 && j < static_cast<std::int64_t>(response.size());
      const std::int64_t wanted = inside ? response[static_cast<std::size_t>(j)] : 0;
      wrong += fed.twin.out().current + kSense.full_scale() != wanted;
      tried += inside;
    }
  }
  CHECK(wrong == 0);
  CHECK(tried >= 2 * decimation);
}

TEST_CASE("current_sense: an over-current is latched within 5 us") {
  const int bound = kSense.overcurrent_clocks();
  CHECK(bound <= 250);
  // Bits: the last moment at which all of them but the first are of the new current.
  std::int64_t latest = 0, false_trips = 0;
  for (int place = 0; place < 1 << kSense.fast_log2; ++place) {
    Fed fed;
    fed.in.threshold = static_cast<std::int32_t>(kSense.fast_full_scale() - 1);
    const std::int64_t first = 100 + place;
    std::int64_t launched = 0;
    while (!fed.twin.out().overcurrent && fed.clock < 5000) {
      const bool rose = fed.step([&](std::int64_t n) { return n >= first || n % 2 != 0; });
      if (rose && fed.bits == first + 1) launched = fed.clock;
      false_trips += fed.twin.out().overcurrent && launched == 0;
    }
    latest = std::max(latest, fed.clock - launched);
  }
  CHECK(latest == bound - 4 * kSense.divider);
  // Currents: from rest to three quarters of full scale, threshold a half.
  std::int64_t latest_step = 0, earliest_step = bound;
  for (const double sign : {1.0, -1.0}) {
    for (int phase = 0; phase < kSense.divider << (kSense.fast_log2 + 1); ++phase) {
      Fed fed;
      Modulator modulator;
      fed.in.threshold = static_cast<std::int32_t>(kSense.fast_full_scale() / 2);
      const std::int64_t at = 3000 + phase;
      while (!fed.twin.out().overcurrent && fed.clock < 5000) {
        // The modulator takes the current just before its clock rises.
        fed.step([&](std::int64_t) {
          return modulator.next(fed.clock > at ? sign * 0.75 : 0.02 * sign);
        });
      }
      false_trips += fed.clock <= at;
      latest_step = std::max(latest_step, fed.clock - at);
      earliest_step = std::min(earliest_step, fed.clock - at);
    }
  }
  INFO("bits " << latest << ", currents " << earliest_step << " to " << latest_step << " of "
               << bound << " clocks");
  CHECK(latest_step <= bound);
  CHECK(latest_step > bound / 2);
  CHECK(false_trips == 0);
}
