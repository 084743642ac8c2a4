// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/safety/tick_monitor.sv, a cause of fault: the ticks stand still. It trips where one
// period of the PWM more begins without a tick than a tick can take. docs/blocks/safety.md
#pragma once

#include "feltgate/axis/design.hpp"

namespace feltgate::axis {

class TickMonitor {
 public:
  static int most(const Design& d) {
    return (d["CLOCKS_PER_TICK"] + d["PWM_PERIOD"] - 1) / d["PWM_PERIOD"];
  }
  bool trip(bool period_start, int most) const { return period_start && periods_ == most; }
  void clock(bool tick, bool period_start, int most) {
    if (tick && !tick_) {
      periods_ = 0;
    } else if (period_start && periods_ != most) {
      ++periods_;
    }
    tick_ = tick;
  }

 private:
  int periods_ = 0;  ///< that began since the last tick
  bool tick_ = false;
};

}  // namespace feltgate::axis
