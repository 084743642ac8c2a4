// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/heartbeat.hpp"

#include "ports/heartbeat.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::heartbeat> {
  void clock(const In& in) {
    Tick tick;
    tick.last = in.tick.last;
    tick.count = in.tick.count;
    block.clock(tick, in.safety.first_fault);
  }
  Out out(const In&) const { return {block.out()}; }

  Heartbeat block{design()};
};

}  // namespace

TEST_CASE("heartbeat: RTL and twin, every clock") { lock_step(Twin()); }
