// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/torque_control.sv: torque reference to current, voltage and duty.
//   I = Jn*Kp/Ktn * tau_ref + (1 - Jn*Kp)/Ktn * tau_hat        limited, shown to the observer
//   V = gain*I + Ke*w + dead voltage                           limited
//   duty = V * period/supply                                   limited
// Documentation: docs/blocks/torque_control.md
#pragma once

#include <cstdint>

#include "feltgate/numbers.hpp"

namespace feltgate {

/// What the control word's mode bits mean.
enum class Mode : std::uint8_t {
  closed_loop = 0,  ///< tau_hat is fed back
  open_loop = 1,    ///< tau_hat is not fed back
  voltage = 2  ///< the voltage set-point replaces the law; the observer sees V * voltage_to_current
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
  /// What the voltage starts from: a part, or in voltage mode the set-point.
  static constexpr Format offset_format{
      1, growth::max_of(D::f.voltage_part.integer, D::f.voltage.integer), D::f.voltage.fraction};
  using Offset = typename N::template num<offset_format.key()>;
  using Duty = typename N::template num<D::f.duty.key()>;
  using DutySum = typename N::template num<D::f.duty_sum.key()>;

  // One limiter, as wide as the current, reads every limit and border at the sum's binary point.
  static constexpr int kLimiterBits = D::f.current.width();
  static constexpr int kCurrentKey = D::f.current.key();
  static constexpr int kBorderKey =
      Format{1, kLimiterBits - 1 - D::f.torque.fraction, D::f.torque.fraction}.key();
  static constexpr int kVoltageKey =
      Format{1, kLimiterBits - 1 - D::f.voltage.fraction, D::f.voltage.fraction}.key();
  static constexpr int kDutyKey = Format{1, kLimiterBits - 1, 0}.key();
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
  /// Clocks of on-time, rounded.
  template <class Product>
  static constexpr DutySum duty_sum(Product p) {
    return quantise<N, DutySum, D::rounding, Overflow::wrap>(p);
  }
  /// The set-point, or one product of the voltage truncated.
  template <class X>
  static constexpr Offset offset(X x) {
    return quantise<N, Offset, Round::truncate, Overflow::wrap>(x);
  }
  /// A part, or the exact sum of parts, as the adder holds it; it fits by construction of the
  /// formats.
  template <class X>
  static constexpr CurrentSum current_sum(X x) {
    return quantise<N, CurrentSum, Round::truncate, Overflow::wrap>(x);
  }
  template <class X>
  static constexpr VoltageSum voltage_sum(X x) {
    return quantise<N, VoltageSum, Round::truncate, Overflow::wrap>(x);
  }
  /// The limited voltage as the port shows it; the same number while the limit is in its format.
  static constexpr Voltage port_voltage(LimitedVoltage v) {
    return quantise<N, Voltage, Round::truncate, Overflow::wrap>(v);
  }
  /// x in [-limit, limit] and in the format Key. A negative limit gives the limit itself.
  template <int Key, class X, class Limit>
  static constexpr typename N::template num<Key> limited(X x, Limit limit, bool* hit) {
    *hit = beyond<N>(x, limit);
    if (x > limit) return quantise<N, Key, Round::truncate, Overflow::wrap>(limit);
    if (x < -limit) return quantise<N, Key, Round::truncate, Overflow::wrap>(-limit);
    return quantise<N, Key, Round::truncate, Overflow::wrap>(x);
  }
  /// Whether tau_ref lies in the high-torque region; at the border the low one holds.
  template <class X, class Border>
  static constexpr bool region_high(X tau_ref, Border border) {
    return beyond<N>(tau_ref, border);
  }
};

/// The limits that hold in this tick.
struct ControlLimits {
  bool current = false;
  bool voltage = false;
  bool duty = false;
};

/// One tick of torque control. W gives the parameters: a ParameterReader.
/// Writes current, voltage and duty; in voltage mode the voltage set-point is limited too. Torques
/// and velocity are the chain's, or fixed-point numbers with more fraction bits (error budgets).
template <class D, class N>
struct TorqueControlStep {
  using Law = TorqueControlLaw<D, N>;
  using A = typename D::A;
  typename Law::Current current{};
  typename Law::Voltage voltage{};
  typename Law::Duty duty{};
  ControlLimits limit;
  bool region_high = false;

