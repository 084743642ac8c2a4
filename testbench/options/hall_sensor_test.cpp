// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/hall_sensor.hpp"

#include "ports/hall_sensor.hpp"

using namespace feltgate::test;
using feltgate::HallSensor;

namespace {

/// Lines that must stay for 5 clocks, as CMakeLists.txt builds it.
struct Twin : BlockTwin<ports::hall_sensor> {
  /// A rotor that turns to and fro, in three of four lives with its lines right.
  void legal(In& in, Random& random) {
    if (random.one_in(2000)) right = !random.one_in(4);
    if (random.one_in(500)) forward = random.coin();
    if (random.one_in(20)) forward ? ++count : --count;
    in.count = static_cast<int>(count & 3);
    if (right) in.gain = 0x0100'0000;
    static constexpr int lines[6] = {5, 1, 3, 2, 6, 4};
    if (right && !random.one_in(2000))
      in.hall = lines[(count * std::uint64_t{0x0100'0000} % (std::uint64_t{1} << 32)) * 6 >> 32];
    in.clear = in.clear && random.one_in(100);
  }
  void clock(const In& in) {
    block.clock({static_cast<std::uint8_t>(in.hall), static_cast<std::uint8_t>(in.count), in.gain,
                 in.gates_enable, in.clear});
  }
  Out out(const In&) const {
    const HallSensor::Out& o = block.out();
    return {o.angle, o.faults, o.waits};
  }

  HallSensor block{5};
  bool right = true, forward = true;
  unsigned count = 0;
};

}  // namespace

TEST_CASE("hall_sensor: RTL and twin, every clock") { lock_step(Twin(), {800'000, 8, 50'000}); }
