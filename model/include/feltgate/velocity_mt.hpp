// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/estimators/velocity_mt.sv: M/T velocity over whole encoder cycles, counts between
// two edges over the clocks between them; and the block before its low-pass, clock by clock.
// Documentation: docs/blocks/velocity.md
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// What a span of clocks is as a velocity, in number policy N, for design D with `counts` in a
/// turn.
template <class D, class N>
struct SpanLaw {
  static constexpr Format format = D::f.velocity;
  using Velocity = typename N::template num<format.key()>;
  static constexpr std::int64_t largest = (std::int64_t{1} << (format.width() - 1)) - 1;

  /// rad/s of half a count in a clock, times 2^F, truncated.
  static constexpr std::int64_t half(int counts) {
    constexpr int128_t pi = 0x6487ed5110b4611a;  // 2^61
    return static_cast<std::int64_t>(
        ((pi * static_cast<int128_t>(D::clock_hz)) << format.fraction) /
        (static_cast<int128_t>(counts) << 61));
  }

  /// |velocity| of `halves` half counts in `clocks`; truncated and limited in fixed point, exact in
  /// real arithmetic. Precondition: clocks is not 0.
  static constexpr Velocity magnitude(int counts, int halves, std::int64_t clocks, bool* limited) {
    if constexpr (N::is_fixed) {
      const std::int64_t whole = half(counts) * halves / clocks;
      *limited = whole > largest;
      return N::template from_raw<format.key()>(*limited ? largest : whole);
    } else {
      (void)limited;
      const auto pi = static_cast<Velocity>(3.14159265358979323846264338327950288L);
      return pi * static_cast<Velocity>(halves) * static_cast<Velocity>(D::clock_hz) /
             (static_cast<Velocity>(counts) * static_cast<Velocity>(clocks));
    }
  }
};

/// What the block does before its low-pass; the parameters are those of the RTL. Raw values are in
/// the velocity's format.
template <class D, int Window, int Doublings, int Counts, int StampBits = 26>
class SpanMeter {
 public:
  using Law = SpanLaw<D, Fixed>;
  static constexpr int window = Window, doublings = Doublings, counts = Counts;
  static constexpr int stamp_bits = StampBits;
  static constexpr int magnitude_bits = Law::format.width() - 1;
  /// Clocks from a sample to the value that the RTL's division gives.
  static constexpr int division_clocks = magnitude_bits + 3;

  /// One clock. `travel` is live; `sample` and `velocity_raw` are the strobes of these steps.
  void clock(std::int16_t travel, bool sample, bool velocity_raw) {
    if (velocity_raw) {
      raw_ = negative_ ? -magnitude_ : magnitude_;
      still_ = live_.still;
      limited_ = next_limited_;
      // Nobody sees the quotient before the next one of these clocks.
      divide();
    }
    if (sample) begin();
    edge(travel, sample);
  }

  /// The clocks [from, to) of a tick, with the travel held.
  void pass(int from, int to, std::int16_t travel) {
    constexpr int sample = Map::first_wave_clock + Map::T::sample;
    constexpr int velocity_raw = Map::first_wave_clock + Map::T::velocity_raw;
    // Of the span that begin() took the RTL's next doublings are known in that clock.
    static_assert(velocity_raw == sample + 2);
    while (from < to) {
      int next = to;
      for (const int strobe : {sample, velocity_raw}) {
        if (from <= strobe) next = std::min(next, strobe);
      }
      if (next == from || place(travel) != live_.travel) {
        clock(travel, from == sample, from == velocity_raw);
        ++from;
      } else {
        live_.now = (live_.now + static_cast<std::uint32_t>(next - from)) & kStampMask;
        from = next;
      }
    }
  }

  /// Input of the low-pass, taken in the last velocity_raw.
  std::int64_t raw() const { return raw_; }
  bool limited() const { return limited_; }
  /// Whether the low-pass, whose output is `velocity`, is left out: at rest, if the step to 0 is
  /// none that trips velocity_jump.
  bool follows(std::int64_t velocity) const {
    constexpr int weight = Law::format.width() + D::coefficient_bits - D::P::velocity_a1.fraction;
    constexpr bool checked = weight >= 0 && weight <= Law::format.width() - 2;
    if constexpr (!checked)
      return still_;
    else
      return still_ && (velocity >> weight == 0 || velocity >> weight == -1);
  }
  /// The larger of raw() and the next one.
  std::int64_t largest() const {
    const std::int64_t now = raw_ < 0 ? -raw_ : raw_;
    return std::max(now, magnitude_);
  }

