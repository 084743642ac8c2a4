// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/h_bridge.sv, a bridge socket: two legs by the voltage law, without a measured
// current. docs/blocks/pwm.md
#pragma once

#include <algorithm>

#include "feltgate/axis/design.hpp"
#include "feltgate/axis/signals.hpp"
#include "feltgate/axis/words.hpp"
#include "feltgate/pwm.hpp"

namespace feltgate::axis {

class HBridge {
 public:
  static constexpr bool whole_ticks = true;
  explicit HBridge(const Design& d)
      : pwm_(d["PWM_PERIOD"], d["DEAD_CLOCKS"], d["SHORTEST_CLOCKS"]) {}

  Bridge out() const {
    Bridge b;
    b.period_start = pwm_.out().period_start;
    b.duty_active = pwm_.out().duty_active;
    return b;
  }
  /// Bit 0 leg A high, bit 1 leg A low, then B and C.
  unsigned gates() const {
    const Pwm::Out& o = pwm_.out();
    return unsigned{o.gate_a_hi} | unsigned{o.gate_a_lo} << 1 | unsigned{o.gate_b_hi} << 2 |
           unsigned{o.gate_b_lo} << 3;
  }
  bool modulator_clock() const { return false; }
  void clock(const Pins&, const Drive& drive, const Words<std::int64_t>&, const Rotor&) {
    settle();
    pwm_.clock(at(drive));
  }
  void reset() {
    settle();
    pwm_.reset();
  }

  /// Equals `clocks` calls of clock() with the inputs held.
  void run(const Drive& drive, int clocks) {
    if (clocks <= quiet_ && drive.gates_enable == enable_ && drive.gates_clear == clear_) {
      quiet_ -= clocks;
      skipped_ += clocks;
      return;
    }
    settle();
    const Pwm::In in = at(drive);
    while (clocks > 0) {
      const int quiet = pwm_.quiet_clocks(in);
      if (quiet >= clocks) {
        quiet_ = quiet - clocks;
        skipped_ = clocks;
        enable_ = in.enable;
        clear_ = in.clear;
        return;
      }
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
  int clocks_to_duty() const { return pwm_.clocks_to_duty() - skipped_; }

 private:
  static Pwm::In at(const Drive& d) {
    return {d.gates_clear, d.gates_enable, d.pwm_mode, d.polarity, d.duty};
  }
  void settle() {
    pwm_.skip(skipped_);
    quiet_ = skipped_ = 0;
  }

  Pwm pwm_;
  int quiet_ = 0;    ///< clocks that may still be skipped with this enable and clear
  int skipped_ = 0;  ///< but not yet by pwm_
  bool enable_ = false, clear_ = false;
};

}  // namespace feltgate::axis
