// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// encoder_monitor: RTL against twin on every clock, and directed sequences of edges.
// Documentation: docs/blocks/encoder.md
#include <Vencoder_monitor.h>

#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "feltgate/encoder_monitor.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

// Twin of rtl/core/encoder_monitor.sv, clock by clock.

namespace feltgate {

class EncoderMonitor {
 public:
  struct In {
    bool at_levels = false;
    std::uint32_t tick_count = 0;
    std::uint8_t levels = 0;
    bool index_wrong = false;
    std::uint32_t count = 0, zero = 0;
    std::uint8_t step = 0;
    bool set_zero = false;
  };
  struct Out {
    bool moved = false, chatters = false, trip = false, index_trip = false, flip_trip = false;
  };

  explicit EncoderMonitor(int edge_bits = 6, bool fast = false)
      : edge_bits_(edge_bits), fast_(fast) {}

  void reset() { *this = EncoderMonitor(edge_bits_, fast_); }

  void clock(const In& in) {
    out_.trip = out_.index_trip = false;
    const bool parity = odd(in.count ^ in.zero);
    out_.flip_trip = parity != parity_q_ && in.step == 0 && !zeroed_q_;
    parity_q_ = parity;
    zeroed_q_ = in.set_zero;
    if (!in.at_levels) return;
    law_.tick(in.levels, in.tick_count, in.index_wrong, in.count);
    out_ = {law_.moved(), law_.chatters(), law_.trips(), law_.index_trips(), out_.flip_trip};
  }

  const Out& out() const { return out_; }

 private:
  static bool odd(std::uint32_t word) {
    bool ones = false;
    for (; word != 0; word &= word - 1) ones = !ones;
    return ones;
  }

  int edge_bits_;
  bool fast_;
  EncoderMonitorLaw law_{edge_bits_, fast_};
  bool parity_q_ = false, zeroed_q_ = false;
  Out out_;
};

}  // namespace feltgate

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = EncoderMonitor;

struct Adapter {
  static void drive(Vencoder_monitor& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, at_levels, tick_count, levels, index_wrong, count, zero, step,
                   set_zero);
  }
  template <class Check>
  static void compare(Check& check, const Vencoder_monitor& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, moved, chatters, trip, index_trip, flip_trip);
  }
};
using Bench = LockStep<Vencoder_monitor, Twin, Adapter>;

// The block's parameters: EdgeBits, Fast.
#ifndef FELTGATE_MONITOR
#define FELTGATE_MONITOR 6, false
#endif
Bench bench_of(std::uint64_t seed) {
  return Bench("encoder_monitor", seed, EncoderMonitor(FELTGATE_MONITOR));
}
struct Parameters {
  int edge_bits;
  bool fast;
};
constexpr Parameters kParameters{FELTGATE_MONITOR};

constexpr int kEdgeUnit = 1 << kParameters.edge_bits, kChatterUnit = 4 * kEdgeUnit;
constexpr int kEnds = Map::edge_units * kEdgeUnit;  ///< ticks without an edge that end a row
constexpr int kLasts = Map::chatter_units * kChatterUnit;

/// Ticks of two clocks: the levels in the first clock; values without effect in the second.
class Script {
 public:
  Script& ticks(int n) {
    for (; n > 0; --n) {
      list_.push_back({true, tick_, levels_, false, count_});
      law_.tick(levels_, tick_++, false, count_);
      trips_ += law_.trips();
      list_.push_back({false, tick_, static_cast<std::uint8_t>(levels_ ^ 3u), false, count_});
    }
    return *this;
  }
  /// The channels in `mask` change, and keep for `n` ticks.
  Script& edge(unsigned mask, int n = 3) {
    levels_ = static_cast<std::uint8_t>(levels_ ^ mask);
    return ticks(n);
  }
  Script& edges(int times, unsigned mask, int n = 3) {
    for (; times > 0; --times) edge(mask, n);
    return *this;
  }
  /// Motion of `n` counts within a tick.
  Script& moves(int n) {
    for (int k = 0; k < n; ++k) {
      levels_ = static_cast<std::uint8_t>(levels_ ^ (levels_ == 0 || levels_ == 3 ? 1u : 2u));
      ++count_;
    }
    return ticks(1);
  }
  /// To the tick after the one in which a unit ends.
  Script& align(int unit) {
    while ((tick_ & static_cast<unsigned>(unit - 1)) != 1) ticks(1);
    return *this;
  }
  bool chatters() const { return law_.chatters(); }
  bool moved() const { return law_.moved(); }
  int trips() const { return trips_; }
  void play() const {
    Bench bench = bench_of(1);
    std::vector<Twin::In> list(8);
    list.insert(list.end(), list_.begin(), list_.end());
    bench.run_list(list);
  }

