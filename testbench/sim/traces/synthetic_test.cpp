// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder motions made by rule: what each one must count to, and that a seed repeats it.
// Documentation: docs/traces.md
#include <cmath>
#include <set>
#include <stdexcept>

#include "catch.hpp"
#include "recording_files.hpp"
#include "sim/traces/compose.hpp"
#include "sim/traces/phase.hpp"
#include "sim/traces/statistics.hpp"

using namespace feltgate;
using namespace feltgate::traces;
using namespace feltgate::traces::synthetic;

namespace {

Statistics counted(Source source) { return count_steps(*source); }

std::vector<Source> list(Source a, Source b) {
  std::vector<Source> parts;
  parts.push_back(std::move(a));
  parts.push_back(std::move(b));
  return parts;
}

}  // namespace

TEST_CASE("phases and pins are inverse, and counting up B leads", "[traces]") {
  for (unsigned phase = 0; phase < 4; ++phase) CHECK(phase_of(pins_at(phase)) == phase);
  CHECK(pins_at(1) == EncoderPins{false, true, false});
  CHECK(pins_at(7) == pins_at(3));
}

TEST_CASE("constant speed does not drift", "[traces]") {
  // 0.1 to 600 rad/s at 4096 counts per turn.
  for (const double rad_s : {0.1, 1.0, 10.0, 100.0, 600.0, -600.0}) {
    const double rate = rad_s * 4096 / 6.283185307179586;
    const Statistics found = counted(constant_speed(rate, 5000));
    CHECK(found.steps == 5000);
    CHECK(found.position == (rad_s > 0 ? 5000 : -5000));
    CHECK(found.reversals == 0);
    const double expected = 5000 / std::fabs(rate) * 50e6;
    CHECK(std::fabs(static_cast<double>(found.length) - expected) < 2 + 1e-6 * expected);
  }
  CHECK(counted(one_count_per_second(3)).shortest_edge_spacing == Clock{50'000'000});
  CHECK_THROWS_AS(constant_speed(0, 1), std::invalid_argument);
  CHECK_THROWS_AS(constant_speed(50'000'001, 1), std::invalid_argument);
}

TEST_CASE("fast runs reach one state per clock", "[traces]") {
  const Statistics found = counted(fast_run(100'000, 1, -1));
  CHECK(found.position == -100'000);
  CHECK(found.shortest_edge_spacing == Clock{1});
  CHECK(found.length == 100'001);
}

TEST_CASE("reversals visit every phase in both directions", "[traces]") {
  for (std::int64_t reach = 1; reach <= 5; ++reach) {
    const Source source = reversals(8, reach, 10);
    EncoderPins before = source->initial();
    std::set<unsigned> tops;
    std::set<unsigned> bottoms;
    int last = 0;
    for (const EncoderEvent& event : test::all_events(*source)) {
      const int turn = ((phase_of(event.pins) - phase_of(before)) & 3U) == 1 ? 1 : -1;
      if (last == 1 && turn == -1) tops.insert(phase_of(before));
      if (last == -1 && turn == 1) bottoms.insert(phase_of(before));
      last = turn;
      before = event.pins;
    }
    CHECK(tops.size() == 4);
    CHECK(bottoms.size() == 4);
    const Statistics found = counted(reversals(8, reach, 10));
    CHECK(found.position == 8);
    CHECK(found.reversals == 16);
    CHECK(found.steps == 8 * (2 * reach + 1));
  }
}

TEST_CASE("dither, steps and chirp", "[traces]") {
  Statistics found = counted(dither(1001, 7));
  CHECK(found.position == 1);
  CHECK(found.reversals == 1000);
  found = counted(steps(5, 100, 50, 1'000'000));
  CHECK(found.position == 100);
  CHECK(found.reversals == 4);
  CHECK(found.steps == 500);
  found = counted(chirp(200, 1.0, 20.0, 2.0));
  CHECK(found.illegal == 0);
  CHECK(found.reversals >= 40);  // 21 periods
  CHECK(found.reversals <= 43);
  CHECK(std::llabs(found.steps - 21 * 800) < 20);
  CHECK(found.length <= 100'000'100);
  CHECK_THROWS_AS(chirp(1'000'000, 1, 1000, 1), std::invalid_argument);
}

TEST_CASE("random walks repeat by seed, and illegal ones are counted", "[traces]") {
  const auto events = [](std::uint64_t seed) {
    return test::all_events(*random_walk(seed, 1000, 1, 100));
  };
  const auto first = events(3);
  const auto again = events(3);
  const auto other = events(4);
  REQUIRE(first.size() == 1000);
  bool same = true;
  bool differ = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    same = same && first[i].clock == again[i].clock && first[i].pins == again[i].pins;
    differ = differ || first[i].clock != other[i].clock;
  }
  CHECK(same);
  CHECK(differ);
  CHECK(counted(random_walk(3, 10'000, 1, 100)).illegal == 0);
  const Statistics found = counted(illegal(5, 10'000, 100, 1, 20));
  CHECK(found.steps == 10'000);
  CHECK(std::llabs(found.illegal - 1000) < 150);
  CHECK(counted(illegal(5, 100, 1000, 1, 1)).illegal == 100);
}

TEST_CASE("bounce keeps the counts and adds steps", "[traces]") {
  const Statistics found = counted(with_bounce(constant_speed(1000, 2000), 9, 5, 200));
  CHECK(found.position == 2000);
  CHECK(found.illegal == 0);
  CHECK(found.steps > 2000 + 2 * 2000);
  CHECK(found.steps - 2000 == found.reversals);
  // Where the edges are a clock apart there is no room.
  CHECK(counted(with_bounce(fast_run(100), 9, 5, 3)).steps == 100);
  CHECK(counted(with_bounce(illegal(5, 1000, 1000, 100, 100), 9, 5, 3)).illegal == 1000);
}

TEST_CASE("sequences go on from the phase and clock before", "[traces]") {
  const Source source = sequence(list(fast_run(3, 10), fast_run(5, 7, -1)));
  Clock last = 0;
  StepCounter counter(source->initial());
  for (const EncoderEvent& event : test::all_events(*source)) {
    CHECK(event.clock > last);
    last = event.clock;
    counter.add(event);
  }
  CHECK(counter.result().position == -2);
  CHECK(counter.result().illegal == 0);
  CHECK(source->length() == 31 + 36);
  CHECK_THROWS_AS(sequence({}), std::invalid_argument);
  const auto indexed = sequence(list(with_index(fast_run(3, 10), 2), fast_run(1, 10)));
  const auto events = test::all_events(*indexed);
  REQUIRE(events.size() == 4);
  CHECK_FALSE(events[0].pins.z);
  CHECK(events[1].pins.z);
  CHECK(indexed->initial().z);
}

TEST_CASE("cut sources end where they are cut, and events come as given", "[traces]") {
  const Statistics found = counted(cut(fast_run(100, 10), 55));
  CHECK(found.steps == 5);
  CHECK(found.length == 55);
  CHECK(counted(cut(fast_run(3, 10), 1000)).length == 31);
  const Statistics given = counted(from_events(
      {false, true, false}, {{4, {true, true, false}}, {9, {false, false, false}}}, 10));
  CHECK(given.steps == 2);
  CHECK(given.illegal == 1);
  CHECK(given.position == 1);
  CHECK(given.length == 10);
  CHECK_THROWS_AS(from_events({}, {{0, {}}}, 5), std::invalid_argument);
}
