// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/scene.hpp"

#include "ports/scene.hpp"

using namespace feltgate::test;

namespace {

struct Twin : TickTwin<ports::scene, Scene<Fixed>> {
  static constexpr int velocity_clock = 4, holds = velocity_clock + 22;
  /// Torques of each scene: backward, none, forward.
  static inline std::array<std::array<int, 3>, 16> torques;

  static void strobes(In& in, int clock) {
    in.start = clock == 0;
    in.velocity_valid = clock == velocity_clock;
  }
  /// Every scene for some ticks, with positions near its reference.
  void legal(In& in, Random& random) {
    if (random.one_in(20)) number = static_cast<int>(random.below(16));
    in.scene = number;
    if (random.one_in(4))
      in.p.scene_2 = static_cast<std::uint32_t>(in.p.scene_1 + random.between(0, 1 << 16));
    if (random.coin())
      in.position = static_cast<std::int32_t>((in.p.scene_1 >> 8) + random.between(-300, 300));
    if (in.p.scene_10 == 0) in.p.scene_10 = static_cast<std::int32_t>(random.bits());
    in.armed = !random.one_in(8);
  }
  void clock(const In& in) {
    block.clock(in.velocity_valid, [&] {
      latency = law.latency(in.scene);
      scene = static_cast<std::size_t>(in.scene);
      return law.tick(block.state, in.p, in.armed, in.scene, in.position, in.velocity,
                      {in.law.torque, in.law.late, in.law.restart});
    });
    if (!block.valid(latency)) return;
    torque = block.state.torque;
    ++torques[scene][torque < 0 ? 0 : torque == 0 ? 1 : 2];
  }
  Out out(const In&) const { return {torque, block.valid(latency)}; }

  int number = 0;
  std::size_t scene = 0;
  int latency = 1;
  std::int64_t torque = 0;
};

}  // namespace

TEST_CASE("scene: RTL and twin, every clock") {
  lock_step(Twin(), {800'000});
  if (!waveform_wanted()) return;  // a mutant
  using S = Map::S;
  for (const int scene : {S::setpoint, S::membrane, S::spring_compression, S::spring_tension,
                          S::damper, S::charge_attract, S::charge_repel, S::wall, S::law}) {
    CAPTURE(scene);
    const auto& of = Twin::torques[static_cast<std::size_t>(scene)];
    const bool built = Scene<Fixed>(design()).has(scene);
    if (built && scene != S::spring_compression) CHECK(of[0] > 20);
    if (built && scene != S::wall) CHECK(of[2] > 20);
    CHECK(of[1] > 20);
  }
}
