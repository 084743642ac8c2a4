// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/ramp.sv: limits the torque of the scene and ramps it. After arming, a change of
// scene, of the limit after a long hold, or a restart, tau_ref moves by at most a step a tick until
// it has reached the scene's torque. Frozen, it may only shrink. docs/blocks/ramp.md
#pragma once

#include <algorithm>

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

template <class N>
struct Ramp {
  using T = typename N::T;
  static constexpr int latency = 3;
  struct State {
    T ramp = 0;  ///< tau_ref with the ramp's fraction
    T tau_ref = 0;
    int scene = 0;
    bool ramping = true;
    bool limit_torque = false, limit_ramp = false, limit_hold = false;
  };
  struct In {
    bool armed = false;
    int scene = 0;
    bool frozen = false, derated = false, testing = false;
    T torque = 0;
  };

  explicit Ramp(const Design& d)
      : fine(d["RAMP_F"] - d["TORQUE_F"]),
        coarse(d["TORQUE_F"] - d["RAMP_F"]),
        least(N::integer(T{1}, 0, d["RAMP_F"])) {}

  [[gnu::always_inline]] State tick(const State& s, const Words<T>& p, const In& in) const {
    State next = s;
    next.scene = in.scene;
    next.limit_hold = in.derated;
    const bool ramping =
        s.ramping || !in.armed || in.scene != s.scene || in.derated != s.limit_hold;

    T limit = p.torque_limit;
    if (in.derated) limit = std::min(limit, p.hold_limit);
    if (in.testing) limit = std::min(limit, p.self_test_torque);
    const T limited = N::limited(in.torque, limit), target = N::scale(limited, fine);
    next.limit_torque = in.armed && limited != in.torque;
    const T excess = s.ramp - target;
    const bool down = !(excess < 0), frozen = in.frozen && in.armed;
    const T step = in.frozen ? T{0} : p.ramp_step == 0 ? least : p.ramp_step;
    const bool reached = (down ? excess : -excess) <= step;
    // Frozen, a reference stays that would grow or change its sign.
    const bool stepping = (ramping && in.armed) ||
                          (frozen && (down ? s.ramp < 0 || target < 0 : s.ramp >= 0 || target > 0));
    next.limit_ramp = stepping;
    if (!stepping) {
      next.ramp = target;
    } else if (!reached) {
      next.ramp = down ? s.ramp - step : s.ramp + step;
    }
    next.ramping = ramping && !(stepping && reached);
    next.tau_ref = N::scale(next.ramp, coarse);
    return next;
  }
  template <class At>
  static void show(const At& a, const State& from, State& to) {
    if (a.at(1)) to = from;
  }

  Exponent fine, coarse;
  T least;  ///< 1 LSB
};

}  // namespace feltgate::axis
