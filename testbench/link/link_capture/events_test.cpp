// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_capture triggered by an event of a law. Documentation: docs/link.md
#include "capture_session.hpp"

using namespace feltgate;
using namespace feltgate::test;

TEST_CASE("link_capture: an event triggers in its tick, whichever clock it comes in") {
  if (!kEvents) return;
  for (int clock = 0; clock < kTickClocks; ++clock) {
    const std::uint32_t tick = 9 + (clock > kLastWordClock ? 1u : 0u);
    auto s = session({kTick, 4}, 9 + kRows + 9, tick_word);
    const auto c = s.trigger(0, LinkMap::trigger_event, 3)
                       .set(A::capture_control, kStart)
                       .event(9, clock, 3)
                       .play();
    INFO("clock " << clock);
    REQUIRE(c.state == kDone);
    s.check(c, kTick, tick - 4);
  }
}

TEST_CASE("link_capture: an event of the number, or of any") {
  constexpr std::uint32_t any = LinkMap::any_event;
  struct Case {
    std::uint32_t mode, level;
    int number;
    bool fires;
  };
  for (const Case& t : {Case{4, 0, 0, true},
                        {4, 0, 1, false},
                        {4, 0, 256, false},
                        {4, 511, 511, true},
                        {4, 511, 510, false},
                        {4, 256, 256, true},
                        {4, 256, 0, false},
                        {4, any, 0, true},
                        {4, any, 511, true},
                        {4, any | 7, 300, true},
                        {4, 0xfffffc00u | 5, 5, true},
                        {4, 0xfffffc00u | 5, 4, false},
                        {12, 5, 5, true},
                        {0, 0, 0, false},
                        {1, 0, 0, false},
                        {2, 0, 0, false},
                        {3, 0, 0, false},
                        {5, 0, 0, false},
                        {6, 0, 0, false},
                        {7, 0, 0, false}}) {
    // Nothing else that could trigger: the word of the trigger is the status, which stays 0.
    auto s = session({kTick, 4}, 11 + kRows + 3, with(N::status, [](std::uint32_t) { return 0; }));
    const auto c = s.trigger(N::status, static_cast<int>(t.mode), t.level)
                       .set(A::capture_control, kStart)
                       .event(11, 6, t.number)
                       .play();
    INFO("mode " << t.mode << ", level " << t.level << ", number " << t.number);
    REQUIRE((c.state == kDone) == (t.fires && kEvents));
    if (c.state == kDone) s.check(c, kTick, 7);
  }
}

TEST_CASE("link_capture: an event that came before it was asked for is none") {
  // Before the rows before it are there; before the start; before another number was set.
  for (const int clock : {0, 1, 2, 13, kLastWordClock, kLastWordClock + 1, kTickClocks - 1}) {
    auto fill = session({kTick, 6}, 30, tick_word);
    fill.trigger(0, LinkMap::trigger_event, 3).set(A::capture_control, kStart);
    for (std::size_t tick = 0; tick < 5; ++tick) fill.event(tick, clock, 3);
    if (clock <= kLastWordClock) fill.event(5, clock, 3);
    REQUIRE(fill.play().state == kWaits);
    auto start = session({kTick, 0}, 30, tick_word);
    start.trigger(0, LinkMap::trigger_event, 3).event(5, std::max(clock - 1, 0), 3);
    REQUIRE(start.at(5, clock, A::capture_control, kStart).play().state == kWaits);
    auto other = session({kTick, 0}, 30, tick_word);
    other.trigger(0, LinkMap::trigger_event, 3).set(A::capture_control, kStart);
    other.at(5, clock, A::trigger_level, 4).event(5, clock, 3);
    REQUIRE(other.play().state == kWaits);
  }
}
