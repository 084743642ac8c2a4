// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/safety/watchdog.sv, a cause of fault: the host is silent, no kick in watchdog_ticks
// ticks. It sleeps until the first kick. docs/blocks/safety.md
#pragma once

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

class Watchdog {
 public:
  bool awake() const { return awake_; }  ///< a kick has come
  /// In the clock after start.
  bool trip(bool open) const { return open && awake_ && silent_; }
  template <class T>
  bool near(const Words<T>& p) const {
    return awake_ && static_cast<T>(ticks_) >= p.watchdog_ticks;
  }
  template <class T>
  void start(const Words<T>& p) {
    silent_ = static_cast<T>(ticks_) >= p.watchdog_ticks;
  }
  /// The last clock of a tick.
  void tick(bool open, bool arms, bool kick) {
    awake_ = awake_ || kick;
    ticks_ = open && arms && !kick ? (ticks_ + 1) & ((2U << Map::kickless_bits) - 1) : 0;
  }

 private:
  std::uint32_t ticks_ = 0;  ///< since the last kick, or since arming
  bool silent_ = false, awake_ = false;
};

}  // namespace feltgate::axis