 private:
  static constexpr std::uint32_t kStampMask =
      static_cast<std::uint32_t>((std::int64_t{1} << StampBits) - 1);
  static constexpr unsigned kPlaces = 8U << Doublings, kLongest = 4U << Doublings;

  /// What the edges have told; times in clocks.
  struct Live {
    std::array<std::uint32_t, kPlaces> stamps{};
    std::uint32_t now = 0, newest = 0;
    unsigned travel = 0, run = 0;
    int doublings = 0;
    bool up = false, resting = true, still = false, fresh = false;
  };
  /// What the division works on.
  struct Task {
    std::uint32_t span = 0;
    int halves = 0;
    bool begun = false, value = false, zero = false, negative = false;
  };

  static bool aged(std::uint32_t age) { return age >> (StampBits - 3) != 0; }
  static unsigned place(std::int16_t travel) {
    return static_cast<std::uint16_t>(travel) % kPlaces;
  }

  void edge(std::int16_t travel, bool sampled) {
    const unsigned to = place(travel), change = (to - live_.travel) & 3U;
    const bool moved = change == 1 || change == 3, up = change == 1;
    const std::uint32_t age = (live_.now - live_.newest) & kStampMask;
    const bool rests = sampled && !live_.fresh && aged(age);
    if (sampled && live_.resting && age >> (StampBits - 1) != 0) live_.still = true;
    if (moved) live_.still = false;
    if (sampled) live_.fresh = false;
    if (moved) {
      if (live_.resting || up != live_.up) {
        live_.run = 0;
        live_.doublings = 0;
      } else if (live_.run < kLongest) {
        ++live_.run;
      }
      live_.stamps[to] = live_.newest = live_.now;
      live_.up = up;
      live_.resting = false;
      live_.fresh = true;
    } else if (change == 2) {
      live_.resting = true;
      live_.fresh = false;
    } else if (rests) {
      live_.resting = true;
    }
    live_.travel = to;
    live_.now = (live_.now + 1) & kStampMask;
  }

  /// The sample: what is to be divided by what.
  void begin() {
    const std::uint32_t age = (live_.now - live_.newest) & kStampMask;
    const unsigned counted = live_.run < 4 ? live_.run : 4U << live_.doublings;
    const unsigned oldest = (live_.up ? live_.travel - counted : live_.travel + counted) % kPlaces;
    task_.begun = true;
    task_.value = live_.fresh;
    task_.zero = live_.fresh ? live_.run == 0 : live_.resting || aged(age);
    task_.negative = !live_.up;
    task_.halves = live_.fresh ? static_cast<int>(2 * counted) : 3;
    task_.span = live_.fresh ? (live_.newest - live_.stamps[oldest]) & kStampMask : age;
  }

  void divide() {
    if (!task_.begun) return;
    if (task_.value && !task_.zero) adapt();
    if (task_.value) negative_ = task_.negative;
    if (task_.zero) {
      magnitude_ = 0;
      next_limited_ = false;
      return;
    }
    bool limited = false;
    const auto quotient =
        static_cast<std::int64_t>(Law::magnitude(Counts, task_.halves, task_.span, &limited).raw());
    if (!task_.value && (limited || quotient >= magnitude_)) return;
    magnitude_ = quotient;
    next_limited_ = limited;
  }

  void adapt() {
    if (task_.span < Window && live_.doublings < Doublings && live_.run >= 8U << live_.doublings) {
      ++live_.doublings;
    } else if (task_.span >= 2 * Window && live_.doublings > 0) {
      --live_.doublings;
    }
  }

  Live live_;
  Task task_;
  std::int64_t magnitude_ = 0, raw_ = 0;
  bool negative_ = false, next_limited_ = false, limited_ = false, still_ = false;
};

/// Whether the core of design D has the M/T estimator.
template <class D>
constexpr bool measures_spans = D::mt_counts != 0;

/// The meter of design D; a design of the N-method has none.
template <class D, bool = measures_spans<D>>
struct MeterOf {
  using type = SpanMeter<D, D::mt_window, D::mt_doublings, D::mt_counts>;
};
template <class D>
struct MeterOf<D, false> {
  struct type {};
};

}  // namespace feltgate
