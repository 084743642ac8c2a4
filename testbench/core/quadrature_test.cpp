// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/quadrature.hpp"

#include "ports/quadrature.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::quadrature> {
  void clock(const In& in) {
    const auto& e = in.encoder;
    Pins pins;
    pins.encoder = {in.a, in.b, in.z};
    block.clock(pins,
                {e.sample, e.tick_count, e.filter, e.polarity, e.set_zero, e.clear, e.gates_enable},
                {});
  }
  Out out(const In&) const {
    const Position s = block.out();
    return {{s.position, s.count, static_cast<std::int16_t>(s.travel), s.moved, s.chatters,
             s.illegal, s.error, s.error_count, s.rejected_count, s.index_position,
             s.polarity_holds, s.trip_channel, s.trip_index, s.trip_flip, s.why}};
  }
  Quadrature block{design()};
};

}  // namespace

TEST_CASE("quadrature: RTL and twin, every clock") {
  lock_step(Twin(),
            {800'000, 8, 20'000, "position.polarity_holds position.trip_flip position.why"});
}
