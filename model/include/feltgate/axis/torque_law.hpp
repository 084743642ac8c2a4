// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/torque_law.sv, torque to current, voltage and duty:
//   I = Jn Kp/Ktn * tau_ref + (1 - Jn Kp)/Ktn * tau_hat    limited; tau_hat in closed loop alone
//   V = R * I + Ke * w + dead voltage                      within a window around Ke * w
//   duty = V * period / supply                             limited
// In voltage mode V goes to its set-point by a step a tick, and I = V/R. Disarmed, all are 0.
// docs/blocks/torque_law.md
#pragma once

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

template <class N>
struct TorqueLaw {
  using T = typename N::T;
  static constexpr int latency = 13;
  struct State {
    T current = 0;  ///< A
    T voltage = 0;  ///< V, saturated
    T feed = 0;     ///< V that no current takes: Ke * w + dead voltage
    T duty = 0;     ///< clocks of on-time
    bool limit_current = false, limit_voltage = false, limit_duty = false;
  };

  explicit TorqueLaw(const Design& d)
      : voltage_to_current(d["CURRENT_F"] - d["VOLTAGE_F"] - d["P_VOLTAGE_TO_CURRENT_F"]),
        torque_gain(d["CURRENT_F"] - d["TORQUE_F"] - d["P_TORQUE_GAIN_F"]),
        observer_gain(d["CURRENT_F"] - d["TORQUE_F"] - d["P_OBSERVER_GAIN_F"]),
        dead_slope(d["VOLTAGE_F"] - d["TORQUE_F"] - d["P_DEAD_VOLTAGE_SLOPE_F"]),
        emf_constant(d["VOLTAGE_F"] - d["VELOCITY_F"] - d["P_EMF_CONSTANT_F"]),
        voltage_gain(d["VOLTAGE_F"] - d["CURRENT_F"] - d["P_VOLTAGE_GAIN_F"]),
        duty_gain(d["VOLTAGE_F"] + d["P_DUTY_GAIN_F"], d.rounding()),
        voltage_w(d["VOLTAGE_W"]),
        emf_in_law(d["EMF_IN_LAW"] != 0) {}

  [[gnu::always_inline]] State tick(const State& s, const Words<T>& p, bool armed, int mode,
                                    T tau_ref, T tau_hat, T velocity) const {
    const bool closed = mode != Map::mode_open, direct = mode == Map::mode_voltage;
    State next;
    T asked = 0, offset = 0;
    if (direct) {
      asked = N::scale(s.voltage * p.voltage_to_current, voltage_to_current);
      offset = s.voltage + N::limited(p.voltage_setpoint - s.voltage, p.voltage_step);
    } else {
      asked = N::scale(tau_ref * p.torque_gain, torque_gain);
      if (closed) asked += N::scale(tau_hat * p.observer_gain, observer_gain);
      offset = N::limited(N::scale(tau_ref * p.dead_voltage_slope, dead_slope), p.dead_voltage);
    }
    const T limited = N::limited(asked, p.current_limit);
    next.limit_current = armed && limited != asked;
    next.current = armed ? limited : T{0};

    const T emf = N::scale(velocity * p.emf_constant, emf_constant);
    const bool high = N::beyond(tau_ref, p.region_torque);
    if (direct || !emf_in_law) offset -= emf;
    next.feed = emf + offset;
    if (!direct) {
      offset +=
          N::scale(next.current * (high ? p.voltage_gain_high : p.voltage_gain), voltage_gain);
    }
    const T within = N::limited(offset, p.voltage_window);
    next.limit_voltage = armed && within != offset;
    const T applied = armed ? within + emf : T{0};
    next.voltage = N::saturate(applied, voltage_w);

    const T duty = N::add_rounded(0, applied * p.duty_gain, duty_gain);
    next.duty = N::limited(duty, p.duty_limit);
    next.limit_duty = next.duty != duty;
    return next;
  }
  template <class At>
  static void show(const At& a, const State& from, State& to) {
    if (a.at(3)) {
      to.current = from.current;
      to.limit_current = from.limit_current;
    }
    if (a.at(5)) to.feed = from.feed;
    if (a.at(7)) {
      to.voltage = from.voltage;
      to.limit_voltage = from.limit_voltage;
    }
    if (a.at(11)) {
      to.duty = from.duty;
      to.limit_duty = from.limit_duty;
    }
  }

  Exponent voltage_to_current, torque_gain, observer_gain, dead_slope, emf_constant, voltage_gain;
  Drop duty_gain;
  Bits voltage_w;
  bool emf_in_law;
};

}  // namespace feltgate::axis
