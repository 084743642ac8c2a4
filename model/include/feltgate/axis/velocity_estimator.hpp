// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws of rtl/core/velocity_estimator.sv and travel_window.sv:
//   raw = gain * counts of the last M1 ticks, saturated;  velocity += a1 * (raw - velocity)
// docs/blocks/velocity.md
#pragma once

#include "feltgate/axis/span_meter.hpp"
#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

/// Counts of the last `ticks` ticks; until so many have passed, the counts since the reset. The
/// line is not in the block, so that a copy of the block is small.
class TravelWindow {
 public:
  std::int16_t counts(std::int16_t travel) const {
    return static_cast<std::int16_t>(travel - oldest_);
  }
  void tick(std::int16_t* line, int ticks, std::int16_t travel) {
    line[place_] = travel;
    if (++place_ == ticks) {
      place_ = 0;
      full_ = true;
    }
    oldest_ = full_ ? line[place_] : std::int16_t{0};
  }

 private:
  int place_ = 0;
  std::int16_t oldest_ = 0;
  bool full_ = false;
};

template <class N>
struct VelocityEstimator {
  using T = typename N::T;
  static constexpr int latency = 5;
  struct State {
    T velocity = 0;  ///< rad/s
    bool saturated = false;
  };

  explicit VelocityEstimator(const Design& d)
      : gain(static_cast<T>(d["VELOCITY_GAIN"] == 0 ? 1 : d["VELOCITY_GAIN"])),
        exponent(d["VELOCITY_F"] +
                 (d["VELOCITY_GAIN"] == 0 ? d["VELOCITY_SHIFT"] : -d["VELOCITY_GAIN_F"])),
        w(d["VELOCITY_W"]),
        f(d["VELOCITY_F"]),
        slow(d["VELOCITY_W"] + std::min(0, 18 - d["P_VELOCITY_A1_F"])),
        a1(d["P_VELOCITY_A1_F"], d.rounding()) {}

  /// Before the low-pass, not yet saturated.
  T speed(std::int16_t counts) const {
    return N::integer(static_cast<T>(counts) * gain, exponent, f);
  }
  [[gnu::always_inline]] State tick(const State& s, const Words<T>& p, std::int16_t counts) const {
    const T speed = this->speed(counts), raw = N::saturate(speed, w);
    return {N::add_rounded(s.velocity, (raw - s.velocity) * p.velocity_a1, a1), raw != speed};
  }
  /// By M/T, as rtl/options/mt/velocity_estimator.sv: at a standstill without the low-pass, if that
  /// step is none that Overspeed takes for broken hardware.
  State tick(const State& s, const Words<T>& p, const SpanMeter::State& spans) const {
    const T raw = N::integer(static_cast<T>(spans.raw), 0, f);
    if (spans.still && N::saturate(s.velocity, slow) == s.velocity) return {raw, spans.saturated};
    return {N::add_rounded(s.velocity, (raw - s.velocity) * p.velocity_a1, a1), spans.saturated};
  }
  template <class At>
  static void show(const At& a, const State& from, State& to) {
    if (a.at(0)) to.saturated = from.saturated;
    if (a.at(3)) to.velocity = from.velocity;
  }

  T gain;
  int exponent;
  Bits w;
  int f;
  Bits slow;
  Drop a1;
};

}  // namespace feltgate::axis
