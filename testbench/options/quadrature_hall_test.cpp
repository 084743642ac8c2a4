// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/quadrature_hall.hpp"

#include "ports/quadrature_hall.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::quadrature_hall> {
  void clock(const In& in) {
    const auto& e = in.encoder;
    Pins pins;
    pins.encoder = {in.a, in.b, in.z};
    pins.hall = static_cast<std::uint8_t>(in.hall);
    block.clock(pins,
                {e.sample, e.tick_count, e.filter, e.polarity, e.set_zero, e.clear, e.gates_enable},
                in.p);
  }
  Out out(const In&) const {
    const Position s = block.out();
    return {{s.position, s.count, static_cast<std::int16_t>(s.travel), s.moved, s.chatters,
             s.illegal, s.error, s.error_count, s.rejected_count, s.index_position,
             s.polarity_holds, s.trip_channel, s.trip_index, s.trip_flip, s.why},
            block.rotor().angle};
  }

  QuadratureHall block{design()};
};

}  // namespace

TEST_CASE("quadrature_hall: RTL and twin, every clock") {
  lock_step(Twin(), {800'000, 8, 50'000, "position.polarity_holds position.trip_flip"});
}
