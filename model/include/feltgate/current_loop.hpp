// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The current loop of the core's twin: what rtl/core/actuation/actuation.sv has with the option
// CURRENT_LOOP. current_sense and current_control, their inputs from the wave, and the duty for the
// PWM, clock by clock. Documentation: docs/blocks/current_control.md
#pragma once

#include <algorithm>
#include <cstdint>

#include "feltgate/current_control.hpp"
#include "feltgate/current_sense.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Of a design without the option: it does nothing.
template <class D, bool Built = D::current_loop != 0>
class CurrentLoop {
 public:
  void reset() {}
  std::uint32_t state() const { return 0; }
  bool waits() const { return false; }
};

template <class D>
class CurrentLoop<D, true> {
 public:
  /// What the other blocks show before the clock edge.
  struct In {
    bool data = false;             ///< of the modulator
    bool gates_enable = false;     ///< else the current is 0
    bool direct = false;           ///< voltage mode: the loop rests
    bool clear = false;            ///< of the over-current
    int wave_clock = -1;           ///< clock of the wave
    std::int32_t reference = 0;    ///< current_ref, for EVENT_AT_VOLTAGE
    std::int64_t forwarded = 0;    ///< LSB of the voltage, for the same clock
    std::uint32_t duty_limit = 0;  ///< the word
  };

  void reset() { *this = CurrentLoop(); }

  void clock(const In& in) {
    typename CurrentSense::In sense;
    sense.data = in.data;
    sense.strobe = since_ == D::current_strobe;
    sense.armed = in.gates_enable;
    sense.clear = in.clear;
    sense.threshold = D::current_overcurrent;
    CurrentControl::In control;
    control.armed = in.gates_enable && !in.direct;
    control.valid = sense_.out().aligned;
    control.reference = reference_;
    control.current = static_cast<std::int32_t>(sense_.out().current);
    control.emf = feed_;
    control.proportional = D::current_proportional;
    control.integral = D::current_integral;
    control.limit = limit_;
    duty_ = static_cast<std::int16_t>(
        (std::int64_t{control_.out().voltage} * D::pwm_period + CurrentControl::kSupply / 2) >>
        kCurrentControlBits);
    sense_.clock(sense);
    control_.clock(control);
    // The first period begins in the second clock after a reset.
    since_ = since_ == D::pwm_period - 1 ? 0 : since_ + 1;
    from_wave(in);
  }

  /// For the PWM, clocks.
  std::int16_t duty() const { return duty_; }
  const CurrentSense::Out& sense() const { return sense_.out(); }
  /// faults.current: why the current is not to be relied on; the core arms only with 0.
  std::uint32_t state() const {
    const CurrentSense::Out& s = sense_.out();
    return static_cast<std::uint32_t>(s.overcurrent | s.stuck << 1 | s.saturated << 2 |
                                      s.offset_fault << 3 | !s.calibrated << 4);
  }
  /// Whether a request to arm waits, for the first offset.
  bool waits() const { return !sense_.out().calibrated; }

 private:
  static constexpr std::int32_t kLimitGain = CurrentControl::kSupply / D::pwm_period;

  void from_wave(const In& in) {
    if (in.wave_clock == Map::T::voltage) {
      reference_ = (in.reference + (1 << D::current_drop >> 1)) >> D::current_drop;
      constexpr std::int64_t most = CurrentControl::kSupply - 1;
      feed_ = static_cast<std::int32_t>(
          std::clamp((in.forwarded * D::feed_gain) >> D::feed_drop, -most - 1, most));
    }
    if (in.wave_clock == Map::W::duty_limit) {
      const auto word = static_cast<std::int32_t>(in.duty_limit);
      limit_ = std::clamp(word, 0, D::pwm_period) * kLimitGain;
    }
  }

  CurrentSense sense_;
  CurrentControl control_;
  int since_ = D::pwm_period - 1;  // clocks since a period began
  std::int32_t reference_ = 0, feed_ = 0, limit_ = 0;
  std::int16_t duty_ = 0;
};

}  // namespace feltgate
