// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/stop_latch.hpp"

#include "ports/stop_latch.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::stop_latch> {
  void between(const In& in) { block.see(in.stop); }  // a pulse between two edges
  void clock(const In& in) { block.clock(in.stop, in.open, in.fault); }
  Out out(const In& in) const {
    return {block.gates_clear(in.stop), block.stopped(), block.trip(in.open)};
  }
  /// The latch itself has no reset.
  void reset(const In& in) {
    block.clock(in.stop, in.open, in.fault);
    block.reset();
  }

  StopLatch block;
};

}  // namespace

TEST_CASE("stop_latch: RTL and twin, every clock") { lock_step(Twin()); }
