// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_view: RTL against twin on every clock, and each tick that comes out against the words that
// went in. AXES is the number of axes. Documentation: docs/link.md
#include <Vlink_view.h>

#include <array>
#include <vector>

#include "../link/tick_words.hpp"
#include "catch.hpp"
#include "feltgate/link_view.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "sim/backends/rtl_axes_ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = LinkView<AXES>;
constexpr int kWords = LinkMap::snapshot_words;

struct Adapter {
  static void drive(Vlink_view& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, word_valid, word_slot, event_valid, addr, wdata, write);
    rtl.event_number_i = static_cast<std::uint16_t>(in.event_number);
    for (int n = 0; n < AXES; ++n) {
      set_bits(rtl.word_data_i, 32 * n, 32, in.word_data[static_cast<std::size_t>(n)]);
    }
  }
  template <class Check>
  static void compare(Check& check, const Vlink_view& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, rdata, word_valid, word_slot, event_valid, event_number);
    if (out.word_valid) FELTGATE_COMPARE(check, rtl, out, word_data);
  }
};
using Bench = LockStep<Vlink_view, Twin, Adapter>;

/// Word k of axis n in tick t, told apart from all others.
std::uint32_t word_of(int n, std::uint32_t t, int k) {
  return n == 0 ? tick_word(t, k) : tick_word(t + 0x100000u * static_cast<unsigned>(n), k);
}

struct Stimulus {
  Random random;
  TickWords words;
  bool writes = true;
  std::vector<Twin::In> first;  ///< writes at the start

  Twin::In operator()(std::int64_t clock) {
    Twin::In in;
    const auto at = static_cast<std::size_t>(clock - Bench::kFirstReset);
    if (clock >= Bench::kFirstReset && at < first.size()) in = first[at];
    const auto word =
        words.next([](std::uint32_t t, int k) { return t * 16 + static_cast<unsigned>(k); });
    in.word_valid = word.valid;
    in.word_slot = word.slot;
    for (int n = 0; n < AXES; ++n) {
      in.word_data[static_cast<std::size_t>(n)] =
          word_of(n, word.data / 16, static_cast<int>(word.data % 16));
    }
    in.event_valid = random.one_in(20);
    in.event_number = static_cast<int>(random.below(512));
    if (!writes) return in;
    in.addr = static_cast<std::uint16_t>(LinkViewMap::first + random.below(16));
    if (random.one_in(8)) in.addr ^= static_cast<std::uint16_t>(1u << random.below(16));
    in.write = random.one_in(40);
    in.wdata = random.one_in(4) ? static_cast<std::uint32_t>(random.bits()) : random.below(64);
    return in;
  }
};

}  // namespace

TEST_CASE("link_view: random words, events, choices and resets") {
  Bench bench("link_view", 1);
  bench.run(Stimulus{Random(2), TickWords(3), true, {}}, scaled_clocks(400'000), {40'000});
  bench.run(Stimulus{Random(4), TickWords(5, true), true, {}}, scaled_clocks(200'000), {40'000});
  bench.run(Stimulus{Random(6), TickWords(7, false, true), true, {}}, scaled_clocks(300'000),
            {40'000});
}

TEST_CASE("link_view: the chosen words of one tick") {
  // Each word of the view from another axis, backwards; the tick stays.
  std::vector<Twin::In> first(40);
  for (int k = 0; k < kWords; ++k) {
    Twin::In& in = first[static_cast<std::size_t>(2 * k)];
    in.addr = static_cast<std::uint16_t>(LinkViewMap::first + k);
    in.wdata = LinkViewMap::choice(k % AXES, kWords - 1 - k);
    in.write = true;
  }
  for (const bool dense : {false, true}) {
    int ticks = 0, number = -1, events = 0;
    std::uint32_t tick = 0;
    const auto look = [&](const Twin::In&, const Vlink_view& rtl, const Twin&,
                          bool) -> const char* {
      events += rtl.event_valid_o;
      if (rtl.word_valid_o == 0) return nullptr;
      number = rtl.word_slot_o == LinkMap::slots[0] ? 0 : number + 1;
      const std::uint32_t word = rtl.word_data_o;
      if (number == 0) {
        tick = 0xffffffffu;
        return nullptr;
      }
      if (number == LinkMap::N::tick) tick = word, ++ticks;
      if (number <= LinkMap::N::tick || ticks < 10) return nullptr;
      const bool same = word == word_of(number % AXES, tick, kWords - 1 - number);
      return same ? nullptr : "a word of another tick, axis or number";
    };
    Bench bench("link_view", 1);
    bench.run(Stimulus{Random(8), TickWords(9, dense), false, first}, 20'000, {}, look);
    CHECK(ticks > 400);
    CHECK(events > 500);
  }
}
