// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/hold_timer.hpp"

#include "ports/hold_timer.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::hold_timer> {
  static constexpr int holds = 2;
  static void strobes(In& in, int clock) { in.start = clock == 0; }
  /// Mostly the lever stands still, for short times and with torques about the one that is watched;
  /// often a unit passes in every tick.
  void legal(In& in, Random& random) {
    if (random.one_in(300)) unit = random.coin();
    if (unit) in.tick_count &= ~0U << Map::hold_unit_bits;
    if (random.one_in(4)) in.tick_count = 1U << random.below(Map::hold_unit_bits);
    if (!random.one_in(4)) in.p.hold_time &= 7;
    const auto torque = static_cast<std::int32_t>(in.p.hold_torque + random.between(-1, 1));
    if (random.one_in(3)) in.tau_ref = random.coin() ? torque : -torque;
    in.armed = in.armed || !random.one_in(100);
    in.moved = in.moved && random.one_in(100);
  }
  void clock(const In& in) {
    if (after) block.tick(in.p, in.armed, in.tick_count, in.tau_ref, in.moved);
    after = in.start;
  }
  Out out(const In&) const { return {block.derated}; }

  HoldTimer<Fixed> block;
  bool after = false, unit = false;
};

/// The longest time.
struct Longest : Twin {
  void legal(In& in, Random&) {
    in.p.hold_time = (1 << Map::hold_bits) - 1;
    in.p.hold_torque = 0;
    in.tau_ref = -1;
    in.armed = true;
    in.moved = false;
    in.tick_count = 0;
  }
};

}  // namespace

TEST_CASE("hold_timer: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }

TEST_CASE("hold_timer: the longest time") { lock_step(Longest(), {150'000, 1}); }
