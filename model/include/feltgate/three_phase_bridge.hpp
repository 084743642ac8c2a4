// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The bridge of the core's twin for a motor with three phases: what rtl/core/actuation/actuation.sv
// has with PHASES = 3. It takes the place of CoreGates, clock by clock.
// Documentation: docs/blocks/three_phase.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "feltgate/commutation.hpp"
#include "feltgate/core_gates.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/pwm_three_phase.hpp"

namespace feltgate {

/// The six gates: what the bridges with and without measured currents have in common.
class ThreeLegs {
 public:
  /// The gates: bit 0 a_hi, bit 1 a_lo, then B and C.
  std::uint8_t bits() const { return bits_; }
  /// What is in force: the amplitude, or of a current loop the on-time of leg A from half a period
  /// on; clocks.
  std::int16_t duty_active() const { return active_; }
  /// Clocks since reset for which each gate was on, in the same order.
  GateCounts on_clocks() const { return clocks_; }
  int on_time(std::size_t leg) const { return pwm_.on_time(leg); }
  /// Number of clocks before the clock that takes the on-times.
  int clocks_to_duty() const { return pwm_.clocks_to_sample(); }
  /// No clock may be skipped.
  static bool quiet_for(int, bool) { return false; }
  static void pass(int) {}

 protected:
  ThreeLegs(int period, int dead_clocks, int shortest_clocks)
      : period_(period), pwm_(period, dead_clocks, shortest_clocks) {}

  void reset_legs() {
    pwm_.reset();
    active_ = 0;
    bits_ = 0;
    clocks_ = {};
  }
  bool began() const { return pwm_.out().period_start; }
  void clock_legs(const PwmThreePhase::In& in) {
    pwm_.clock(in);
    const PwmThreePhase::Out& g = pwm_.out();
    bits_ = static_cast<std::uint8_t>(g.gate_a_hi | g.gate_a_lo << 1 | g.gate_b_hi << 2 |
                                      g.gate_b_lo << 3 | g.gate_c_hi << 4 | g.gate_c_lo << 5);
    for (std::size_t n = 0; n < clocks_.size(); ++n) clocks_[n] += (bits_ >> n) & 1;
  }

  int period_;
  std::int16_t active_ = 0;

 private:
  PwmThreePhase pwm_;
  std::uint8_t bits_ = 0;
  GateCounts clocks_{};
};

/// In voltage mode.
class ThreePhaseBridge : public ThreeLegs {
 public:
  /// What the other blocks show before the clock edge.
  struct In {
    bool clear = false;          ///< every gate off
    bool enable = false;         ///< else the on-times are 0
    bool polarity = false;       ///< of the motor: legs B and C change places
    std::int32_t count = 0;      ///< of the encoder, whatever its zero
    std::uint32_t angle = 0;     ///< or of Hall lines; the count is 0 then
    std::int16_t amplitude = 0;  ///< clocks
    int wave_clock = -1;         ///< clock of the wave
    std::uint32_t word = 0;      ///< on the parameter bus, if it is one of commutation
  };

  /// `modulation` is of Commutation.
  ThreePhaseBridge(int period, int dead_clocks, int shortest_clocks, int modulation)
      : ThreeLegs(period, dead_clocks, shortest_clocks),
        commutation_(period, static_cast<Commutation::Modulation>(modulation)) {
    reset();
  }

  void reset() {
    commutation_.reset();
    reset_legs();
    wait_ = 0;
    fresh_ = false;
    gain_ = offset_ = 0;
    amplitude_ = 0;
  }

  /// Advances `clocks` clocks with `in` held.
  void advance(const In& in, int clocks) {
    for (int c = 0; c < clocks; ++c) clock(in);
  }

 private:
  void clock(const In& in) {
    const bool starts = began();
    const Commutation::Out legs = commutation_.out();
    // The sample comes so early that the on-times are new in the clock that takes them.
    Commutation::In angle;
    angle.sample = wait_ == 1;
    angle.position = in.count;
    angle.gain = gain_;
    angle.offset = offset_ + in.angle;
    angle.amplitude = in.amplitude;
    angle.polarity = in.polarity;
    const bool opens = in.enable && fresh_;
    clock_legs({in.clear, opens, legs.on_a, legs.on_b, legs.on_c});
    commutation_.clock(angle);
    if (legs.valid) active_ = amplitude_;
    if (!opens) active_ = 0;
    fresh_ = in.enable && (fresh_ || angle.sample);
    if (angle.sample) amplitude_ = in.amplitude;
    if (starts) {
      wait_ = period_ - 1 - commutation_.latency_clocks();
    } else if (wait_ > 0) {
      --wait_;
    }
    if (in.wave_clock == Map::W::commutation_gain) gain_ = in.word;
    if (in.wave_clock == Map::W::commutation_offset) offset_ = in.word;
  }

  Commutation commutation_;
  int wait_ = 0;        // 1: the clock of the sample
  bool fresh_ = false;  // there was a sample since the enable: no on-times of the last arming
  std::uint32_t gain_ = 0, offset_ = 0;
  std::int16_t amplitude_ = 0;  // of the sample
};

/// With a current loop, which gives the on-times: half a period without the enable.
class FieldBridge : public ThreeLegs {
 public:
  /// What the other blocks show before the clock edge.
  struct In {
    bool clear = false, enable = false;
    bool polarity = false;             ///< the loop's
    std::array<std::int16_t, 3> on{};  ///< clocks
  };

  FieldBridge(int period, int dead_clocks, int shortest_clocks, int)
      : ThreeLegs(period, dead_clocks, shortest_clocks) {
    reset();
  }

  void reset() { reset_legs(); }

  /// Advances `clocks` clocks with `in` held.
  void advance(const In& in, int clocks) {
    for (int c = 0; c < clocks; ++c) {
      if (began()) active_ = static_cast<std::int16_t>(in.on[0] - period_ / 2);
      if (!in.enable) active_ = 0;
      clock_legs({in.clear, in.enable, in.on[0], in.on[1], in.on[2]});
    }
  }
};

/// The bridge of design D.
template <class D>
using BridgeOf =
    std::conditional_t<D::phases != 3, CoreGates,
                       std::conditional_t<D::current_loop != 0, FieldBridge, ThreePhaseBridge>>;

}  // namespace feltgate