 private:
  EncoderMonitorLaw law_{FELTGATE_MONITOR};
  std::uint32_t tick_ = 1, count_ = 0;
  std::uint8_t levels_ = 0;
  int trips_ = 0;
  std::vector<Twin::In> list_;
};

constexpr unsigned kA = 1, kB = 2, kBoth = 3;

/// Motion, chatter, dead and shorted channels, and rest, in ticks of one to four clocks.
struct Stimulus {
  Random random;
  Twin::In in{};
  int clock = 0, period = 1, left = 0, way = 0, kind = 0, mean = 1;

  Twin::In operator()(std::int64_t) {
    in.at_levels = clock == 0;
    if (clock == 0) tick();
    if (random.one_in(50)) in.index_wrong = !in.index_wrong;
    count();
    clock = clock + 1 >= period ? 0 : clock + 1;
    return in;
  }
  /// Steps, new zeros, and bits of both that flip by themselves.
  void count() {
    if (in.set_zero) in.zero = in.count - in.step;
    in.step = random.one_in(5) ? (random.coin() ? 1 : 3) : 0;
    in.count += in.step == 3 ? ~0u : in.step;
    in.set_zero = random.one_in(20);
    if (random.one_in(40)) in.count ^= 1u << random.below(32);
    if (random.one_in(40)) in.zero ^= 1u << random.below(32);
    if (random.one_in(2000)) in.count = static_cast<std::uint32_t>(random.bits());
  }
  void tick() {
    ++in.tick_count;
    if (random.one_in(3000)) in.tick_count = static_cast<std::uint32_t>(random.bits());
    period = 1 + static_cast<int>(random.below(3));
    if (left-- <= 0) {
      left = static_cast<int>(random.below(12000));
      kind = static_cast<int>(random.below(6));
      mean = 1 << random.below(11);
    }
    if (!random.one_in(static_cast<std::uint32_t>(mean))) return;
    const bool same = (in.levels == 0) || (in.levels == 3);
    switch (kind) {
      case 0:  // up and down
        if (random.one_in(40)) way ^= 1;
        return flip(same != (way != 0) ? kA : kB);
      case 1:
        return flip(kA);
      case 2:
        return flip(kB);
      case 3:
        return flip(random.one_in(60) ? kA : kBoth);
      case 4:
        return flip(random.one_in(30) ? kB : kA);
      default:
        return flip(static_cast<unsigned>(random.below(4)));
    }
  }
  void flip(unsigned mask) { in.levels = static_cast<std::uint8_t>(in.levels ^ mask); }
};

}  // namespace

TEST_CASE("encoder_monitor: random edges, ticks and resets") {
  Bench bench = bench_of(1);
  bench.run(Stimulus{Random(2)}, scaled_clocks(6000000), {500000});
}

TEST_CASE("encoder_monitor: motion is no chatter, either way and at any speed") {
  Script s;
  for (const int ticks : {1, 3, 700}) {
    for (int k = 0; k < 50; ++k) s.edge(kA, ticks).edge(kB, ticks);
    s.edge(kB, ticks);  // turns
    for (int k = 0; k < 50; ++k) s.edge(kA, ticks).edge(kB, ticks);
  }
  REQUIRE(s.trips() == 0);
  s.play();
}

TEST_CASE("encoder_monitor: motion of several counts in a tick, where the design has it") {
  for (const int counts : {2, 3, 4, 7, 16}) {
    Script s;
    for (int k = 0; k < 100; ++k) {
      s.moves(counts);
      if (kParameters.fast) REQUIRE((s.moved() && !s.chatters()));
    }
    // An encoder that is read less often than it moves looks shorted to a slow one.
    REQUIRE((s.trips() > 0) == (!kParameters.fast && counts % 4 == 2));
    s.play();
  }
}

