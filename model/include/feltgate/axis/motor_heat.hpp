// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/safety/motor_heat.sv, a cause of fault: the motor gets too hot (I2t). Once a tick
//   I = V/R - Ke/R * w, with voltage and velocity of the tick before, or a measured one;
//   sum = max(sum - Inom^2, 0) + I^2, with I = 0 while disarmed.
// A reset does not clear the sum: the motor stays hot. docs/blocks/safety.md
#pragma once

#include <algorithm>

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

template <class N>
struct MotorHeat {
  using T = typename N::T;
  static constexpr int summed = 6;  ///< at[6]: the sum is new, and it trips
  struct State {
    T current = 0;  ///< A, estimated
  };

  explicit MotorHeat(const Design& d)
      : part(d["CURRENT_ESTIMATE_PART_F"]),
        by_voltage(part - d["VOLTAGE_F"] - d["P_INVERSE_RESISTANCE_F"]),
        by_velocity(part - d["VELOCITY_F"] - d["P_EMF_OVER_RESISTANCE_F"]),
        by_current(d["CURRENT_ESTIMATE_F"] - d["CURRENT_F"]),
        squared(d["CURRENT_SQUARED_F"] - 2 * d["CURRENT_ESTIMATE_F"]),
        start(N::integer(d.wide("I2T_START"), 0, d["I2T_F"])),
        full(N::integer(std::int64_t{1} << d["I2T_W"], 0, d["I2T_F"])) {}

  State tick(const Words<T>& p, T voltage, T velocity) const {
    return {N::scale(voltage * p.inverse_resistance, by_voltage) -
            N::scale(velocity * p.emf_over_resistance, by_velocity)};
  }
  /// A measured current, in the estimate's format.
  T measured(T current) const { return N::scale(current, by_current); }
  /// The sum's step; whether it trips.
  bool heat(T& sum, const Words<T>& p, bool armed, T current) const {
    const bool hot = sum >= p.i2t_budget;
    const T square = armed && sum < full ? N::scale(current * current, squared) : T{0};
    sum = std::max(sum - p.nominal_current_squared, T{0}) + square;
    return hot;
  }
  template <class At>
  static void show(const At& a, const State& from, State& to) {
    if (a.at(2)) to = from;
  }

  int part;
  Exponent by_voltage, by_velocity, by_current, squared;
  T start, full;
};

}  // namespace feltgate::axis
