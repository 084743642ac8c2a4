// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/h_bridge.sv, a bridge socket: two legs by the voltage law, without a measured
// current. docs/blocks/pwm.md
#pragma once

#include "feltgate/axis/design.hpp"
#include "feltgate/axis/signals.hpp"
#include "feltgate/axis/words.hpp"
#include "feltgate/core_gates.hpp"

namespace feltgate::axis {

class HBridge {
 public:
  explicit HBridge(const Design& d)
      : gates_(d["PWM_PERIOD"], d["DEAD_CLOCKS"], d["SHORTEST_CLOCKS"]) {}

  const Bridge& out() const { return out_; }
  /// Bit 0 leg A high, bit 1 leg A low, then B.
  unsigned gates() const { return gates_.bits(); }
  GateCounts gate_clocks() const { return gates_.on_clocks(); }
  int on_time(std::size_t) const { return 0; }  ///< only of three legs
  bool modulator_clock() const { return false; }
  void clock(const Pins&, const Drive& drive, const Words<std::int64_t>&, const Rotor&) {
    run(drive, 1);
  }
  /// Whether nothing changes in the next `clocks` clocks; they are then passed.
  bool pass(const Drive& d, int clocks) {
    if (d.gates_clear || !gates_.quiet_for(clocks, d.gates_enable)) return false;
    gates_.pass(clocks);
    return true;
  }
  /// Equals `clocks` calls of clock() with the inputs held.
  void run(const Drive& d, int clocks) {
    gates_.advance({d.gates_clear, d.gates_enable, d.pwm_mode, d.polarity, d.duty}, clocks);
    out_.period_start = gates_.period_start();
    out_.duty_active = gates_.duty_active();
  }
  void reset() {
    gates_.reset();
    out_ = {};
  }
  /// Clocks before the one that samples the duty.
  int clocks_to_duty() const { return gates_.clocks_to_duty(); }

 private:
  CoreGates gates_;
  Bridge out_;
};

}  // namespace feltgate::axis
