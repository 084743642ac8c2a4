// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/actuation/current_loop.sv: current_sense, current_control or field_oriented, and
// current_check, their inputs from the wave, and the duty for the PWM, clock by clock.
// Documentation: docs/blocks/current.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/core_ports.hpp"
#include "feltgate/current_check.hpp"
#include "feltgate/current_control.hpp"
#include "feltgate/current_sense.hpp"
#include "feltgate/field_oriented.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// A measured current, [1,1,17] of full scale, in the format of the current; saturated.
template <class D>
constexpr std::int32_t motor_current(std::int32_t measured) {
  constexpr std::int32_t end = 1 << (D::f.current.width() - 1);
  return std::clamp(measured * (1 << D::current_drop), -end, end - 1);
}

/// Currents that a design controls: 0, 1 of the motor, or 2 of three phases.
template <class D>
inline constexpr int controlled_currents = D::current_loop == 0 ? 0 : D::phases - 1;

/// Of a design without the option: it does nothing.
template <class D, int Currents = controlled_currents<D>>
class CurrentLoop {
 public:
  void reset() {}
  std::uint32_t state() const { return 0; }
  bool driver_fault() const { return false; }
  bool missing() const { return false; }
  bool starts() const { return false; }
  bool unfit() const { return false; }
  bool trips(bool) const { return false; }
};

/// What the loops of one and of three phases have in common.
template <class D>
class MeasuredCurrent {
 public:
  /// What the other blocks show before the clock edge.
  struct In {
    unsigned data = 0;             ///< bit n: of modulator n
    bool gates_enable = false;     ///< else the current is 0
    bool direct = false;           ///< voltage mode: the loop rests
    bool polarity = false;         ///< the motor is connected the other way round
    bool beats = false;            ///< the end of a tick without a fault
    std::uint32_t tick_count = 0;  ///< of this tick
    bool clear = false;            ///< of the faults that are kept
    bool driver_fault = false;     ///< the pin
    int wave_clock = -1;           ///< clock of the wave
    std::int32_t reference = 0;    ///< current_ref, for EVENT_AT_VOLTAGE
    std::int64_t forwarded = 0;    ///< LSB of the voltage, for the same clock
    std::uint32_t duty_limit = 0;  ///< the word
    // Of three phases.
    std::int16_t duty = 0;    ///< the length of the direct voltage, clocks
    std::int32_t count = 0;   ///< of the encoder, whatever its zero
    std::uint32_t angle = 0;  ///< or of Hall lines; the count is 0 then
    std::uint32_t word = 0;   ///< on the parameter bus, if it is one of commutation
  };

  /// The current is measured, in the direction of tau_ref, and held from Step::sample on.
  void show(CoreOut* out) const {
    out->current = current_;
    out->current_clock = sense_[0].out().modulator_clock;
    out->heartbeat = heartbeat_;
  }
  /// That current for the heat, in the format of the estimated current.
  std::int32_t heat_current() const {
    return motor_current<D>(current_) >> (D::f.current.fraction - D::f.current_estimate.fraction);
  }
  bool driver_fault() const { return driver_2_ || driver_kept_; }
  /// status.current_missing: it was not what the voltage makes, or a phase was open.
  bool missing() const { return missing_kept_; }
  /// faults.current: why a current is not to be relied on.
  std::uint32_t state() const {
    std::uint32_t bits = 0;
    for (const CurrentSense& sense : sense_) {
      const CurrentSense::Out& s = sense.out();
      bits |= static_cast<std::uint32_t>(s.overcurrent | s.stuck << 1 | s.saturated << 2 |
                                         s.offset_fault << 3 | !s.calibrated << 4);
    }
    return bits;
  }
  /// Whether a request to arm waits, for the first offset.
  bool starts() const { return (state() & kStarts) != 0; }
  /// Whether one is refused.
  bool unfit() const { return (state() & ~kStarts) != 0 || driver_fault() || missing(); }
  bool trips(bool gates_enable) const { return gates_enable && (starts() || unfit()); }

 protected:
  static constexpr std::uint32_t kStarts = 1u << (Map::C::faults_current_width - 1);
  // A whole period stays below the supply, which 17 bits do not hold.
  static constexpr std::int32_t kLimitGain = (CurrentControl::kSupply - 1) / D::pwm_period;