  template <class W, class TauRef, class TauHat, class Velocity>
  void tick(const W& w, bool armed, Mode mode, TauRef tau_ref, TauHat tau_hat, Velocity velocity) {
    const bool direct = mode == Mode::voltage;
    typename Law::CurrentSum current_sum{};
    region_high = Law::region_high(tau_ref, w.template get<Law::kBorderKey>(A::region_torque));
    if (direct) {
      voltage = w.voltage_setpoint();
      current_sum = Law::current_sum(voltage * w.voltage_to_current());
    } else {
      const auto by_ref = Law::current_part(tau_ref * w.torque_gain());
      const auto by_hat = mode == Mode::open_loop ? typename Law::CurrentPart{}
                                                  : Law::current_part(tau_hat * w.observer_gain());
      current_sum = Law::current_sum(by_ref + by_hat);
    }
    current =
        Law::template limited<D::f.current.key()>(current_sum, w.current_limit(), &limit.current);
    if (!armed) {
      current = typename Law::Current{};
      limit.current = false;
    }
    typename Law::Offset offset{};
    typename Law::VoltagePart slope{};
    if (direct) {
      offset = Law::offset(voltage);
    } else {
      offset = Law::offset(velocity * w.emf_constant());
      slope = Law::voltage_part(tau_ref * w.dead_voltage_slope());
    }
    bool linear = false;
    const auto dead = Law::template limited<Law::kVoltageKey>(
        slope, w.template get<Law::kVoltageKey>(A::dead_voltage), &linear);
    const auto pair = offset + dead;
    typename Law::VoltageSum voltage_sum{};
    if (direct) {
      voltage_sum = Law::voltage_sum(pair);
    } else {
      // Both are read: a choice between addresses would keep lanes from running side by side.
      const auto gain = w.voltage_gain();
      const auto gain_high = w.voltage_gain_high();
      const auto resistive = Law::voltage_part(current * (region_high ? gain_high : gain));
      voltage_sum = Law::voltage_sum(resistive + pair);
    }
    auto applied = Law::template limited<Law::kVoltageKey>(
        voltage_sum, w.template get<Law::kVoltageKey>(A::voltage_limit), &limit.voltage);
    if (!armed) {
      applied = {};
      limit.voltage = false;
    }
    voltage = Law::port_voltage(applied);
    duty = Law::template limited<D::f.duty.key()>(Law::duty_sum(applied * w.duty_gain()),
                                                  w.template get<Law::kDutyKey>(A::duty_limit),
                                                  &limit.duty);
  }
};

/// Clocked twin. `wave` is the clock of the wave, -1 between waves.
template <class D>
class TorqueControl {
 public:
  using Law = TorqueControlLaw<D, Fixed>;
  using P = typename D::P;
  template <int Key>
  using Word = fixed_of<Key>;

  struct In {
    bool armed = false;
    Mode mode = Mode::closed_loop;
    int wave = -1;
    std::int64_t param = 0;    ///< parameter bus
    std::int64_t product = 0;  ///< of the operands four clocks ago
    std::int64_t tau_ref = 0;
  };
  struct Out {
    bool region_high = false;
    std::int64_t operand = 0;  ///< I in clock 34, V in clock 40
    std::int64_t current_ref = 0;
    std::int64_t voltage = 0;
    std::int64_t duty = 0;
    ControlLimits limit;
  };

  void reset() { *this = TorqueControl{}; }

