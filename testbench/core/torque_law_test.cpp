// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/torque_law.hpp"

#include "ports/torque_law.hpp"

using namespace feltgate::test;

namespace {

struct Twin : TickTwin<ports::torque_law, TorqueLaw<Fixed>> {
  void clock(const In& in) {
    block.clock(in.start, [&] {
      return law.tick(block.state, in.p, in.armed, in.mode, in.tau_ref, in.tau_hat, in.velocity);
    });
  }
  Out out(const In&) const {
    const auto& s = block.shown();
    const std::int64_t feed = block.at(5) ? any_value : s.feed;  // the sum of two that change
    return {s.current,       s.voltage,       feed,         s.duty,
            s.limit_current, s.limit_voltage, s.limit_duty, valid()};
  }
};

}  // namespace

TEST_CASE("torque_law: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
