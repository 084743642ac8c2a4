// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/actuation/torque_control.sv: from the torque reference to current, voltage and
// duty.
//   I = Jn*Kp/Ktn * tau_ref + (1 - Jn*Kp)/Ktn * tau_hat        limited; the observer sees this I
//   V = gain*I + Ke*w + dead voltage                           limited to a window around Ke*w
//   duty = V * period/supply                                   limited
// Documentation: docs/blocks/torque_control.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/limiter.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// The values of the control word's mode bits.
enum class Mode : std::uint8_t {
  closed_loop = 0,             ///< tau_hat is fed back
  open_loop = Map::mode_open,  ///< tau_hat is not fed back
  voltage = Map::mode_voltage  ///< the ramped set-point replaces the law; the observer sees V *
                               ///< voltage_to_current
};

/// The arithmetic, in number policy N, for design D.
template <class D, class N>
struct TorqueControlLaw {
  using Torque = typename N::template num<D::f.torque.key()>;
  using Current = typename N::template num<D::f.current.key()>;
  using CurrentPart = typename N::template num<D::f.current_part.key()>;
  using CurrentSum = typename N::template num<D::f.current_sum.key()>;
  using Voltage = typename N::template num<D::f.voltage.key()>;
  using VoltagePart = typename N::template num<D::f.voltage_part.key()>;
  using VoltageSum = typename N::template num<D::f.voltage_sum.key()>;
  using VoltageChange =
      typename N::template num<growth::difference(D::f.voltage, D::f.voltage).key()>;
  using Emf = typename N::template num<D::f.emf.key()>;
  using Applied = typename N::template num<D::f.applied.key()>;
  using Duty = typename N::template num<D::f.duty.key()>;
  using DutySum = typename N::template num<D::f.duty_sum.key()>;

  // The limiter reads every limit and border with the binary point of the sum.
  template <int Fraction>
  static constexpr int limit_key = LimiterLaw<D, N>::template key<Fraction>;
  static constexpr int kCurrentKey = limit_key<D::f.current.fraction>;
  static constexpr int kBorderKey = limit_key<D::f.torque.fraction>;
  static constexpr int kVoltageKey = limit_key<D::f.voltage.fraction>;
  static constexpr int kDutyKey = limit_key<0>;
  using LimitedVoltage = typename N::template num<kVoltageKey>;

  /// One product of the current, truncated to the current's last bit.
  template <class Product>
  static constexpr CurrentPart current_part(Product p) {
    return quantise<N, CurrentPart, Round::truncate, Overflow::wrap>(p);
  }
  /// One product of the voltage, truncated to the voltage's last bit.
  template <class Product>
  static constexpr VoltagePart voltage_part(Product p) {
    return quantise<N, VoltagePart, Round::truncate, Overflow::wrap>(p);
  }
  /// The duty in clocks of on-time, rounded.
  template <class Product>
  static constexpr DutySum duty_sum(Product p) {
    return quantise<N, DutySum, D::rounding, Overflow::wrap>(p);
  }
  /// The back-EMF, truncated to the voltage's last bit.
  template <class Product>
  static constexpr Emf emf(Product p) {
    return quantise<N, Emf, Round::truncate, Overflow::wrap>(p);
  }
  /// A part, or the exact sum of parts, in the adder's format; the formats are chosen so that it
  /// fits.
  template <class X>
  static constexpr CurrentSum current_sum(X x) {
    return quantise<N, CurrentSum, Round::truncate, Overflow::wrap>(x);
  }
  template <class X>
  static constexpr VoltageSum voltage_sum(X x) {
    return quantise<N, VoltageSum, Round::truncate, Overflow::wrap>(x);
  }
  /// The applied voltage: the limited part plus the back-EMF.
  template <class X>
  static constexpr Applied applied(X x) {
    return quantise<N, Applied, Round::truncate, Overflow::wrap>(x);
  }
  /// The applied voltage as the port shows it, narrowed to the port's format.
  template <class X>
  static constexpr Voltage port_voltage(X v) {
    return quantise<N, Voltage, Round::truncate, Overflow::saturate>(v);
  }
  /// x limited to [-limit, limit], as a To; sets *hit to whether x was outside.
  template <class To, int PortKey = D::f.limiter.key(), class X, class Limit>
  static constexpr To limited(X x, Limit limit, bool* hit) {
    return LimiterLaw<D, N>::template limited<To, PortKey>(x, limit, hit);
  }
  /// Whether tau_ref lies in the high-torque region; a tau_ref at the border does not.
  template <class X, class Border>
  static constexpr bool region_high(X tau_ref, Border border) {
    return beyond(tau_ref, border);
  }
};

