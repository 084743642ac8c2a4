// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/observer.sv: x = Ktn * I + g Jn * w;  y += a1 * (x - y);  tau_hat = y - g Jn * w.
// Disarmed, the current counts as 0 and y follows x. docs/blocks/observer.md
#pragma once

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

template <class N>
struct Observer {
  using T = typename N::T;
  static constexpr int latency = 8;
  struct State {
    T y = 0;
    T tau_hat = 0;  ///< Nm; positive opposes positive motor torque
    bool saturated = false;
  };

  explicit Observer(const Design& d)
      : drive(d["OBSERVER_F"] - d["CURRENT_F"] - d["P_TORQUE_CONSTANT_F"]),
        inertia(d["OBSERVER_F"] - d["VELOCITY_F"] - d["P_INERTIA_GAIN_F"]),
        difference(d["OBSERVER_DIFFERENCE_F"] - d["OBSERVER_F"]),
        a1(d["OBSERVER_DIFFERENCE_F"] + d["P_OBSERVER_A1_F"] - d["OBSERVER_F"], d.rounding()),
        narrow(d["OBSERVER_F"] - d["TORQUE_F"], d.rounding()),
        w(d["TORQUE_W"]) {}

  [[gnu::always_inline]] State tick(const State& s, const Words<T>& p, bool armed, T current,
                                    T velocity) const {
    const T inertial = N::scale(velocity * p.inertia_gain, inertia);
    const T x = (armed ? N::scale(current * p.torque_constant, drive) : T{0}) + inertial;
    const T y = armed ? N::add_rounded(s.y, N::scale(x - s.y, difference) * p.observer_a1, a1) : x;
    const T observed = N::add_rounded(0, y - inertial, narrow);
    const T tau_hat = N::saturate(observed, w);
    return {y, tau_hat, tau_hat != observed};
  }
  template <class At>
  static void show(const At& a, const State& from, State& to) {
    if (a.at(6)) to = from;
  }

  Exponent drive, inertia, difference;
  Drop a1, narrow;
  Bits w;
};

}  // namespace feltgate::axis
