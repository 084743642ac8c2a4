// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/tick_counter.hpp"

#include "ports/tick_counter.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::tick_counter> {
  void clock(const In&) { block.clock(design()["CLOCKS_PER_TICK"]); }
  Out out(const In&) const { return {block.at, block.sample, block.last, block.count}; }

  TickCounter block;
};

}  // namespace

TEST_CASE("tick_counter: RTL and twin, every clock") { lock_step(Twin(), {40'000}); }
