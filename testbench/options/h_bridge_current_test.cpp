// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/h_bridge_current.hpp"

#include "ports/h_bridge_current.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::h_bridge_current> {
  /// An offset is measured before the gates are enabled for the first time, and at times again.
  void legal(In& in, Random& random) {
    if (random.one_in(20'000)) armed = random.coin();
    in.drive.gates_enable = armed && clocks++ > 230'000;
    in.drive.gates_clear = in.drive.gates_clear && random.one_in(1000);
    in.driver_fault = in.driver_fault && random.one_in(1000);
    in.drive.valid = in.drive.valid || random.one_in(50);
  }
  static Drive drive(const In& in) {
    const auto& d = in.drive;
    return {d.gates_enable, d.gates_clear, d.clear,   d.pwm_mode, d.polarity, d.direct,
            d.sample,       d.valid,       d.current, d.feed,     d.duty};
  }
  void clock(const In& in) {
    Pins pins;
    pins.current_data = in.current_data;
    pins.driver_fault = in.driver_fault;
    block.clock(pins, drive(in), in.p, {});
  }
  Out out(const In& in) const {
    const Bridge b = block.out();
    const unsigned gates = in.drive.gates_clear ? 0 : block.gates();
    return {block.modulator_clock(), {b.measured, b.period_start, b.duty_active, b.current, b.why},
            gates >> 0 & 1,          gates >> 1 & 1,
            gates >> 2 & 1,          gates >> 3 & 1};
  }
  /// The stop clears the gates without a clock.
  static void asynchronous(In& between, const In& in) {
    between.drive.gates_clear = in.drive.gates_clear;
  }

  HBridgeCurrent block{design()};
  bool armed = true;
  int clocks = 0;
};

}  // namespace

TEST_CASE("h_bridge_current: RTL and twin, every clock") {
  lock_step(Twin(), {1'600'000, 3, 1'000'000, "bridge.measured"});
}
