// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/self_test.hpp"

#include "ports/self_test.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::self_test> {
  static constexpr int holds = 4;
  static void strobes(In& in, int clock) {
    in.sample = clock == 0;
    in.start = clock == 2;
  }
  /// Short times; the lever stands still, moves with the pulse or against it, or as it likes.
  void legal(In& in, Random& random) {
    if (random.one_in(60)) motion = static_cast<int>(random.below(4));
    if (random.one_in(200)) armed = random.coin();
    in.armed = armed;
    in.direct = in.direct && random.one_in(20);
    in.waits = in.waits && random.one_in(4);
    count += 1U << (random.one_in(100) ? Map::self_test_patience_bits : Map::self_test_unit_bits);
    if (!random.one_in(3)) in.tick_count = count;
    if (!random.one_in(8)) in.p.self_test_quiet &= 3;
    if (!random.one_in(8)) in.p.self_test_pulse &= 7;
    const int along = block.pulse();
    if (motion < 3)
      travel += motion == 0 ? 0 : motion == 1 ? along : -along;
    else
      travel += static_cast<int>(random.below(4));
    in.travel = travel & 3;
  }
  void clock(const In& in) {
    const Words<std::int64_t> p = in.p;
    if (in.start) block.start(p, in.armed, in.direct, in.waits, in.tick_count);
    if (in.sample) block.sample(static_cast<unsigned>(in.travel));
    after = in.start;
  }
  Out out(const In& in) const {
    const std::int64_t end = std::int64_t{1} << (design()["SCENE_TORQUE_W"] - 1);
    const int pulse = block.pulse();
    return {block.busy(in.armed), pulse > 0 ? end - 1 : pulse * end, block.result(),
            after && block.failed()};
  }

  SelfTest block;
  bool after = false, armed = false;
  int motion = 0, travel = 0;
  std::uint32_t count = 0;
};

/// Times that only the end of the count reaches.
struct Longest : Twin {
  void legal(In& in, Random& random) {
    Twin::legal(in, random);
    in.armed = armed = at++ > 10;
    in.p.self_test_quiet = in.p.self_test_pulse = 255;
    in.direct = in.waits = false;
    in.p.self_test_arms = 0;
    in.travel = 0;
    in.tick_count = static_cast<std::uint32_t>(at) << Map::self_test_unit_bits & 0xffff;
  }
  int at = 0;
};

}  // namespace

TEST_CASE("self_test: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }

TEST_CASE("self_test: the longest times") { lock_step(Longest(), {20'000, 1}); }
