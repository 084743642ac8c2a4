// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/safety/polarity.sv, a cause of fault: the motor or the encoder is connected the wrong
// way round. In runaway_windows windows of polarity_ticks on end the speed against the commanded
// current has grown by more than polarity_speed. docs/blocks/safety.md
#pragma once

#include <algorithm>

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

template <class N>
struct Polarity {
  using T = typename N::T;
  struct State {
    T begin = 0;         ///< velocity at the window's begin
    int ticks = 0;       ///< of the window, this one included
    unsigned grown = 0;  ///< bits: in the windows before
  };
  struct Judged {
    State next;
    bool trip = false;
  };

  explicit Polarity(const Design& d)
      : drop(std::max(d["VELOCITY_F"] - Map::growth_bits, 0)), w(d["VELOCITY_W"]) {}

  /// In the clock after the velocity and the scene's torque are new; `current` is that of the tick
  /// before.
  [[gnu::always_inline]] Judged tick(const State& s, const Words<T>& p, bool open, T velocity,
                                     T current) const {
    const bool expired = static_cast<T>(s.ticks) >= p.polarity_ticks;
    const bool against =
        open && N::beyond(current, p.polarity_current) && (velocity < 0) != (current < 0);
    if (against && !expired) return {{s.begin, s.ticks + 1, s.grown}, false};
    const T now = N::truncated(velocity, drop);
    if (!against) return {{now, 1, 0}, false};
    const T gained = N::wrapped(now - s.begin, w);
    const bool grows = N::beyond(gained, p.polarity_speed) && (gained < 0) == (velocity < 0);
    return {{now, 1, grows ? (s.grown << 1 | 1) & all : 0}, grows && s.grown == all};
  }
  /// The next tick may trip.
  bool near(const State& s, const Words<T>& p) const {
    return s.grown == all && static_cast<T>(s.ticks) >= p.polarity_ticks;
  }

  static constexpr unsigned all = (1U << (Map::runaway_windows - 1)) - 1;
  int drop, w;
};

}  // namespace feltgate::axis
