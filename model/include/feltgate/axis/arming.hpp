// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/safety/arming.sv: arms and disarms at the end of a tick, and alone enables the gates.
// docs/blocks/safety.md
#pragma once

#include "feltgate/axis/design.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate::axis {

class Arming {
 public:
  struct In {
    bool host = false;  ///< the host has control, else the panel
    bool host_arm = false, panel_arm = false, disarm = false;
    bool fault = false, stopped = false, kick_missing = false;
    bool wait = false;    ///< a request waits
    bool refuse = false;  ///< a request is refused
  };
  static int wait_ticks(const Design& d) {
    return d["CLOCK_HZ"] / 1000 * Map::arm_wait_ms / d["CLOCKS_PER_TICK"] - 1;
  }

  bool request(const In& in) const { return (in.host ? in.host_arm : in.panel_arm) && !in.disarm; }
  bool handed(const In& in) const { return in.host != host_; }
  /// A request would count.
  bool able(const In& in) const {
    return (in.host ? host_counts_ : panel_counts_) && !(open_ && handed(in));
  }
  bool counts(const In& in) const { return request(in) && able(in); }
  bool ready(const In& in) const {
    return able(in) && !in.fault && !in.stopped && !stopped_ && !in.kick_missing;
  }
  bool may(const In& in, int wait_ticks) const {
    return request(in) && ready(in) &&
           (open_ || (!in.refuse && (handed(in) || waited_ < wait_ticks)));
  }
  /// In the last clock of a tick: armed from the next clock on, unless a cause comes in this clock.
  bool locks(const In& in, int wait_ticks) const { return may(in, wait_ticks) && !in.wait; }
  void clock(bool tick, const In& in, bool trip, int wait_ticks) {
    if (tick) {
      const bool may = this->may(in, wait_ticks) && !trip;
      const bool arms = may && !in.wait, waits = may && in.wait && !open_;
      waited_ = waits && !handed(in) ? waited_ + 1 : 0;
      host_ = in.host;
      host_counts_ = !in.host_arm || (in.host && (arms || waits));
      panel_counts_ = !in.panel_arm || (!in.host && (arms || waits));
      stopped_ = false;
      armed_ = open_ = arms;
    } else {
      stopped_ = stopped_ || in.stopped;
      if (trip) open_ = false;
    }
  }
  bool operator==(const Arming& o) const {
    return host_ == o.host_ && host_counts_ == o.host_counts_ && panel_counts_ == o.panel_counts_ &&
           stopped_ == o.stopped_ && waited_ == o.waited_ && armed_ == o.armed_ && open_ == o.open_;
  }
  bool armed() const { return armed_; }
  bool open() const { return open_; }  ///< the gates are enabled

 private:
  bool host_ = false, host_counts_ = false, panel_counts_ = false, stopped_ = false;
  int waited_ = 0;  ///< ticks
  bool armed_ = false, open_ = false;
};

}  // namespace feltgate::axis