/// The limits that act in this tick.
struct ControlLimits {
  bool current = false;
  bool voltage = false;
  bool duty = false;
};

/// One tick of torque control; computes current, voltage and duty. `w`: the parameters, a
/// ParameterReader. In voltage mode the voltage of the tick before is the state of its ramp.
/// Torques and velocity are the chain's, or fixed-point numbers with more fraction bits (error
/// budgets).
template <class D, class N>
struct TorqueControlStep {
  using Law = TorqueControlLaw<D, N>;
  using A = typename D::A;
  typename Law::Current current{};
  typename Law::Applied applied{};  ///< the voltage before it is narrowed for the port
  typename Law::Voltage voltage{};
  typename Law::Duty duty{};
  ControlLimits limit;
  bool region_high = false;

  /// What brushes and dead time take at this torque.
  template <class W, class TauRef>
  static typename Law::LimitedVoltage dead_voltage(const W& w, TauRef tau_ref) {
    bool unused = false;
    return Law::template limited<typename Law::LimitedVoltage>(
        Law::voltage_part(tau_ref * w.dead_voltage_slope()),
        w.template get<Law::kVoltageKey>(A::dead_voltage), &unused);
  }

  template <class W, class TauRef, class TauHat, class Velocity>
  void tick(const W& w, bool armed, Mode mode, TauRef tau_ref, TauHat tau_hat, Velocity velocity) {
    const bool direct = mode == Mode::voltage;
    typename Law::CurrentSum current_sum{};
    region_high = Law::region_high(tau_ref, w.template get<Law::kBorderKey>(A::region_torque));
    if (direct) {
      current_sum = Law::current_sum(voltage * w.voltage_to_current());
    } else {
      const auto by_ref = Law::current_part(tau_ref * w.torque_gain());
      const auto by_hat = mode == Mode::open_loop ? typename Law::CurrentPart{}
                                                  : Law::current_part(tau_hat * w.observer_gain());
      current_sum = Law::current_sum(by_ref + by_hat);
    }
    current = Law::template limited<typename Law::Current>(
        current_sum, w.template get<Law::kCurrentKey>(A::current_limit), &limit.current);
    if (!armed) {
      current = typename Law::Current{};
      limit.current = false;
    }
    const auto emf = Law::emf(velocity * w.emf_constant());
    typename Law::VoltageSum asked{};  // without the back-EMF
    if (direct) {
      bool unused = false;
      const auto step = Law::template limited<typename Law::VoltageChange>(
          w.voltage_setpoint() - voltage, w.template get<Law::kVoltageKey>(A::voltage_step),
          &unused);
      asked = Law::voltage_sum(voltage + step - emf);
    } else {
      const auto dead = dead_voltage(w, tau_ref);
      // Both words are read: a choice between addresses would keep lanes from running in parallel.
      const auto gain = w.voltage_gain();
      const auto gain_high = w.voltage_gain_high();
      const auto resistive = Law::voltage_part(current * (region_high ? gain_high : gain));
      if constexpr (D::emf_in_law != 0) {
        asked = Law::voltage_sum(resistive + dead);
      } else {
        asked = Law::voltage_sum(resistive + dead - emf);
      }
    }
    const auto inside = Law::template limited<typename Law::LimitedVoltage, D::f.voltage.key()>(
        asked, w.template get<Law::kVoltageKey>(A::voltage_window), &limit.voltage);
    applied = Law::applied(inside + emf);
    if (!armed) {
      applied = typename Law::Applied{};
      limit.voltage = false;
    }
    voltage = Law::port_voltage(applied);
    duty = Law::template limited<typename Law::Duty, D::f.duty.key()>(
        Law::duty_sum(applied * w.duty_gain()), w.template get<Law::kDutyKey>(A::duty_limit),
        &limit.duty);
  }
};

}  // namespace feltgate
