// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_view: RTL against twin on every clock, and each tick that comes out against the words that
// went in. AXES is the number of axes. Documentation: docs/link.md
#include <Vlink_view.h>

#include <array>
#include <utility>
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
    FELTGATE_DRIVE(rtl, in, last, event_valid, addr, wdata, write);
    rtl.event_number_i = static_cast<std::uint16_t>(in.event_number);
    for (int n = 0; n < AXES; ++n) {
      const auto axis = static_cast<std::size_t>(n);
      set_bits(rtl.word_valid_i, n, 1, in.word_valid[axis]);
      set_bits(rtl.word_number_i, 4 * n, 4, in.word_number[axis]);
      set_bits(rtl.word_data_i, 32 * n, 32, in.word_data[axis]);
    }
  }
  template <class Check>
  static void compare(Check& check, const Vlink_view& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, rdata, word_valid, word_number, event_valid, event_number);
    if (out.word_valid) FELTGATE_COMPARE(check, rtl, out, word_data);
  }
};
using Bench = LockStep<Vlink_view, Twin, Adapter>;

/// Word k of axis n in tick t, told apart from all others.
std::uint32_t word_of(int n, std::uint32_t t, int k) {
  return n == 0 ? tick_word(t, k) : tick_word(t + 0x100000u * static_cast<unsigned>(n), k);
}

/// Each axis sends its words by itself; the tick ends once all have.
struct Stimulus {
  Stimulus(std::uint64_t seed, bool dense, bool stray, bool with_writes,
           std::vector<Twin::In> at_first = {})
      : random(seed), writes(with_writes), first(std::move(at_first)) {
    for (std::uint64_t n = 0; n < AXES; ++n) words.emplace_back(seed + 1 + n, dense, stray);
  }
  Random random;
  std::vector<TickWords> words;
  std::uint32_t tick = 0;
  bool writes;
  std::vector<Twin::In> first;  ///< writes at the start

  Twin::In operator()(std::int64_t clock) {
    Twin::In in;
    const auto at = static_cast<std::size_t>(clock - Bench::kFirstReset);
    if (clock >= Bench::kFirstReset && at < first.size()) in = first[at];
    in.last = true;
    for (std::size_t n = 0; n < AXES; ++n) {
      if (words[n].tick() != tick) continue;
      in.last = false;
      const auto word =
          words[n].next([n](std::uint32_t t, int k) { return word_of(static_cast<int>(n), t, k); });
      in.word_valid[n] = word.valid;
      in.word_number[n] = word.number;
      in.word_data[n] = word.data;
    }
    if (in.last) ++tick;
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

// The device around it has the same reset, so no words come amid one: the runs have that at the
// start.
TEST_CASE("link_view: random words, events and choices") {
  Bench bench("link_view", 1);
  bench.run(Stimulus(2, false, false, true), scaled_clocks(400'000));
  bench.run(Stimulus(4, true, false, true), scaled_clocks(200'000));
  bench.run(Stimulus(6, false, true, true), scaled_clocks(300'000));
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
    int ticks = 0, events = 0;
    std::uint32_t tick = 0;
    const auto look = [&](const Twin::In&, const Vlink_view& rtl, const Twin&,
                          bool) -> const char* {
      events += rtl.event_valid_o;
      if (rtl.word_valid_o == 0) return nullptr;
      const int number = rtl.word_number_o;
      const std::uint32_t word = rtl.word_data_o;
      if (number == LinkMap::N::tick) tick = word, ++ticks;
      if (number == LinkMap::N::position || number == LinkMap::N::tick || ticks < 10) {
        return nullptr;
      }
      const bool same = word == word_of(number % AXES, tick, kWords - 1 - number);
      return same ? nullptr : "a word of another tick, axis or number";
    };
    Bench bench("link_view", 1);
    bench.run(Stimulus(8, dense, false, false, first), 20'000, {}, look);
    CHECK(ticks > 400);
    CHECK(events > 500);
  }
}
