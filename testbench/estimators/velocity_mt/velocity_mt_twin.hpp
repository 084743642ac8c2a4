// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/estimators/velocity_mt.sv, clock by clock. Documentation:
// docs/blocks/velocity_mt.md
#pragma once

#include <array>
#include <cstdint>

#include "../lowpass/lowpass_twin.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/velocity_mt.hpp"

namespace feltgate {

/// Clocked twin; the parameters are those of the RTL.
template <class D, int Window = 0, int Doublings = 0, int Counts = 4096, int StampBits = 26>
class VelocityMt {
 public:
  using Law = SpanLaw<D, Fixed>;
  using A1 = fixed_of<D::P::velocity_a1.key()>;
  static constexpr int window = Window, doublings = Doublings, counts = Counts;
  static constexpr int stamp_bits = StampBits;
  static constexpr int magnitude_bits = Law::format.width() - 1;
  /// Clocks from a sample to the value that the division gives.
  static constexpr int division_clocks = magnitude_bits + 3;

  struct In {
    std::uint64_t wave = 0;
    std::int16_t travel = 0;   ///< live
    std::int64_t product = 0;  ///< in T::velocity: a1 * operand
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t velocity = 0;
    bool saturated = false;
  };

  void reset() {
    filter_.reset();
    live_ = {};
    task_ = {};
    magnitude_ = raw_ = 0;
    negative_ = limited_ = follow_ = false;
    out_ = {};
  }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    filter_.clock({at(T::velocity_difference), at(T::velocity), follow_, raw_, in.product});
    if (at(T::velocity_raw)) {
      raw_ = negative_ ? -magnitude_ : magnitude_;
      follow_ = live_.still;
      out_.saturated = limited_;
    }
    if (task_.clocks_left > 0) divide();
    if (at(T::sample)) sample();
    edge(in.travel, at(T::sample));
    out_.operand = filter_.out().operand;
    out_.velocity = filter_.out().y;
  }

  const Out& out() const { return out_; }
  /// rad/s, raw: before the low-pass.
  std::int64_t raw() const { return raw_; }

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
  /// A division under way.
  struct Task {
    std::uint32_t span = 0;
    int halves = 0, clocks_left = 0;
    bool value = false, zero = false, negative = false;
  };

  static bool aged(std::uint32_t age) { return age >> (StampBits - 3) != 0; }

  void edge(std::int16_t travel, bool sampled) {
    const auto place = static_cast<std::uint16_t>(travel) % kPlaces;
    const unsigned change = (place - live_.travel) & 3U;
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
      live_.stamps[place] = live_.newest = live_.now;
      live_.up = up;
      live_.resting = false;
      live_.fresh = true;
    } else if (change == 2) {
      live_.resting = true;
      live_.fresh = false;
    } else if (rests) {
      live_.resting = true;
    }
    live_.travel = place;
    live_.now = (live_.now + 1) & kStampMask;
  }

  void sample() {
    const std::uint32_t age = (live_.now - live_.newest) & kStampMask;
    const unsigned counted = live_.run < 4 ? live_.run : 4U << live_.doublings;
    const unsigned oldest = (live_.up ? live_.travel - counted : live_.travel + counted) % kPlaces;
    task_.value = live_.fresh;
    task_.zero = live_.fresh ? live_.run == 0 : live_.resting || aged(age);
    task_.negative = !live_.up;
    task_.halves = live_.fresh ? static_cast<int>(2 * counted) : 3;
    task_.span = live_.fresh ? (live_.newest - live_.stamps[oldest]) & kStampMask : age;
    task_.clocks_left = division_clocks - 1;
  }

  void divide() {
    --task_.clocks_left;
    // The span is known two clocks after the sample.
    if (task_.clocks_left == division_clocks - 3 && task_.value && !task_.zero) adapt();
    if (task_.clocks_left > 0) return;
    if (task_.value) negative_ = task_.negative;
    if (task_.zero) {
      magnitude_ = 0;
      limited_ = false;
      return;
    }
    bool limited = false;
    const auto quotient =
        static_cast<std::int64_t>(Law::magnitude(Counts, task_.halves, task_.span, &limited).raw());
    if (!task_.value && (limited || quotient >= magnitude_)) return;
    magnitude_ = quotient;
    limited_ = limited;
  }

  void adapt() {
    if (task_.span < Window && live_.doublings < Doublings && live_.run >= 8U << live_.doublings) {
      ++live_.doublings;
    } else if (task_.span >= 2 * Window && live_.doublings > 0) {
      --live_.doublings;
    }
  }

  Lowpass<D::f.velocity.key(), D::f.velocity_difference.key(), D::P::velocity_a1.key(), D::rounding>
      filter_;
  Live live_;
  Task task_;
  std::int64_t magnitude_ = 0, raw_ = 0;
  bool negative_ = false, limited_ = false, follow_ = false;
  Out out_;
};

}  // namespace feltgate
