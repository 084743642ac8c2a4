// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/observer.hpp"

#include "ports/observer.hpp"

using namespace feltgate::test;

namespace {

struct Twin : TickTwin<ports::observer, Observer<Fixed>> {
  void clock(const In& in) {
    block.clock(in.start,
                [&] { return law.tick(block.state, in.p, in.armed, in.current, in.velocity); });
  }
  Out out(const In&) const { return {block.shown.tau_hat, block.shown.saturated, valid()}; }
};

}  // namespace

TEST_CASE("observer: RTL and twin, every clock") { lock_step(Twin()); }
