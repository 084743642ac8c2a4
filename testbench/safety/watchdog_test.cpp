// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/watchdog.hpp"

#include "ports/watchdog.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::watchdog> {
  /// A kick comes with a tick.
  void legal(In& in, Random& random) {
    if (random.one_in(500)) silent = random.coin();
    in.kick = in.kick && in.tick && !silent;
    in.open = in.open || silent;
    in.arms = in.arms || silent;
    in.p.watchdog_ticks &= silent ? 0x1ff : 0xffffff;
  }
  void clock(const In& in) {
    const Words<std::int64_t> p = in.p;
    if (in.start) block.start(p);
    if (in.tick) block.tick(in.open, in.arms, in.kick);
    after = in.start;
  }
  Out out(const In& in) const { return {block.awake(), after && block.trip(in.open)}; }

  Watchdog block;
  bool after = false, silent = false;
};

}  // namespace

TEST_CASE("watchdog: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
