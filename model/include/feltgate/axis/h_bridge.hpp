// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/h_bridge.sv, a bridge socket: two legs by the voltage law, without a measured
// current. docs/blocks/pwm.md
#pragma once

#include <algorithm>

#include "feltgate/axis/design.hpp"
#include "feltgate/axis/signals.hpp"
#include "feltgate/pwm.hpp"

namespace feltgate {

class HBridge {
 public:
  explicit HBridge(const Design& d)
      : pwm_(d["PWM_PERIOD"], d["DEAD_CLOCKS"], d["SHORTEST_CLOCKS"]) {}

  Bridge out() const {
    Bridge b;
    b.period_start = pwm_.out().period_start;
    b.duty_active = pwm_.out().duty_active;
    return b;
  }
  const Pwm::Out& gates() const { return pwm_.out(); }
  void clock(const Drive& drive) { pwm_.clock(at(drive)); }
  void reset() { pwm_.reset(); }

  /// Equals `clocks` calls of clock() with the inputs held.
  void run(const Drive& drive, int clocks) {
    const Pwm::In in = at(drive);
    while (clocks > 0) {
      const int quiet = std::min(pwm_.quiet_clocks(in), clocks);
      if (quiet > 0) {
        pwm_.skip(quiet);
        clocks -= quiet;
      } else {
        pwm_.clock(in);
        --clocks;
      }
    }
  }
  /// Clocks before the one that samples the duty.
  int clocks_to_duty() const { return pwm_.clocks_to_duty(); }

 private:
  static Pwm::In at(const Drive& d) {
    return {d.gates_clear, d.gates_enable, d.pwm_mode, d.polarity, d.duty};
  }
  Pwm pwm_;
};

}  // namespace feltgate
