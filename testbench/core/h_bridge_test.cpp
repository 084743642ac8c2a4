// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/h_bridge.hpp"

#include "ports/h_bridge.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::h_bridge> {
  void clock(const In& in) {
    const auto& d = in.drive;
    block.clock({},
                {d.gates_enable, d.gates_clear, d.clear, d.pwm_mode, d.polarity, d.direct, d.sample,
                 d.valid, d.current, d.feed, d.duty},
                {}, {});
  }
  Out out(const In& in) const {
    const Bridge b = block.out();
    const unsigned gates = in.drive.gates_clear ? 0 : block.gates();
    return {{b.measured, b.period_start, b.duty_active, b.current, b.why},
            gates & 1,
            gates >> 1 & 1,
            gates >> 2 & 1,
            gates >> 3 & 1};
  }
  /// The stop clears the gates without a clock.
  static void asynchronous(In& between, const In& in) {
    between.drive.gates_clear = in.drive.gates_clear;
  }

  HBridge block{design()};
};

}  // namespace

TEST_CASE("h_bridge: RTL and twin, every clock") {
  lock_step(Twin(), {800'000, 8, 20'000, "bridge.measured bridge.current bridge.why"});
}
