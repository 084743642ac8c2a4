// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/ramp.hpp"

#include "ports/ramp.hpp"

using namespace feltgate::test;

namespace {

struct Twin : TickTwin<ports::ramp, Ramp<Fixed>> {
  static constexpr int start_clock = 2, holds = start_clock + Ramp<Fixed>::latency;
  static void strobes(In& in, int clock) {
    in.sample = clock == 0;
    in.start = clock == start_clock;
    in.restart = in.restart && clock >= holds;
  }
  void clock(const In& in) {
    if (in.sample) limit_hold = in.derated;
    block.clock(in.start, [&] {
      return law.tick(block.state, in.p,
                      {in.armed, in.scene, in.frozen, in.derated, in.testing, in.torque});
    });
    if (in.start) block.showing().limit_torque = block.state.limit_torque;
    if (in.restart) block.state.ramping = true;
  }
  Out out(const In&) const {
    const auto& s = block.shown();
    return {s.tau_ref, s.limit_torque, s.limit_ramp, limit_hold, valid()};
  }

  bool limit_hold = false;
};

}  // namespace

TEST_CASE("ramp: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
