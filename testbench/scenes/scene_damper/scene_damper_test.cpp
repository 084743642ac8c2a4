// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_damper: RTL against twin on every clock, and against law and plain integers in every wave;
// the law's symmetry and energy. Documentation: docs/blocks/scenes.md
#include <Vscene_damper.h>

#include "../scenes/scene_bench.hpp"
#include "../scenes/scene_twins.hpp"
#include "catch.hpp"
#include "feltgate/scene_damper.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Law = SceneDamperLaw<Design, Fixed>;
using Velocity = Law::Velocity;

struct Block : BlockOf<Vscene_damper, SceneDamper<Design>> {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == S::damper, bus.wave, bus.product};
  }
  static void drive(Rtl& rtl, const Twin::In& in) {
    rtl.select_i = in.select;
    FELTGATE_STROBES(rtl, in.wave, product_is, M, damper_damping);
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("minus", sign_extend<kPartWidth>(rtl.minus_o), out.minus);
  }
};

struct Tally {
  std::int64_t waves = 0, up = 0, down = 0, large = 0, ties = 0;
};

constexpr int kDrop =
    Design::f.velocity.fraction + Design::P::damper_damping.fraction - kTorque.fraction;
constexpr std::int64_t kHalf = std::int64_t{1} << (kDrop - 1);
constexpr std::int64_t kMost = (std::int64_t{1} << (kTorque.width() - 1)) - 1;

struct LawBeside {
  Tally* tally;
  void forget() {}
  const char* at(const Probe& p, const Block::Rtl& rtl, const Block::Twin&) {
    if (p.t != kRendered) return nullptr;
    const bool selected = p.wave.scene == S::damper;
    const std::int64_t tau = -rounded(sign_extend<kPartWidth>(rtl.minus_o));
    ++tally->waves;
    tally->up += tau > 0;
    tally->down += tau < 0;
    tally->large += tau > kMost || tau < -kMost - 1;
    if (!selected) return tau == 0 ? nullptr : "a torque while not selected";
    const std::int64_t product = p.wave.velocity * (p.memory.word(A::damper_damping) & 0x1ffff);
    tally->ties += (product & (2 * kHalf - 1)) == kHalf;
    if (tau != Law::torque(p.memory.words(), Velocity::from_raw(p.wave.velocity)).raw()) {
      return "the law's torque";
    }
    if (tau != -((product + kHalf) >> kDrop)) return "torque is not -half_up(b*w)";
    return (tau > 0 && p.wave.velocity > 0) || (tau < 0 && p.wave.velocity < 0) ? "drives"
                                                                                : nullptr;
  }
};

struct Next {
  Random random;
  Wave operator()(Memory& memory, std::int64_t) {
    if (random.one_in(10)) memory.write(A::damper_damping, any_word(random));
    Wave wave;
    wave.scene = random.one_in(8) ? static_cast<int>(random.below(16)) : S::damper;
    wave.velocity = any_velocity(random);
    if (random.one_in(6)) wave.velocity = std::int64_t{1} << random.below(31);  // meets ties
    wave.length = static_cast<int>(random.between(Wave::kShortest, 32));
    return wave;
  }
};

std::int64_t torque(const Memory& memory, std::int64_t velocity) {
  return Law::torque(memory.words(), Velocity::from_raw(velocity)).raw();
}

}  // namespace

TEST_CASE("scene_damper: random velocities, dampings, scenes and resets") {
  Tally tally;
  run_waves<Block>("scene_damper", 1, Next{Random(3)}, LawBeside{&tally}, scaled_clocks(1500000),
                   5000);
  INFO("waves " << tally.waves << ", up " << tally.up << ", down " << tally.down << ", large "
                << tally.large << ", ties " << tally.ties);
  REQUIRE(tally.up > 3000);
  REQUIRE(tally.down > 3000);
  REQUIRE(tally.large > 300);
  REQUIRE(tally.large < tally.waves / 4);
  REQUIRE(tally.ties > 100);
}

TEST_CASE("scene_damper: both signs, up to both ends") {
  Memory memory;
  memory.write(A::damper_damping, 0x1ffff);
  REQUIRE(torque(memory, 0) == 0);
  REQUIRE(torque(memory, INT32_MAX) < -kMost);
  REQUIRE(torque(memory, INT32_MIN) > kMost);
  const Memory design;
  for (std::int64_t v = 1; v < INT32_MAX; v += 65537 * 3) {
    const std::int64_t sum = torque(design, v) + torque(design, -v);
    REQUIRE(sum <= 0);  // they differ in size only at a tie
    REQUIRE(sum >= -1);
  }
}

TEST_CASE("scene_damper: absorbs energy over random motions") {
  constexpr double rad_s = static_cast<double>(std::int64_t{1} << Design::f.velocity.fraction);
  const Memory memory;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    double velocity = 0, work = 0;
    for (int k = 0; k < 20000; ++k) {
      velocity += (static_cast<double>(random.below(20001)) - 10000.0) * 1e-4 - 0.001 * velocity;
      const std::int64_t tau = torque(memory, static_cast<std::int64_t>(velocity * rad_s));
      const double power = static_cast<double>(tau) * velocity;
      REQUIRE(power <= 0);
      work += power;
    }
    REQUIRE(work < 0);
  }
}
