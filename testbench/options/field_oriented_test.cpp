// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/field_oriented.hpp"

#include "ports/field_oriented.hpp"

using namespace feltgate::test;
using feltgate::FieldOriented;

namespace {

struct Twin : BlockTwin<ports::field_oriented> {
  static constexpr int holds = FieldOriented::kLatencyClocks + 1;
  static void strobes(In& in, int clock) { in.valid = clock == 0; }
  void legal(In& in, Random& random) {
    in.armed = in.armed || !random.one_in(50);
    in.direct = in.direct && random.one_in(10);
    if (random.coin())
      in.limit &= 0x1ffff, in.proportional &= 0xfff, in.current_a >>= 6, in.current_b >>= 6;
    if (random.one_in(20)) still = random.coin();
    if (still) in.current_a = 0;  // an open phase
  }
  void clock(const In& in) {
    block.clock({in.armed, in.valid, in.direct, in.reference, in.current_a, in.current_b, in.emf,
                 in.count, in.gain, in.offset, in.polarity, in.proportional, in.integral,
                 in.limit});
  }
  Out out(const In&) const {
    const FieldOriented::Out& o = block.out();
    return {o.current_q, o.resistive, o.across, o.open, o.on_a, o.on_b, o.on_c, o.valid};
  }

  FieldOriented block{1000};
  bool still = false;
};

}  // namespace

TEST_CASE("field_oriented: RTL and twin, every clock") {
  lock_step(Twin(), {1'600'000, 8, 100'000});
}
