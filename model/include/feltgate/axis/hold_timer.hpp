// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/safety/hold_timer.sv: for how long a torque above hold_torque acts on a lever that
// stands still. After hold_time hold_limit limits the torque too. docs/blocks/safety.md
#pragma once

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

template <class N>
struct HoldTimer {
  using T = typename N::T;
  int units = 0;  ///< of 2^hold_unit_bits ticks
  bool derated = false;

  /// One clock after the duty is new.
  void tick(const Words<T>& p, bool armed, std::uint32_t tick_count, T tau_ref, bool moved) {
    const bool holds = armed && !moved, strong = N::beyond(tau_ref, p.hold_torque);
    derated = holds && (derated || (strong && static_cast<T>(units) >= p.hold_time));
    if (!holds || !strong) {
      units = 0;
    } else if ((tick_count & ((1U << Map::hold_unit_bits) - 1)) == 0) {
      units = (units + 1) & ((1 << Map::hold_bits) - 1);
    }
  }
};

}  // namespace feltgate::axis