  void clock(const In& in) {
    const bool direct = in.mode == Mode::voltage;
    switch (in.wave) {
      case 24:
        if (direct) voltage_ = word<D::f.voltage.key()>(in.param);
        break;
      case 26:
        offset_ = direct ? Law::offset(voltage_)
                         : Law::offset(product<D::f.velocity.key(), P::emf_constant.key()>(in));
        break;
      case 27:
        kept_ = in.mode == Mode::open_loop
                    ? CurrentPart{}
                    : Law::current_part(product<D::f.torque.key(), P::observer_gain.key()>(in));
        break;
      case 30:
        out_.region_high =
            Law::region_high(Torque::from_raw(in.tau_ref), word<Law::kBorderKey>(in.param));
        break;
      case 31:
        current_sum_ =
            Law::current_sum(product<D::f.voltage.key(), P::voltage_to_current.key()>(in));
        break;
      case 32:
        if (!direct) {
          current_sum_ = Law::current_sum(
              Law::current_part(product<D::f.torque.key(), P::torque_gain.key()>(in)) + kept_);
        }
        break;
      case 33:
        limit_current(in);
        break;
      case 35:
        dead_ = limited<Law::kVoltageKey>(voltage_sum_, in, nullptr);
        out_.operand = dead_.raw();
        break;
      case 36:
        voltage_sum_ = Law::voltage_sum(offset_ + dead_);
        break;
      case 38:
        if (!direct) {
          voltage_sum_ = Law::voltage_sum(
              Law::voltage_part(product<D::f.current.key(), P::voltage_gain.key()>(in)) +
              voltage_sum_);
        }
        break;
      case 39:
        limit_voltage(in);
        break;
      case 44:
        duty_sum_ = Law::duty_sum(product<Law::kVoltageKey, P::duty_gain.key()>(in));
        break;
      case 45:
        out_.duty = narrow<Duty, Round::truncate, Overflow::wrap>(
                        limited<Law::kDutyKey>(duty_sum_, in, &out_.limit.duty))
                        .raw();
        break;
      default:
        break;
    }
    out_.voltage = voltage_.raw();
  }

  const Out& out() const { return out_; }

 private:
  using CurrentPart = typename Law::CurrentPart;
  using Offset = typename Law::Offset;
  using CurrentSum = typename Law::CurrentSum;
  using VoltageSum = typename Law::VoltageSum;
  using DutySum = typename Law::DutySum;

  using Torque = typename Law::Torque;
  using Duty = typename Law::Duty;

  /// The low bits of a word of the bus as a number.
  template <int Key>
  static Word<Key> word(std::int64_t raw) {
    return narrow<Word<Key>, Round::truncate, Overflow::wrap>(
        fixed<1, 63 - Word<Key>::format.fraction, Word<Key>::format.fraction>::from_raw(raw));
  }
  /// The product on the bus as the number it is: a signal times a coefficient.
  template <int SignalKey, int CoefficientKey>
  static auto product(const In& in) {
    return decltype(Word<SignalKey>{} * Word<CoefficientKey>{})::from_raw(in.product);
  }
  /// x limited by the word on the bus.
  template <int Key, class X>
  static Word<Key> limited(X x, const In& in, bool* hit) {
    bool unused = false;
    return Law::template limited<Key>(x, word<Key>(in.param), hit != nullptr ? hit : &unused);
  }

  void limit_current(const In& in) {
    auto current = limited<Law::kCurrentKey>(current_sum_, in, &out_.limit.current);
    if (!in.armed) {
      current = {};
      out_.limit.current = false;
    }
    out_.current_ref = out_.operand = current.raw();
    voltage_sum_ = in.mode == Mode::voltage
                       ? VoltageSum{}
                       : Law::voltage_sum(Law::voltage_part(
                             product<D::f.torque.key(), P::dead_voltage_slope.key()>(in)));
  }

  void limit_voltage(const In& in) {
    auto applied = limited<Law::kVoltageKey>(voltage_sum_, in, &out_.limit.voltage);
    if (!in.armed) {
      applied = {};
      out_.limit.voltage = false;
    }
    out_.operand = applied.raw();
    voltage_ = Law::port_voltage(applied);
  }

  typename Law::Voltage voltage_{};
  typename Law::LimitedVoltage dead_{};
  CurrentSum current_sum_{};
  CurrentPart kept_{};
  VoltageSum voltage_sum_{};
  Offset offset_{};
  DutySum duty_sum_{};
  Out out_;
};

}  // namespace feltgate
