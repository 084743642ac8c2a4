// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/polarity.hpp"

#include "ports/polarity.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::polarity> {
  static constexpr int holds = 2;
  static void strobes(In& in, int clock) { in.start = clock == 0; }
  /// Often a lever that runs away: the speed grows against the current, both about as much as the
  /// words say.
  void legal(In& in, Random& random) {
    if (random.one_in(200)) runs_away = random.coin();
    if (random.one_in(50)) ticks = static_cast<std::uint16_t>(random.below(random.coin() ? 4 : 40));
    if (!runs_away) return;
    in.open = in.open || !random.one_in(50);
    in.p.polarity_ticks = ticks;
    in.p.polarity_speed &= 0x3fffff;
    speed += static_cast<std::int32_t>(random.between(-(1 << 15), 1 << 20));
    if (random.one_in(400)) speed = -speed;
    if (std::abs(speed) > 1 << 28) speed = 0;
    in.velocity = speed;
    const std::int64_t gained = Fixed::truncated(speed, law.drop) - state.begin;
    if (random.one_in(3)) {
      in.p.polarity_speed = static_cast<std::uint32_t>(std::abs(gained) + random.between(-1, 1));
    }
    const auto current = static_cast<std::int32_t>(in.p.polarity_current +
                                                   (random.one_in(50) ? random.between(-1, 1) : 1));
    in.current = speed < 0 ? current : -current;
  }
  /// They hold between the edges, too.
  static void asynchronous(In& between, const In& in) { between = in; }
  void clock(const In& in) {
    if (after) state = judged(in).next;
    after = in.start;
  }
  Out out(const In& in) const { return {after && judged(in).trip}; }
  Polarity<Fixed>::Judged judged(const In& in) const {
    return law.tick(state, in.p, in.open, in.velocity, in.current);
  }

  Polarity<Fixed> law{design()};
  Polarity<Fixed>::State state;
  bool after = false, runs_away = false;
  std::uint16_t ticks = 0;
  std::int32_t speed = 0;
};

}  // namespace

TEST_CASE("polarity: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
