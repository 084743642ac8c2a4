// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/observer.hpp"

#include "feltgate/axis/clocked.hpp"
#include "ports/observer.hpp"

namespace feltgate::test {
namespace {

struct Twin : BlockTwin<ports::observer> {
  Observer<Fixed> law{design()};
  Clocked<Observer<Fixed>> block;

  static constexpr int holds = Observer<Fixed>::latency;
  static void strobes(In& in, int clock) { in.start = clock == 0; }
  void clock(const In& in) {
    block.clock(in.start, [&] {
      return law.tick(block.state, in.p, in.armed, in.current, in.velocity);
    });
  }
  Out out(const In&) const {
    return {block.shown.tau_hat, block.shown.saturated, block.valid(law.latency)};
  }
};

}  // namespace

TEST_CASE("observer: RTL and twin, every clock") { lock_step(Twin()); }

}  // namespace feltgate::test
