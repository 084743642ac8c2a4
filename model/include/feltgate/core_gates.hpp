// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The PWM inside the core's twin, advanced from event to event, and counts of each gate's on-time.
// Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/pwm.hpp"

namespace feltgate {

/// Gates of a bridge with three legs; an H-bridge has the first four.
constexpr std::size_t kBridgeGates = 6;
using GateCounts = std::array<std::int64_t, kBridgeGates>;

/// The PWM of the core, with counters.
class CoreGates {
 public:
  using In = Pwm::In;

  CoreGates(int period, int dead_clocks, int shortest_clocks = 1, int = 0)
      : pwm_(period, dead_clocks, shortest_clocks) {}

  void reset() {
    pwm_.reset();
    bits_ = 0;
    held_ = quiet_ = passed_ = 0;
    clocks_ = {};
  }

  /// Advances `clocks` clocks with `in` held.
  void advance(const In& in, int clocks) {
    if (quiet_for(clocks, in.enable) && !in.clear) {
      pass(clocks);
    } else {
      advance_to_events(in, clocks);
    }
  }
  /// Whether it is known that nothing changes in the next `clocks` clocks with this enable; pass()
  /// may then replace advance().
  bool quiet_for(int clocks, bool enable) const { return quiet_ >= clocks && enable == enable_; }
  void pass(int clocks) {
    quiet_ -= clocks;
    passed_ += clocks;
    held_ += clocks;
  }
  /// Number of clocks before the clock that takes the duty.
  int clocks_to_duty() const { return pwm_.clocks_to_duty() - passed_; }

  /// The gates: bit 0 a_hi, bit 1 a_lo, bit 2 b_hi, bit 3 b_lo.
  std::uint8_t bits() const { return bits_; }
  /// The duty says it all.
  static int on_time(std::size_t) { return 0; }
  bool period_start() const { return pwm_.out().period_start; }
  std::int16_t duty_active() const { return pwm_.out().duty_active; }
  /// Clocks since reset for which each gate was on, in the same order.
  GateCounts on_clocks() const {
    GateCounts all = clocks_;
    for (std::size_t g = 0; g < 4; ++g) all[g] += ((bits_ >> g) & 1u) * held_;
    return all;
  }

 private:
  void advance_to_events(const In& in, int clocks) {
    settle();
    if (in.enable != enable_ || in.clear) quiet_ = 0;
    enable_ = in.enable;
    while (clocks > 0) {
      if (quiet_ == 0) quiet_ = pwm_.quiet_clocks(in);
      const int step = std::min(clocks, std::max(quiet_, 1));
      if (quiet_ > 0) {
        pass(step);
        settle();
      } else {
        pwm_.clock(in);
        take(bits(pwm_.out()));
        held_ += step;
      }
      clocks -= step;
    }
  }
  /// Advances the PWM by the clocks that pass() has only counted.
  void settle() {
    if (passed_ > 0) pwm_.skip(passed_);
    passed_ = 0;
  }
  static std::uint8_t bits(const Pwm::Out& g) {
    return static_cast<std::uint8_t>(g.gate_a_hi | g.gate_a_lo << 1 | g.gate_b_hi << 2 |
                                     g.gate_b_lo << 3);
  }
  void take(std::uint8_t now) {
    if (now == bits_) return;
    clocks_ = on_clocks();
    held_ = 0;
    bits_ = now;
  }

  Pwm pwm_;
  std::uint8_t bits_ = 0;
  std::int64_t held_ = 0;  ///< clocks since a gate last changed
  int quiet_ = 0;          ///< coming clocks without a change, while the enable stays enable_
  int passed_ = 0;         ///< clocks that the PWM must still be advanced
  bool enable_ = false;
  GateCounts clocks_{};
};

}  // namespace feltgate
