// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/pwm_three_phase.sv: centre-aligned PWM for three legs, with dead time.
// On-times in clocks are sampled once per period, with period_start. They reach the gates 3 clocks
// later, rising edges after the dead time in addition; while disabled they are 0.
// Documentation: docs/blocks/pwm.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace feltgate {

/// Bit-exact and clock-exact with the RTL.
class PwmThreePhase {
 public:
  static constexpr std::size_t kLegs = 3;
  struct In {
    bool clear = false;     ///< turns every gate off, also between clock edges
    bool enable = false;    ///< false: every gate off from this clock on, on-times 0
    std::int16_t on_a = 0;  ///< clocks of the high switch, 0..4095; above the period as the period
    std::int16_t on_b = 0;
    std::int16_t on_c = 0;
  };
  /// The gates of legs A, B and C.
  struct Out {
    bool gate_a_hi = false;
    bool gate_a_lo = false;
    bool gate_b_hi = false;
    bool gate_b_lo = false;
    bool gate_c_hi = false;
    bool gate_c_lo = false;
    bool period_start = false;  ///< the on-times were sampled in the last clock
    /// Bit 0 leg A high, bit 1 leg A low, then B and C.
    unsigned bits() const {
      return unsigned{gate_a_hi} | unsigned{gate_a_lo} << 1 | unsigned{gate_b_hi} << 2 |
             unsigned{gate_b_lo} << 3 | unsigned{gate_c_hi} << 4 | unsigned{gate_c_lo} << 5;
    }
  };

  /// `period` in clocks: even, 4 to 4094. `dead_clocks`: 1 to 64. `shortest_clocks`: shortest pulse
  /// at a gate, 1 to 255; if above 1, both together are at most half a period.
  explicit PwmThreePhase(int period = 1000, int dead_clocks = 25, int shortest_clocks = 1)
      : period_(period), dead_(dead_clocks), shortest_(shortest_clocks) {
    reset();
  }

  void reset() {
    time_ = period_ - 2;
    legs_ = {};
    for (Leg& leg : legs_) leg.wait = dead_ - 1;
    out_ = Out{};
  }

  void clock(const In& in) {
    // Period, period - 2 .. 2, 1, 3 .. period - 1.
    const int carrier = 2 * time_ < period_ ? period_ - 2 * time_ : 2 * time_ - period_ + 1;
    out_.period_start = time_ == period_ - 2;
    const std::array<std::int16_t, kLegs> on = {in.on_a, in.on_b, in.on_c};
    for (std::size_t l = 0; l < kLegs; ++l) {
      Leg& leg = legs_[l];
      const bool free = in.enable && leg.high == leg.wanted;
      const bool opens = free && leg.wait == 0 && !in.clear;
      leg.gate_hi = opens && leg.wanted;
      leg.gate_lo = opens && !leg.wanted;
      leg.wait = free ? std::max(0, leg.wait - 1) : dead_ - 1;
      leg.wanted = leg.high;
      leg.high = carrier <= leg.threshold;
      leg.threshold = leg.whole;
      if (out_.period_start) take(leg, on[l]);
      if (!in.enable) leg.taken = leg.whole = leg.debt = 0;
    }
    time_ = time_ == period_ - 1 ? 0 : time_ + 1;
    out_.gate_a_hi = legs_[0].gate_hi;
    out_.gate_a_lo = legs_[0].gate_lo;
    out_.gate_b_hi = legs_[1].gate_hi;
    out_.gate_b_lo = legs_[1].gate_lo;
    out_.gate_c_hi = legs_[2].gate_hi;
    out_.gate_c_lo = legs_[2].gate_lo;
  }

  const Out& out() const { return out_; }
  /// Clocks of a leg's high switch in this period as they are taken, with the dead time in them;
  /// new with period_start.
  int on_time(std::size_t leg) const { return std::min(legs_[leg].taken, period_); }

  /// Number of clocks before the clock that samples the on-times.
  int clocks_to_sample() const { return (2 * period_ - 2 - time_) % period_; }

 private:
  struct Leg {
    int taken = 0, whole = 0, threshold = 0;  // clocks
    int debt = 0;                             // clocks of high pulses that were too short
    bool high = false, wanted = false, gate_hi = false, gate_lo = false;
    int wait = 0;  // clocks until the dead time is over
  };

  /// Takes `on`, and changes it so that no pulse is shorter than shortest_: the clocks of a short
  /// high pulse wait in debt until they make a whole one, a short low pulse is made longer.
  void take(Leg& leg, int on) const {
    leg.taken = leg.whole = on;
    if (shortest_ == 1 || on <= dead_) return;
    const int least = dead_ + shortest_, sum = on + leg.debt;
    leg.debt = sum < least ? sum - dead_ : 0;
    leg.whole = sum < least ? dead_ : std::min(sum, period_ - least);
  }

  int period_, dead_, shortest_;
  int time_ = 0;  // clocks since the start of the carrier
  std::array<Leg, kLegs> legs_{};
  Out out_;
};

}  // namespace feltgate
