// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/overspeed.hpp"

#include "ports/overspeed.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::overspeed> {
  static constexpr int holds = 2;
  static void strobes(In& in, int clock) { in.start = clock == 0; }
  /// Limits near the velocity.
  void legal(In& in, Random& random) {
    const std::int64_t speed = std::abs(std::int64_t{in.velocity}) + random.between(-1, 1);
    if (random.one_in(4))
      in.p.overspeed = static_cast<std::uint32_t>(std::max<std::int64_t>(speed, 0)) & ~(1U << 31);
  }
  void clock(const In& in) {
    block.clock(in.start, [&] { return law.tick(block.state, in.p, in.velocity); });
  }
  Out out(const In&) const {
    return {block.at(0) && block.state.too_fast, block.at(0) && block.state.jumped};
  }

  Overspeed<Fixed> law{design()};
  Clocked<Overspeed<Fixed>> block;
};

}  // namespace

TEST_CASE("overspeed: RTL and twin, every clock") { lock_step(Twin()); }
