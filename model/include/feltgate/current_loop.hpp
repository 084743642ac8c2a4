// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The current loop of the core's twin: what rtl/core/actuation/actuation.sv has with the option
// CURRENT_LOOP. current_sense and current_control, their inputs from the wave, and the duty for the
// PWM, clock by clock. Documentation: docs/blocks/current_control.md
#pragma once

#include <algorithm>
#include <cstdint>

#include "feltgate/core_ports.hpp"
#include "feltgate/current_control.hpp"
#include "feltgate/current_sense.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// A measured current, [1,1,17] of full scale, in the format of the current; saturated.
template <class D>
constexpr std::int32_t motor_current(std::int32_t measured) {
  constexpr std::int32_t end = 1 << (D::f.current.width() - 1);
  return std::clamp(measured * (1 << D::current_drop), -end, end - 1);
}

/// Of a design without the option: it does nothing.
template <class D, bool Built = D::current_loop != 0>
class CurrentLoop {
 public:
  void reset() {}
  std::uint32_t state() const { return 0; }
  bool driver_fault() const { return false; }
  bool ready() const { return true; }
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
    bool polarity = false;         ///< the motor is connected the other way round
    bool beats = false;            ///< the end of a tick without a fault
    std::uint32_t tick_count = 0;  ///< of this tick
    bool clear = false;            ///< of the over-current and of the driver's fault
    bool driver_fault = false;     ///< the pin
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
    const auto at_shunt = static_cast<std::int32_t>(sense_.out().current);
    control.current = in.polarity ? -at_shunt : at_shunt;
    control.emf = feed_;
    control.proportional = D::current_proportional;
    control.integral = D::current_integral;
    control.limit = limit_;
    duty_ = static_cast<std::int16_t>(
        (std::int64_t{control_.out().voltage} * D::pwm_period + CurrentControl::kSupply / 2) >>
        kCurrentControlBits);
    if (D::heartbeat != 0 && in.beats) heartbeat_ = (in.tick_count & D::heartbeat) != 0;
    driver_kept_ = (driver_2_ && in.gates_enable) || (driver_kept_ && !in.clear);
    driver_2_ = driver_1_;
    driver_1_ = in.driver_fault && D::driver_fault != 0;
    if (in.wave_clock == Map::T::sample) current_ = mean_;
    if (sense_.out().aligned) mean_ = control.current;
    sense_.clock(sense);
    control_.clock(control);
    // The first period begins in the second clock after a reset.
    since_ = since_ == D::pwm_period - 1 ? 0 : since_ + 1;
    from_wave(in);
  }

  /// For the PWM, clocks.
  std::int16_t duty() const { return duty_; }
  /// The current is measured, in the direction of tau_ref, and held from Step::sample on.
  void show(CoreOut* out) const {
    out->current = current_;
    out->current_clock = sense_.out().modulator_clock;
    out->heartbeat = heartbeat_;
  }
  /// That current for the heat, in the format of the estimated current.
  std::int32_t heat_current() const {
    return motor_current<D>(current_) >> (D::f.current.fraction - D::f.current_estimate.fraction);
  }
  bool driver_fault() const { return driver_2_ || driver_kept_; }
  /// faults.current: why the current is not to be relied on.
  std::uint32_t state() const {
    const CurrentSense::Out& s = sense_.out();
    return static_cast<std::uint32_t>(s.overcurrent | s.stuck << 1 | s.saturated << 2 |
                                      s.offset_fault << 3 | !s.calibrated << 4);
  }
  /// Whether nothing forbids arming.
  bool ready() const { return state() == 0 && !driver_fault(); }
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
  std::int32_t mean_ = 0, current_ = 0;  // of the last period; of this tick
  std::int16_t duty_ = 0;
  bool heartbeat_ = false;
  bool driver_1_ = false, driver_2_ = false, driver_kept_ = false;
};

}  // namespace feltgate
