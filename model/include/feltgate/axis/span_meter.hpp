// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/mt/span_meter.sv: counts between two edges of one kind over the clocks
// between them, over whole encoder cycles. docs/blocks/velocity.md
#pragma once

#include <algorithm>

#include "feltgate/axis/design.hpp"
#include "feltgate/axis/tick_counter.hpp"
#include "feltgate/fixed.hpp"

namespace feltgate::axis {

class SpanMeter {
 public:
  /// All but the times of the edges, so that a copy of it is small.
  struct State {
    std::int64_t raw = 0;    ///< of the tick, as the next
    bool saturated = false;  ///< raw is too small
    bool still = false;

    // Edges
    std::uint32_t now = 0, newest = 0;  ///< clocks
    unsigned place = 0, run = 0;        ///< run: counts without a turn, a rest or a jump
    bool up = false, resting = true, fresh = false;
    // Division, from the sample on
    int doublings = 0, since = 2;
    unsigned halves = 0;
    std::uint32_t span = 0;
    bool measured = false, zero = false, down = false;
    std::int64_t size = 0;
    bool negative = false, too_large = false;
  };

  explicit SpanMeter(const Design& d, int bits_of_stamps = 26)
      : used(d["MT_COUNTS"] != 0),
        window(static_cast<std::uint32_t>(d["MT_WINDOW"])),
        doublings(d["MT_DOUBLINGS"]),
        stamp_bits(bits_of_stamps),
        places(8U << doublings),
        largest((std::int64_t{1} << (d["VELOCITY_W"] - 1)) - 1),
        half(used ? of_half_a_count(d) : 0) {}

  /// A clock; `stamps`: when the edge to each of `places` counts came.
  void clock(State& s, std::uint32_t* stamps, std::int16_t travel, bool sample) const {
    if (++s.since == 2) divide(s);
    if (sample) begin(s, stamps);
    edge(s, stamps, static_cast<std::uint16_t>(travel) % places, sample);
    s.now = clocks(s.now + 1);
  }
  /// A tick with the travel held.
  void tick(State& s, std::uint32_t* stamps, std::int16_t travel, int clocks_per_tick) const {
    constexpr int sampled = TickCounter::sample_clock, divided = sampled + 2;
    for (int c = 0; c <= divided; ++c) clock(s, stamps, travel, c == sampled);
    s.since += clocks_per_tick - divided - 1;
    s.now = clocks(s.now + static_cast<std::uint32_t>(clocks_per_tick - divided - 1));
  }

  bool used;
  std::uint32_t window;
  int doublings, stamp_bits;
  unsigned places;

 private:
  /// Velocity of half a count in a clock.
  static std::int64_t of_half_a_count(const Design& d) {
    constexpr int128_t pi = 0x6487ed5110b4611a;  // 2^61
    const auto hz = static_cast<int128_t>(d.wide("CLOCK_HZ"));
    const auto counts = static_cast<int128_t>(d.wide("MT_COUNTS"));
    return static_cast<std::int64_t>((pi * hz << d["VELOCITY_F"]) / (counts << 61));
  }
  std::uint32_t clocks(std::uint32_t time) const { return low_bits(time, stamp_bits); }

  void begin(State& s, const std::uint32_t* stamps) const {
    s.raw = s.negative ? -s.size : s.size;
    s.saturated = s.too_large;
    s.since = 0;
    const std::uint32_t age = clocks(s.now - s.newest);
    const unsigned counts = s.run < 4 ? s.run : 4U << s.doublings;
    const unsigned oldest = (s.up ? s.place - counts : s.place + counts) % places;
    s.measured = s.fresh;
    s.zero = s.fresh ? s.run == 0 : s.resting || rests(age);
    s.down = !s.up;
    s.halves = s.fresh ? 2 * counts : 3;
    s.span = s.fresh ? clocks(s.newest - stamps[oldest]) : age;
  }
  /// The RTL's quotient is there 32 clocks later; nobody sees it before the next sample.
  void divide(State& s) const {
    if (s.measured) s.negative = s.down;
    if (s.zero) {
      s.size = 0;
      s.too_large = false;
      return;
    }
    const std::int64_t speed = s.span == 0 ? largest + 1 : half * s.halves / s.span;
    if (s.measured || speed < s.size) {
      s.size = std::min(speed, largest);
      s.too_large = speed > largest;
    }
    if (!s.measured) return;
    if (s.span < window && s.doublings != doublings && s.run >= 8U << s.doublings) {
      ++s.doublings;
    } else if (s.span >= 2 * window && s.doublings != 0) {
      --s.doublings;
    }
  }
  void edge(State& s, std::uint32_t* stamps, unsigned place, bool sample) const {
    const unsigned change = (place - s.place) & 3U;
    const bool moved = change == 1 || change == 3, up = change == 1, jumped = change == 2;
    const std::uint32_t age = clocks(s.now - s.newest);
    s.still = !moved && (s.still || (sample && s.resting && age >> (stamp_bits - 1) != 0));
    if (moved) {
      if (s.resting || up != s.up) {
        s.run = 0;
        s.doublings = 0;
      } else if (s.run != 4U << doublings) {
        ++s.run;
      }
      stamps[place] = s.newest = s.now;
      s.up = up;
      s.resting = false;
    } else if (jumped || (sample && !s.fresh && rests(age))) {
      s.resting = true;
    }
    s.fresh = moved || (s.fresh && !sample && !jumped);
    s.place = place;
  }
  bool rests(std::uint32_t age) const { return age >> (stamp_bits - 3) != 0; }

  std::int64_t largest, half;
};

}  // namespace feltgate::axis
