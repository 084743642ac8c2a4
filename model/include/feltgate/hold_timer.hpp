// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/safety/hold_timer.sv: lowers the torque limit after a strong torque was held too
// long against a lever that stands still. Documentation: docs/blocks/supervisor.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// State of the timer, advanced tick by tick.
class HoldTimerLaw {
 public:
  /// One tick. `moved`: an edge came; `strong`: the torque reference is beyond the level that may
  /// be held; `tick`: the tick count; `hold_time`: that parameter word, in units of
  /// 2^hold_unit_bits ticks.
  void tick(bool armed, bool moved, bool strong, std::uint32_t tick, std::uint32_t hold_time) {
    const bool holds = armed && !moved;
    const bool negative = hold_time >> 31 != 0;  // a negative word counts as 0
    const bool over = hold_time < kLongest && units_ >= hold_time;
    const bool expired = negative || over;
    const bool whole = (tick & ((1u << Map::hold_unit_bits) - 1)) == 0;
    derated_ = holds && (derated_ || (strong && expired));
    if (!holds || !strong) {
      units_ = 0;
    } else if (whole) {
      units_ = (units_ + 1) % kLongest;
    }
  }

  /// Whether the lower torque limit is in force.
  bool derated() const { return derated_; }

 private:
  static constexpr std::uint32_t kLongest = 1u << Map::hold_bits;
  std::uint32_t units_ = 0;
  bool derated_ = false;
};

}  // namespace feltgate
