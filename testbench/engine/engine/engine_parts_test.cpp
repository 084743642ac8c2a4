// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: its parts alone, from their first clock and with inputs that no engine gives.
// Documentation: docs/blocks/engine.md
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "catch.hpp"
#include "feltgate/engine_parts.hpp"

using namespace feltgate;

namespace {

using Inputs = EngineInputs<1>;
using Outputs = EngineOutputs<2, 21>;

Outputs::In watched(unsigned max_age) {
  Outputs::In in;
  in.watched = true;
  in.max_age = max_age;
  return in;
}

/// Returns the number of ticks up to the tick that makes the outputs late.
int ticks_to_late(Outputs& outputs, unsigned max_age) {
  Outputs::In in = watched(max_age);
  for (int ticks = 1; ticks < 100; ++ticks) {
    in.tick = true;
    outputs.clock(in);
    if (outputs.late) return ticks;
    in.tick = false;
    for (int k = 0; k < 3; ++k) outputs.clock(in);
    if (outputs.late) return 0;
  }
  return -1;
}

/// Returns the clocks of a check whose beats are `every` clocks apart.
int clocks_of_check(EngineCrc& crc, int line_base, int every) {
  EngineCrc::In in;
  in.line_base = line_base;
  for (int k = 0; k < 1'000'000; ++k) {
    in.start = k == 0;
    in.beat = k % every == every - 1;
    crc.clock(in);
    if (crc.done) return k;
  }
  return -1;
}

}  // namespace

TEST_CASE("engine: as made no thread is due, and its dividers are those of the configuration") {
  Inputs inputs;
  const std::array<unsigned, 4> dividers{3, 1, 0, 2};
  inputs.configure(dividers);
  Inputs::In in;
  in.run = 15;
  for (int k = 0; k < 20; ++k) {
    inputs.clock(in);
    REQUIRE_FALSE(inputs.wanted());
    REQUIRE(inputs.request == 0);
    REQUIRE(inputs.running == 0);
  }
  std::array<int, 4> starts{};
  for (int tick = 0; tick < 24; ++tick) {
    for (int k = 0; k < 60; ++k) {
      in.tick = k == 0;
      in.taken = inputs.wanted();
      in.started = in.ended = false;
      for (int thread = 0; thread < 4; ++thread) {
        if ((inputs.request >> thread & 1U) == 0) continue;
        in.started = in.ended = true;
        in.thread = thread;
        starts[static_cast<std::size_t>(thread)] += 1;
        REQUIRE(tick % static_cast<int>(std::max(dividers[static_cast<std::size_t>(thread)], 1U)) ==
                0);
        break;
      }
      inputs.clock(in);
    }
  }
  CHECK(starts == std::array<int, 4>{8, 24, 24, 12});
}

TEST_CASE("engine: a thread that waits and is stopped is not due again") {
  Inputs inputs;
  inputs.configure({1, 1, 1, 1});
  Inputs::In in;
  in.run = 1;
  int again = 0;
  for (int k = 0; k < 30; ++k) {
    in.tick = k % 10 == 0;
    inputs.clock(in);
    again += inputs.due_again(1);
    REQUIRE_FALSE(inputs.due_again(0));
  }
  CHECK(again == 2);
}

TEST_CASE("engine: the age of outputs begins at 0, as made and while nobody watches") {
  for (const unsigned max_age : {0U, 1U, 5U}) {
    Outputs made, unwatched;
    CHECK(ticks_to_late(made, max_age) == static_cast<int>(max_age) + 1);
    Outputs::In in;
    in.tick = true;
    in.max_age = max_age;
    for (int k = 0; k < 4; ++k) unwatched.clock(in);
    CHECK(ticks_to_late(unwatched, max_age) == static_cast<int>(max_age) + 1);
  }
}

TEST_CASE("engine: as made the first outputs of all axes are fresh") {
  Outputs outputs;
  Outputs::In in = watched(9);
  in.output = true;
  for (in.number = 0; in.number < 2; ++in.number) {
    in.result = 100 + in.number;
    in.last = in.number == 1;
    outputs.clock(in);
    REQUIRE_FALSE(outputs.fresh);
  }
  outputs.clock(watched(9));
  CHECK(outputs.fresh);
  CHECK(outputs.torque == std::array<std::int32_t, 2>{100, 101});
}

TEST_CASE(
    "engine: each word of a check is taken with its third beat, and checks take the same time") {
  constexpr int words = EngineMap::program_words + EngineMap::data_words - EngineMap::D::lower;
  for (const int line_base : {0, 37, 512}) {
    EngineCrc crc;
    // After the last word the check still processes its bits, and compares in the next clock.
    const int clocks = 60 * 3 * (words + line_base) + (line_base == 0 ? 33 : 41);
    CHECK(clocks_of_check(crc, line_base, 60) == clocks);
    CHECK(clocks_of_check(crc, line_base, 60) == clocks);
    const int fast = clocks_of_check(crc, line_base, 1);
    CHECK(clocks_of_check(crc, line_base, 1) == fast);
    CHECK(clocks_of_check(crc, line_base, 1) == fast);
    // The engine's beats are a round apart: 0.96 ms at 50 MHz, as docs/link.md says.
    CHECK(clocks_of_check(crc, line_base, 6) < 48'000);
  }
}

TEST_CASE("engine: events are told without places for them, up to a number") {
  EngineEvents events;
  for (int k = 0; k < 20; ++k) events.clock(true, {k, -k, 0}, false);
  CHECK(events.count == 16);
  CHECK(events.lost == 4);
  REQUIRE(events.told.size() == 20);
  CHECK(events.told.back().number == 19);
  for (int k = 0; k < 70'000; ++k) events.clock(true, {k, 0, 0}, true);
  CHECK(events.told.size() == EngineEvents::most_told);
  for (int k = 0; k < 300; ++k) events.clock(true, {k, 0, 0}, false);
  CHECK(events.lost == 255);
}
