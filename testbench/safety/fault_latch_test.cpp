// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/fault_latch.hpp"

#include "ports/fault_latch.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::fault_latch> {
  void clock(const In& in) { block.clock(in.clear, in.trips); }
  Out out(const In&) const { return {block.faults, block.first}; }

  FaultLatch block;
};

}  // namespace

TEST_CASE("fault_latch: RTL and twin, every clock") { lock_step(Twin()); }
