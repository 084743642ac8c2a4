// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/h_bridge.hpp"

#include "ports/h_bridge.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::h_bridge> {
  static Drive drive(const In& in) {
    return {in.drive.gates_enable, in.drive.gates_clear, in.drive.pwm_mode, in.drive.polarity,
            in.drive.current, in.drive.duty};
  }
  void clock(const In& in) { block.clock(drive(in)); }
  Out out(const In& in) const {
    const Bridge b = block.out();
    const auto& g = block.gates();
    const bool on = !in.drive.gates_clear;
    return {{b.measured, b.period_start, b.duty_active, b.current, b.why},
            on && g.gate_a_hi, on && g.gate_a_lo, on && g.gate_b_hi, on && g.gate_b_lo};
  }
  /// The stop clears the gates without a clock.
  static void asynchronous(In& between, const In& in) { between.drive.gates_clear = in.drive.gates_clear; }

  HBridge block{design()};
};

}  // namespace

TEST_CASE("h_bridge: RTL and twin, every clock") {
  lock_step(Twin(), {1'600'000, 8, 20'000, "bridge.measured bridge.current bridge.why"});
}