TEST_CASE("encoder_monitor: a row of edges of one channel, and the first that is too many") {
  for (const unsigned dead : {kA, kB}) {
    Script s;
    s.edge(kBoth ^ dead).edge(dead).edge(kBoth ^ dead).edge(dead);  // moves
    s.edges(Map::one_channel_edges - 1, dead);
    REQUIRE_FALSE(s.chatters());
    s.edge(dead);
    REQUIRE(s.chatters());
    s.edges(Map::dead_channel_edges - Map::one_channel_edges - 1, dead);
    REQUIRE(s.trips() == 0);
    s.edge(dead);
    REQUIRE(s.trips() == 1);
    REQUIRE_FALSE(s.chatters());
    s.edges(Map::dead_channel_edges - 1, dead);  // and once more
    REQUIRE(s.trips() == 1);
    s.edge(dead);
    REQUIRE(s.trips() == 2);
    s.play();
  }
}

TEST_CASE("encoder_monitor: chatter that lasts is a dead channel, chatter that ends is not") {
  constexpr int kSlow = kLasts / 5;  // fewer edges than trip by their number
  static_assert(kSlow < kEnds);
  for (const int run : {0, 1, 2, 3}) {
    const bool goes_on = run < 2;
    const unsigned other = (run & 1) == 0 ? kA : kB;  // than the dead one
    Script s;
    s.edge(kBoth ^ other)
        .edges(Map::one_channel_edges, other, 10)
        .align(kChatterUnit)
        .edge(other, 1);
    for (int k = 0; k < 4; ++k) s.edge(other, kSlow);
    REQUIRE(s.chatters());
    REQUIRE(s.trips() == 0);
    if (goes_on) s.edge(other, kSlow).edge(other, kSlow);
    if (!goes_on) s.ticks(2 * kLasts);
    REQUIRE_FALSE(s.chatters());
    REQUIRE(s.trips() == (goes_on ? 1 : 0));
    s.play();
  }
}

TEST_CASE("encoder_monitor: an edge of the other channel saves up to the last tick") {
  int saved = 0;
  for (int early = -4; early <= 4; ++early) {
    Script s;
    s.edge(kB).edges(Map::one_channel_edges, kA, 1).align(kChatterUnit);
    for (int k = 0; k < 4; ++k) s.edge(kA, kLasts / 5);
    s.edge(kA, kLasts - 4 * (kLasts / 5) - early).edge(kB);
    REQUIRE_FALSE(s.chatters());
    REQUIRE(s.trips() == (early < 0 ? 1 : 0));
    saved += early >= 0;
    s.play();
  }
  REQUIRE(saved == 5);
}

TEST_CASE("encoder_monitor: edges of both in one tick go on with a row of either channel") {
  Script s;
  s.edge(kB).edge(kA);
  for (int k = 0; k < Map::dead_channel_edges / 2 - 1; ++k) s.edge(kBoth).edge(kA);
  REQUIRE(s.trips() == 0);
  s.edge(kBoth).edge(kA);
  REQUIRE(s.trips() == 1);
  s.play();
}

TEST_CASE("encoder_monitor: the last tick of a pause") {
  for (const int pause : {kEnds - 1, kEnds}) {
    Script s;
    s.edge(kB).edge(kA).edges(Map::one_channel_edges - 2, kA).align(kEdgeUnit);
    s.edge(kA, pause).edge(kA);
    REQUIRE(s.chatters() == (pause < kEnds));
    s.play();
  }
}

TEST_CASE("encoder_monitor: after a reset a row begins with its first edge, unless that is late") {
  for (const int rest : {kEnds - 1, kEnds}) {
    Script s;
    s.ticks(rest).edges(Map::one_channel_edges, kA);
    REQUIRE(s.chatters() == (rest < kEnds));
    s.play();
  }
}

TEST_CASE("encoder_monitor: the tick in which chatter has lasted, with and without an edge") {
  constexpr int kSlow = kLasts / 5;
  for (const unsigned channel : {kA, kB}) {
    for (const unsigned edge : {0u, channel, kBoth, kBoth ^ channel}) {
      for (const bool late : {false, true}) {
        Script s;
        s.edge(kBoth ^ channel).edges(Map::one_channel_edges, channel);
        s.align(kChatterUnit).edges(4, channel, kSlow);
        if (late) s.ticks(kSlow);
        if (!late) s.edge(channel, kSlow);
        REQUIRE(s.chatters());
        s.edge(edge, 1);
        REQUIRE_FALSE(s.chatters());
        REQUIRE(s.trips() == (!late && edge != (kBoth ^ channel) ? 1 : 0));
        s.ticks(2);
        s.play();
      }
    }
  }
}

TEST_CASE("encoder_monitor: resets in any state") {
  Bench bench = bench_of(2);
  bench.run(Stimulus{Random(3)}, scaled_clocks(600000), {300});
}
