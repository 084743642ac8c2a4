// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/actuation/torque_control.sv, clock by clock, by the law of the chain; the limits
// are the limiter's. Documentation: docs/blocks/torque_control.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/torque_control.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class TorqueControl {
 public:
  using Law = TorqueControlLaw<D, Fixed>;

  struct In {
    bool armed = false;
    Mode mode = Mode::closed_loop;
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    std::int64_t product = 0;
    std::int64_t tau_ref = 0;
    std::int64_t limited = 0;
    bool over_limit = false;
  };
  struct Out {
    std::int64_t early_term = 0;  ///< value for the limiter, a clock before the limit's word
    std::int64_t late_term = 0;   ///< value for the limiter, in the clock of the limit's word
    std::int64_t addend = 0;      ///< difference `applied` - `limited`
    bool region_high = false;
    std::int64_t current_ref = 0;
    std::int64_t voltage = 0;
    std::int64_t duty = 0;
    ControlLimits limit;
  };

  void reset() { *this = TorqueControl{}; }

  void clock(const In& in) {
    using T = Map::T;
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    const bool direct = in.mode == Mode::voltage;
    const bool follows = !direct && in.armed, ramps = direct && in.armed;
    const std::int64_t applied = in.limited + out_.addend;
    out_.early_term = out_.late_term = out_.addend = 0;
    if (at(T::set_error) && ramps) {
      out_.late_term = (word<D::P::voltage_setpoint.key()>(in.param) - voltage_).raw();
    }
    if (at(T::set_step) && ramps) out_.addend = voltage_.raw();
    if (at(T::dead_voltage) && D::emf_in_law == 0 && !direct) out_.addend = -emf_.raw();
    if (at(T::voltage_limited) && in.armed) out_.addend = emf_.raw();
    if (at(T::voltage_part)) emf_ = Law::emf(product<P::velocity, P::emf>(in));
    if (at(T::current_part)) {
      kept_ = in.mode == Mode::open_loop ? CurrentPart{}
                                         : Law::current_part(product<P::torque, P::observer>(in));
    }
    if (at(T::border) || at(T::hold_size)) out_.early_term = in.tau_ref;
    if (at(T::region)) out_.region_high = in.over_limit;
    if (at(T::direct_current) && direct && in.armed) {
      out_.early_term = Law::current_sum(product<P::voltage, P::direct>(in)).raw();
    }
    if (at(T::current_sum) && follows) {
      const auto by_ref = Law::current_part(product<P::torque, P::torque_gain>(in));
      out_.late_term = Law::current_sum(by_ref + kept_).raw();
    }
    if (at(T::dead_sum) && !direct) {
      out_.early_term = Law::voltage_part(product<P::torque, P::slope>(in)).raw();
    }
    if (at(T::current)) {
      out_.current_ref = shown<D::f.current.width()>(in.limited);
      out_.limit.current = in.over_limit && in.armed;
    }
    if (direct ? at(T::direct_voltage) : at(T::voltage_offset)) {
      fixed_ = VoltageSum::from_raw(raw<VoltageSum>(applied));
    }
    if (at(T::voltage_sum) && follows) {
      const auto resistive = Law::voltage_part(product<P::current, P::gain>(in));
      out_.late_term = Law::voltage_sum(resistive + fixed_).raw();
    }
    if (at(T::voltage_sum) && ramps) out_.late_term = Law::voltage_sum(fixed_ - emf_).raw();
    if (at(T::voltage)) {
      voltage_ = Law::port_voltage(Applied::from_raw(raw<Applied>(applied)));
      out_.limit.voltage = in.over_limit && in.armed;
    }
    if (at(T::duty_sum)) {
      out_.late_term = Law::duty_sum(product<D::f.applied.key(), P::duty>(in)).raw();
    }
    if (at(T::duty)) {
      out_.duty = shown<D::f.duty.width()>(in.limited);
      out_.limit.duty = in.over_limit;
    }
    out_.voltage = voltage_.raw();
  }

  const Out& out() const { return out_; }

 private:
  using CurrentPart = typename Law::CurrentPart;
  using Applied = typename Law::Applied;
  using VoltageSum = typename Law::VoltageSum;

  /// Formats of the factors.
  struct P {
    static constexpr int torque = D::f.torque.key(), velocity = D::f.velocity.key();
    static constexpr int voltage = D::f.voltage.key(), current = D::f.current.key();
    static constexpr int emf = D::P::emf_constant.key(), observer = D::P::observer_gain.key();
    static constexpr int direct = D::P::voltage_to_current.key();
    static constexpr int torque_gain = D::P::torque_gain.key();
    static constexpr int slope = D::P::dead_voltage_slope.key();
    static constexpr int gain = D::P::voltage_gain.key(), duty = D::P::duty_gain.key();
  };

  template <int Key>
  static fixed_of<Key> word(std::uint32_t raw) {
    return Fixed::from_raw<Key>(decode_word(Format::from_key(Key), raw));
  }
  /// The product on the bus as the number it is: a signal times a coefficient.
  template <int SignalKey, int CoefficientKey>
  static auto product(const In& in) {
    return decltype(fixed_of<SignalKey>{} * fixed_of<CoefficientKey>{})::from_raw(in.product);
  }
  template <class Number>
  static typename Number::raw_type raw(std::int64_t value) {
    return static_cast<typename Number::raw_type>(value);
  }
  /// Cuts a value to the width of a port.
  template <int Width>
  static std::int64_t shown(std::int64_t value) {
    return feltgate::detail::wrapped<std::int64_t>(value, 1, Width);
  }

  typename Law::Voltage voltage_{};
  CurrentPart kept_{};
  typename Law::Emf emf_{};
  VoltageSum fixed_{};
  Out out_;
};

}  // namespace feltgate
