// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_capture: every bit of what is set, compared and counted. Documentation:
// docs/link.md
#include <array>
#include <cstddef>
#include <cstdint>

#include "capture_session.hpp"
#include "random.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

std::uint32_t read_back(std::uint16_t addr, std::uint32_t written) {
  std::vector<CaptureTwin::In> list(20);
  list[5].addr = addr;
  list[5].wdata = written;
  list[5].write = true;
  for (std::size_t k = 6; k < list.size(); ++k) list[k].addr = addr;
  CaptureBench bench("link_capture", 1);
  return bench.run_list(list).out().rdata;
}

}  // namespace

TEST_CASE("link_capture: what is written is read back, as much of it as there is") {
  struct Case {
    std::uint16_t addr;
    std::uint32_t written, read;
  };
  for (const Case& t : {Case{A::capture_words, 0xffffffffu, 0xfff},
                        {A::capture_pre, kRows - 1, kRows - 1},
                        {A::capture_pre, kRows, kRows - 1},
                        {A::capture_pre, 0x80000000u, kRows - 1},
                        {A::capture_period, 0xffff, 0xffff},
                        {A::capture_period, 0x10000, 0xffff},
                        {A::trigger_word, 11, 11},
                        {A::trigger_word, 0x100, 15},
                        {A::trigger_mode, 15, kEvents ? 7 : 3},
                        {A::trigger_level, 0x87654321u, 0x87654321u},
                        {A::capture_state, 3, 0},
                        {A::capture_control, 0, 0},
                        {0x1010, 7, 0},
                        {A::capture_first, 3, 0}}) {
    REQUIRE(read_back(t.addr, t.written) == t.read);
  }
  for (int bit = 16; bit < 32; ++bit) {  // of one bit beyond what there is
    REQUIRE(read_back(A::capture_pre, 1u << bit) == kRows - 1);
    REQUIRE(read_back(A::capture_period, 1u << bit) == 0xffff);
  }
}

TEST_CASE("link_capture: a long period, counted in all its bits") {
  for (const std::uint32_t period : {0x1555u, 0x0aabu}) {
    auto s = session({kTick, 0, period}, 2 * period + 5, tick_word);
    const auto c = s.set(A::capture_control, kStart | kTrigger)
                       .at(2 * period + 4, 27, A::capture_control, kAbort)
                       .play();
    REQUIRE(c.rows == 3);
    s.check(c, kTick, 0, period);
  }
}

TEST_CASE("link_capture: each bit triggers where it rises, whatever the others do") {
  for (int bit = 0; bit < 32; ++bit) {
    for (const std::uint32_t others : {0u, 0xffffffffu, 0x5a5a5a5au}) {
      const std::uint32_t one = 1u << bit, tick = 11;
      auto s = session({kTick, 4}, tick + kRows + 3, with(N::tau_ref, [&](std::uint32_t t) {
                         // Before its tick the others come and go beside it, then it does.
                         const std::uint32_t all = t % 2 == 0 ? others : ~others;
                         return t < tick ? all & ~one : all | one;
                       }));
      const auto c =
          s.trigger(N::tau_ref, LinkMap::trigger_bit, one).set(A::capture_control, kStart).play();
      INFO("bit " << bit << ", others " << others);
      REQUIRE(c.state == kDone);
      s.check(c, kTick, tick - 4);
    }
    // Set all along it never rises.
    auto high = session({kTick, 4}, 20, with(N::tau_ref, [&](std::uint32_t t) {
                          return t % 2 == 0 ? 0xffffffffu : 1u << bit;
                        }));
    const auto c = high.trigger(N::tau_ref, LinkMap::trigger_bit, 1u << bit)
                       .set(A::capture_control, kStart)
                       .play();
    REQUIRE(c.state == kWaits);
    if (kRows > 16) break;
  }
}

TEST_CASE("link_capture: of more words than a row holds it holds the first, in a full ring too") {
  constexpr std::uint32_t all = 0xfff, tick = kRows + 9;
  auto s = session({all, 4}, tick + kRows + 3, rises_in(tick));
  const auto c = s.trigger(N::position, 1, 0).set(A::capture_control, kStart).play();
  REQUIRE(c.state == kDone);
  REQUIRE(c.rows == kRows);
  s.check(c, all, tick - 4);
}

TEST_CASE("link_capture: a tick at once is one word by word") {
  Random random(6);
  CaptureTwin at_once, by_words;
  std::array<std::int64_t, 5> states{};
  for (int t = 0; t < 20'000; ++t) {
    CaptureTwin::In in;
    if (random.one_in(3)) {
      in.write = true;
      in.addr = static_cast<std::uint16_t>(A::capture_control + random.below(10));
      in.wdata = in.addr == A::capture_words ? kTick | 1u << N::position : random.below(8);
    }
    for (CaptureTwin* twin : {&at_once, &by_words}) {
      twin->clock(in);
      twin->clock({});
    }
    std::array<std::uint32_t, LinkMap::snapshot_words> words{};
    for (std::uint32_t& w : words) w = random.below(16) - 8;
    if (kEvents && random.one_in(5)) {  // in the clock before the tick, or told of after it
      CaptureTwin::In event;
      event.event_valid = true;
      event.event_number = static_cast<int>(random.below(4));
      by_words.clock(event);
      random.coin() ? at_once.clock(event) : at_once.event(event.event_number);
    }
    at_once.tick(words);
    for (std::size_t k = 0; k < words.size(); ++k) {
      CaptureTwin::In word;
      word.word_valid = true;
      word.word_slot = static_cast<std::uint8_t>(LinkMap::slots[k]);
      word.word_data = words[k];
      by_words.clock(word);
    }
    const int reads = random.one_in(4) ? 20 : 1;
    for (int k = 0; k < reads; ++k) {
      CaptureTwin::In read;
      read.addr =
          static_cast<std::uint16_t>(random.one_in(3) ? LinkMap::memory + random.below(kRows * 8)
                                                      : A::capture_control + random.below(11));
      at_once.clock(read);
      by_words.clock(read);
      REQUIRE(at_once.state() == by_words.state());
      // A word comes three clocks after its address, and before they were not at the same clock.
      if (k >= 3) REQUIRE(at_once.out().rdata == by_words.out().rdata);
    }
    ++states[static_cast<std::size_t>(at_once.state())];
  }
  if (kRows > 16) return;  // a long ring seldom fills
  for (const std::int64_t n : states) CHECK(n > 100);
}

// link_capture triggered by an event of a law.

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
