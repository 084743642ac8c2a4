// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/tick_monitor.hpp"

#include "ports/tick_monitor.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::tick_monitor> {
  void clock(const In& in) { block.clock(in.tick, in.period_start, most); }
  Out out(const In& in) const { return {block.trip(in.period_start, most)}; }

  TickMonitor block;
  int most = TickMonitor::most(design());
};

}  // namespace

TEST_CASE("tick_monitor: RTL and twin, every clock") { lock_step(Twin()); }
