// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/current_check.hpp"

#include "ports/current_check.hpp"

using namespace feltgate::test;
using feltgate::CurrentCheck;

namespace {

struct Twin : BlockTwin<ports::current_check> {
  static constexpr int holds = CurrentCheck::kLatencyClocks + 1;
  static void strobes(In& in, int clock) { in.valid = clock == 0; }
  void legal(In& in, Random& random) {
    in.armed = in.armed || !random.one_in(100);
    if (random.one_in(500)) wide = random.coin();
    if (wide) in.margin |= 0xf000;
  }
  void clock(const In& in) {
    block.clock({in.armed, in.valid, in.resistive, in.across, in.current,
                 static_cast<std::int32_t>(in.resistance), static_cast<std::int32_t>(in.margin)});
  }
  Out out(const In&) const { return {block.out().missing}; }

  CurrentCheck block;
  bool wide = false;
};

}  // namespace

TEST_CASE("current_check: RTL and twin, every clock") { lock_step(Twin(), {800'000, 8, 50'000}); }