  std::int32_t at_shunt(std::size_t n) const {
    return static_cast<std::int32_t>(sense_[n].out().current);
  }
  bool aligned() const { return sense_[0].out().aligned; }
  /// What the check compares, of a controller before the clock edge.
  struct Compared {
    std::int32_t resistive = 0, across = 0, current = 0;
    bool open = false;  ///< a phase has no current
  };
  /// A clock, at whose end the controller shows a new current if it is `measured`.
  void clock(const In& in, bool measured, std::int32_t current, const Compared& compared) {
    missing_kept_ = check_.out().missing || compared.open || (missing_kept_ && !in.clear);
    CurrentCheck::In check;
    check.armed = in.gates_enable && !in.direct;
    check.valid = aligned();
    check.resistive = compared.resistive;
    check.across = compared.across;
    check.current = compared.current;
    check.resistance = D::current_resistance;
    check.margin = D::current_margin;
    check_.clock(check);
    if (D::heartbeat != 0 && in.beats) heartbeat_ = (in.tick_count & D::heartbeat) != 0;
    driver_kept_ = (driver_2_ && in.gates_enable) || (driver_kept_ && !in.clear);
    driver_2_ = driver_1_;
    driver_1_ = in.driver_fault && D::driver_fault != 0;
    if (in.wave_clock == Map::T::sample) current_ = mean_;
    if (measured) mean_ = current;
    typename CurrentSense::In sense;
    sense.strobe = since_ == D::current_strobe;
    sense.armed = in.gates_enable;
    sense.clear = in.clear;
    sense.threshold = D::current_overcurrent;
    for (std::size_t n = 0; n < sense_.size(); ++n) {
      sense.data = ((in.data >> n) & 1u) != 0;
      sense_[n].clock(sense);
    }
    // The first period begins in the second clock after a reset.
    since_ = since_ == D::pwm_period - 1 ? 0 : since_ + 1;
    from_wave(in);
  }

  std::int32_t reference_ = 0, feed_ = 0, limit_ = 0;

 private:
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

  std::array<CurrentSense, controlled_currents<D>> sense_;
  CurrentCheck check_;
  int since_ = D::pwm_period - 1;        // clocks since a period began
  std::int32_t mean_ = 0, current_ = 0;  // of the last period; of this tick
  bool heartbeat_ = false;
  bool driver_1_ = false, driver_2_ = false, driver_kept_ = false, missing_kept_ = false;
};

/// Of one current: it gives the bridge its duty.
template <class D>
class CurrentLoop<D, 1> : public MeasuredCurrent<D> {
 public:
  using In = typename MeasuredCurrent<D>::In;

  void reset() { *this = CurrentLoop(); }

  void clock(const In& in) {
    CurrentControl::In control;
    control.armed = in.gates_enable && !in.direct;
    control.valid = this->aligned();
    control.reference = this->reference_;
    control.current = in.polarity ? -this->at_shunt(0) : this->at_shunt(0);
    control.emf = this->feed_;
    control.proportional = D::current_proportional;
    control.integral = D::current_integral;
    control.limit = this->limit_;
    duty_ = static_cast<std::int16_t>(
        (std::int64_t{control_.out().voltage} * D::pwm_period + CurrentControl::kSupply / 2) >>
        kCurrentControlBits);
    MeasuredCurrent<D>::clock(in, control.valid, control.current,
                              {control_.out().resistive, 0, control.current, false});
    control_.clock(control);
  }

  /// For the PWM, clocks.
  std::int16_t duty() const { return duty_; }

 private:
  CurrentControl control_;
  std::int16_t duty_ = 0;
};

/// Of three phases: it gives the bridge the on-times of its legs.
template <class D>
class CurrentLoop<D, 2> : public MeasuredCurrent<D> {
 public:
  using In = typename MeasuredCurrent<D>::In;

  void reset() { *this = CurrentLoop(); }

  void clock(const In& in) {
    constexpr std::int32_t most = CurrentControl::kSupply - 1;
    FieldOriented::In field;
    field.armed = in.gates_enable;
    field.valid = this->aligned();
    field.direct = in.direct;
    field.reference = this->reference_;
    field.current_a = this->at_shunt(0);
    field.current_b = this->at_shunt(1);
    field.emf = in.direct ? std::clamp(in.duty * this->kLimitGain, -most - 1, most) : this->feed_;
    field.position = in.count;
    field.gain = gain_;
    field.offset = offset_ + in.angle;
    field.polarity = in.polarity;
    field.proportional = D::current_proportional;
    field.integral = D::current_integral;
    field.limit = static_cast<std::uint32_t>(this->limit_);
    constexpr std::int32_t end = 1 << 18;  // of a measured current
    const FieldOriented::Out& out = field_.out();
    MeasuredCurrent<D>::clock(in, out.valid, std::clamp(out.current_q, -end, end - 1),
                              {out.resistive, out.across, out.current_q, out.open});
    field_.clock(field);
    if (in.wave_clock == Map::W::commutation_gain) gain_ = in.word;
    if (in.wave_clock == Map::W::commutation_offset) offset_ = in.word;
  }

  /// For the PWM, clocks of the high switches.
  std::array<std::int16_t, 3> on_times() const {
    return {field_.out().on_a, field_.out().on_b, field_.out().on_c};
  }

 private:
  FieldOriented field_{D::pwm_period};
  std::uint32_t gain_ = 0, offset_ = 0;
};

}  // namespace feltgate
