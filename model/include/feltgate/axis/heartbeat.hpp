// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/heartbeat.sv, for a watchdog outside: a pin that changes every HEARTBEAT
// ticks, and stands while a fault is latched. A design with HEARTBEAT 0 has no such pin.
// docs/safety.md
#pragma once

#include "feltgate/axis/design.hpp"
#include "feltgate/axis/signals.hpp"

namespace feltgate::axis {

class Heartbeat {
 public:
  explicit Heartbeat(const Design& d) : ticks_(static_cast<std::uint32_t>(d["HEARTBEAT"])) {}
  bool out() const { return out_; }
  void clock(const Tick& tick, int first_fault) {
    if (tick.last) end_tick(tick.count, first_fault);
  }
  void end_tick(std::uint32_t count, int first_fault) {
    if (first_fault == 0) out_ = (count & ticks_) != 0;
  }
  void reset() { out_ = false; }

 private:
  std::uint32_t ticks_;
  bool out_ = false;
};

}  // namespace feltgate::axis
