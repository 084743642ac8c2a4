// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/absolute.hpp"

#include "ports/absolute.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::absolute> {
  void legal(In& in, Random& random) { in.encoder.sample = in.encoder.sample || random.one_in(50); }
  void clock(const In& in) {
    const auto& e = in.encoder;
    Pins pins;
    pins.encoder_data = in.data;
    block.clock(pins,
                {e.sample, e.tick_count, e.filter, e.polarity, e.set_zero, e.clear, e.gates_enable},
                {});
  }
  Out out(const In&) const {
    const Position s = block.out();
    const unsigned lines = block.lines();
    return {lines & 1,
            lines >> 1 & 1,
            lines >> 2 & 1,
            {s.position, s.count, static_cast<std::int16_t>(s.travel), s.moved, s.chatters,
             s.illegal, s.error, s.error_count, s.rejected_count, s.index_position,
             s.polarity_holds, s.trip_channel, s.trip_index, s.trip_flip, s.why}};
  }

  Absolute block{design()};
};

}  // namespace

TEST_CASE("absolute: RTL and twin, every clock") {
  lock_step(
      Twin(),
      {1'600'000, 8, 100'000,
       "position.chatters position.illegal position.error position.error_count "
       "position.rejected_count "
       "position.index_position position.trip_channel position.trip_index position.trip_flip"});
}
