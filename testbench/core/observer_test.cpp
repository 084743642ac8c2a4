// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/observer.hpp"

#include "ports/observer.hpp"

using namespace feltgate::test;

namespace {

struct Twin : TickTwin<ports::observer, Observer<Fixed>> {
  /// Mostly an armed lever whose speed changes little, so that no load saturates.
  void legal(In& in, Random& random) {
    if (random.one_in(500)) calm = !random.one_in(4);
    if (!calm) return;
    velocity += static_cast<std::int32_t>(random.between(-(1 << 14), 1 << 14));
    in.velocity = velocity;
    in.armed = in.armed || !random.one_in(50);
  }
  void clock(const In& in) {
    block.clock(in.start,
                [&] { return law.tick(block.state, in.p, in.armed, in.current, in.velocity); });
  }
  Out out(const In&) const { return {block.shown().tau_hat, block.shown().saturated, valid()}; }

  bool calm = true;
  std::int32_t velocity = 0;
};

}  // namespace

TEST_CASE("observer: RTL and twin, every clock") { lock_step(Twin()); }
