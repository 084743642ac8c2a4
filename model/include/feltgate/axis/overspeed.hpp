// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/safety/overspeed.sv, two causes of fault: the velocity is above its limit, and it has
// changed in a tick by more than its low-pass can, which only broken hardware does.
// docs/blocks/safety.md
#pragma once

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

template <class N>
struct Overspeed {
  using T = typename N::T;
  struct State {
    T before = 0;  ///< top bits of the velocity
    bool too_fast = false, jumped = false;
  };

  explicit Overspeed(const Design& d) : Overspeed(d["VELOCITY_W"] + 17 - d["P_VELOCITY_A1_F"], d) {}
  Overspeed(int drop, const Design& d)
      : top(-drop), jumps(N::is_fixed && drop >= 0 && drop <= d["VELOCITY_W"] - 2) {}
  [[gnu::always_inline]] State tick(const State& s, const Words<T>& p, T velocity) const {
    const T now = N::scale(velocity, top);
    return {now, N::beyond(velocity, p.overspeed), jumps && N::beyond(now - s.before, 1)};
  }
  template <class At>
  static void show(const At&, const State&, State&) {}

  Exponent top;
  bool jumps;
};

}  // namespace feltgate::axis
