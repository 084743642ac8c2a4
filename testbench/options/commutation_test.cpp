// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/commutation.hpp"

#include "ports/commutation.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::commutation> {
  static constexpr int holds = Commutation::latency;
  static void strobes(In& in, int clock) { in.sample = clock == 0; }
  void clock(const In& in) {
    block.clock({in.sample, in.count, in.gain, in.offset, in.amplitude, in.polarity});
  }
  Out out(const In&) const {
    const Commutation::Out& o = block.out();
    return {o.on_a, o.on_b, o.on_c, o.valid};
  }

  Commutation block{1000};
};

}  // namespace

TEST_CASE("commutation: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
