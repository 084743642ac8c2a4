// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_damper: RTL against twin on every clock, clock() against tick(), symmetry and energy.
// Documentation: docs/blocks/scene_damper.md
#include <Vscene_damper.h>

#include "../scenes/scene_wave.hpp"
#include "catch.hpp"
#include "feltgate/scene_damper.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = SceneDamper<Design>;
using Velocity = Twin::Law::Velocity;
constexpr int kDamper = Design::S::damper;

struct Block {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == kDamper, bus.start, bus.product};
  }
  static std::int64_t operand(const Twin::Out&) { return 0; }
  static void drive(Vscene_damper& rtl, const Twin::In& in) {
    rtl.select_i = in.select;
    rtl.start_i = in.start;
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Vscene_damper& rtl, const Twin::Out& out) {
    check("tau", sign_extend<kTorque.width()>(rtl.tau_o), out.tau);
  }
};

struct Tally {
  std::int64_t waves = 0, up = 0, down = 0, saturated = 0, ties = 0;
};

constexpr int kDrop =
    Design::f.velocity.fraction + Design::P::damper_damping.fraction - kTorque.fraction;
constexpr std::int64_t kMost = (std::int64_t{1} << (kTorque.width() - 1)) - 1;

/// The torque by its definition: -half_up(b * velocity), saturated.
std::int64_t oracle(const Memory& memory, std::int64_t velocity) {
  const std::int64_t product = velocity * (memory.word(Design::A::damper_damping) & 0x1ffff);
  const std::int64_t tau = -((product + (std::int64_t{1} << (kDrop - 1))) >> kDrop);
  return tau > kMost ? kMost : tau < -kMost - 1 ? -kMost - 1 : tau;
}

struct TickBeside {
  Tally* tally;
  Twin beside{};
  void forget() { beside.reset(); }
  const char* operator()(const Probe& p, const Vscene_damper& rtl, const Twin& twin) {
    const bool selected = p.wave.scene == kDamper;
    beside.tick(p.memory.words(), selected, Velocity::from_raw(p.wave.velocity));
    const std::int64_t tau = sign_extend<kTorque.width()>(rtl.tau_o);
    ++tally->waves;
    tally->up += tau > 0;
    tally->down += tau < 0;
    tally->saturated += tau == kMost || tau == -kMost - 1;
    const std::int64_t product =
        p.wave.velocity * (p.memory.word(Design::A::damper_damping) & 0x1ffff);
    constexpr std::int64_t half = std::int64_t{1} << (kDrop - 1);
    tally->ties += selected && (product & (2 * half - 1)) == half;
    if (beside.out().tau != twin.out().tau) return "tick() differs from clock()";
    if (tau != (selected ? oracle(p.memory, p.wave.velocity) : 0))
      return "torque is not -half_up(b*w)";
    return (tau > 0 && p.wave.velocity > 0) || (tau < 0 && p.wave.velocity < 0) ? "drives"
                                                                                : nullptr;
  }
};

struct Next {
  Random random;
  Wave operator()(Memory& memory, std::int64_t) {
    if (random.one_in(10)) memory.write(Design::A::damper_damping, any_word(random));
    Wave wave;
    wave.scene = random.one_in(8) ? static_cast<int>(random.below(16)) : kDamper;
    wave.velocity = static_cast<std::int32_t>(random.bits()) >> random.below(24);
    if (random.one_in(8)) wave.velocity = random.coin() ? INT32_MAX : INT32_MIN;
    wave.velocity *= 1 - 2 * static_cast<std::int64_t>(random.coin() && wave.velocity > INT32_MIN);
    if (random.one_in(6)) wave.velocity = (std::int64_t{1} << random.below(31));  // meets ties
    wave.length = static_cast<int>(random.between(30, 36));
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_damper: random velocities, dampings, scenes and resets") {
  Tally tally;
  const auto probe = std::make_shared<Probe>();
  LockStep<Vscene_damper, Twin, Block> bench("scene_damper", 1);
  bench.run(Waves<Block, Next>(2, Next{Random(3)}, probe), scaled_clocks(1500000), {5000},
            AfterWave<TickBeside>(probe, {&tally}));
  INFO("waves " << tally.waves << ", up " << tally.up << ", down " << tally.down << ", saturated "
                << tally.saturated << ", ties " << tally.ties);
  REQUIRE(tally.up > 3000);
  REQUIRE(tally.down > 3000);
  REQUIRE(tally.saturated > 300);
  REQUIRE(tally.saturated < tally.waves / 4);
  REQUIRE(tally.ties > 100);
}

TEST_CASE("scene_damper: both ends and both signs") {
  Memory memory;
  memory.write(Design::A::damper_damping, 0x1ffff);
  Twin twin;
  const auto tau = [&](std::int64_t velocity) {
    twin.tick(memory.words(), true, Velocity::from_raw(velocity));
    return twin.out().tau;
  };
  REQUIRE(tau(0) == 0);
  REQUIRE(tau(INT32_MAX) == -kMost - 1);
  REQUIRE(tau(INT32_MIN) == kMost);
  memory = Memory();
  for (std::int64_t v = 1; v < INT32_MAX; v += 65537 * 3) {
    const std::int64_t sum = tau(v) + tau(-v);
    REQUIRE(sum <= 0);  // they differ in size only at a tie
    REQUIRE(sum >= -1);
  }
}

TEST_CASE("scene_damper: absorbs energy over random motions") {
  constexpr double rad_s = static_cast<double>(std::int64_t{1} << Design::f.velocity.fraction);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Memory memory;
    Twin twin;
    double velocity = 0, work = 0;
    for (int k = 0; k < 20000; ++k) {
      velocity += (static_cast<double>(random.below(20001)) - 10000.0) * 1e-4 - 0.001 * velocity;
      twin.tick(memory.words(), true,
                Velocity::from_raw(static_cast<std::int64_t>(velocity * rad_s)));
      const double power = static_cast<double>(twin.out().tau) * velocity;
      REQUIRE(power <= 0);
      work += power;
    }
    REQUIRE(work < 0);
  }
}
