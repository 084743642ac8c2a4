// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_wall: RTL against twin on every clock, and against law and 128-bit integers in every wave;
// the law never pulls and takes from the hand. Documentation: docs/blocks/scenes.md
#include <Vscene_wall.h>

#include <algorithm>

#include "../scenes/scene_bench.hpp"
#include "../scenes/scene_twins.hpp"
#include "catch.hpp"
#include "feltgate/scene_wall.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Law = SceneWallLaw<Design, Fixed>;
using Velocity = Law::Velocity;
constexpr std::int64_t kLeast = -(std::int64_t{1} << (kTorque.width() - 1));

struct Block : BlockOf<Vscene_wall, SceneWall<Design>> {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == S::wall, bus.gap < 0, bus.wave, bus.product};
  }
  static void drive(Rtl& rtl, const Twin::In& in) {
    rtl.select_i = in.select;
    rtl.behind_i = in.behind;
    FELTGATE_STROBES(rtl, in.wave, product_is, M, wall_stiffness, wall_damping);
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("plus", sign_extend<kPartWidth>(rtl.plus_o), out.plus);
    check("minus", sign_extend<kPartWidth>(rtl.minus_o), out.minus);
  }
};

struct Tally {
  std::int64_t waves = 0, outside = 0, push = 0, no_pull = 0, far = 0, large = 0, ties = 0;
};

/// The torque by its definition: both products floored to a quarter of a step, the difference
/// rounded half up; no pull.
std::int64_t oracle(const Memory& memory, std::int32_t position, std::int64_t velocity,
                    Tally* tally) {
  const std::int64_t contact = decode_word(Design::f.scene_offset, memory.word(A::wall_contact));
  const std::int64_t k = memory.word(A::wall_stiffness) & 0x1ffff;
  const std::int64_t b = memory.word(A::wall_damping) & 0x1ffff;
  const std::int64_t x = contact - std::int64_t{256} * position;
  tally->far += x < -(std::int64_t{1} << 25);
  if (x >= 0) {
    ++tally->outside;
    return 0;
  }
  constexpr int fine = kTorque.fraction + 2;
  constexpr int spring_drop = 8 + Design::P::wall_stiffness.fraction - fine;
  constexpr int damper_drop = Design::f.velocity.fraction + Design::P::wall_damping.fraction - fine;
  // The spring's part saturates at its format, far beyond any limit.
  constexpr int128_t least = -(int128_t{1} << (kPartWidth - 1));
  const int128_t spring = (static_cast<int128_t>(x) * k) >> spring_drop;
  const int128_t quarters =
      (spring < least ? least : spring) - ((static_cast<int128_t>(velocity) * b) >> damper_drop);
  tally->ties += (quarters & 3) == 2;
  const int128_t tau = (quarters + 2) >> 2;
  if (tau > 0) {
    ++tally->no_pull;
    return 0;
  }
  tally->push += tau < 0;
  tally->large += tau < kLeast;
  return static_cast<std::int64_t>(tau);
}

struct LawBeside {
  Tally* tally;
  void forget() {}
  const char* at(const Probe& p, const Block::Rtl& rtl, const Block::Twin&) {
    if (p.t != kRendered) return nullptr;
    ++tally->waves;
    const std::int64_t plus = sign_extend<kPartWidth>(rtl.plus_o);
    const std::int64_t minus = sign_extend<kPartWidth>(rtl.minus_o);
    if (p.wave.scene != S::wall) {
      return plus == 0 && minus == 0 ? nullptr : "a torque while not selected";
    }
    const std::int64_t sum = (plus - minus + 2) >> 2;
    const std::int64_t tau = sum < 0 ? sum : 0;  // as the port does
    const auto velocity = Velocity::from_raw(p.wave.velocity);
    if (tau != Law::torque(p.memory.words(), p.wave.position, velocity).raw()) {
      return "the law's torque";
    }
    return tau == oracle(p.memory, p.wave.position, p.wave.velocity, tally)
               ? nullptr
               : "torque is not half_up(k*(contact - position) - b*velocity)";
  }
};

struct Next {
  Random random;
  Wave operator()(Memory& memory, std::int64_t) {
    Wave wave;
    wave.scene = random.one_in(10) ? static_cast<int>(random.below(16)) : S::wall;
    if (random.one_in(10)) {
      memory.write(A::wall_contact,
                   random.coin() ? any_word(random) : random.between(-200000, 200000));
      for (const int a : {A::wall_stiffness, A::wall_damping}) {
        memory.write(a, random.coin() ? std::int64_t{1} << random.below(17) : random.below(131072));
      }
    }
    wave.position = any_position(random, memory, S::wall);
    if (random.one_in(24)) {
      // A product just beyond a power of two: a single 0 among the high bits of a negative word.
      memory.write(A::wall_contact, 0);
      memory.write(A::wall_stiffness,
                   random.coin() ? 0x1ffff : std::int64_t{1} << random.below(17));
      wave.position = std::min(kEnd, (1 << random.below(18)) + 1);
    }
    wave.velocity = any_velocity(random);
    wave.length = static_cast<int>(random.between(Wave::kShortest, 32));
    return wave;
  }
};

std::int64_t torque(const Memory& memory, std::int32_t position, double rad_s) {
  const double raw = rad_s * static_cast<double>(std::int64_t{1} << Design::f.velocity.fraction);
  return Law::torque(memory.words(), position, Velocity::from_raw(static_cast<std::int64_t>(raw)))
      .raw();
}

}  // namespace

TEST_CASE("scene_wall: random walls, positions, velocities, scenes and resets") {
  Tally tally;
  run_waves<Block>("scene_wall", 1, Next{Random(3)}, LawBeside{&tally}, scaled_clocks(2000000),
                   5000);
  INFO("waves " << tally.waves << ", outside " << tally.outside << ", push " << tally.push
                << ", no pull " << tally.no_pull << ", far " << tally.far << ", large "
                << tally.large << ", ties " << tally.ties);
  REQUIRE(tally.outside > 5000);
  REQUIRE(tally.push > 5000);
  REQUIRE(tally.no_pull > 2000);
  REQUIRE(tally.far > 500);
  REQUIRE(tally.large > 500);
  REQUIRE(tally.large < tally.waves / 2);
  REQUIRE(tally.ties > 500);
}

TEST_CASE("scene_wall: free below the contact, a push above it, never a pull") {
  Memory memory;
  memory.write(A::wall_contact, 0);
  for (std::int32_t x = 1; x <= 800; ++x) {
    REQUIRE(torque(memory, -x, 0) == 0);
    REQUIRE(torque(memory, -x, 50) == 0);
    REQUIRE(torque(memory, x, 0) < 0);
    REQUIRE(torque(memory, x, 1) < torque(memory, x, 0));   // pressing in: the damper adds
    REQUIRE(torque(memory, x, -1) > torque(memory, x, 0));  // on the way out it takes away
    REQUIRE(torque(memory, x, -1000) == 0);                 // but never pulls
  }
  REQUIRE(torque(memory, 0, 100) == 0);
}

TEST_CASE("scene_wall: takes energy from every stroke in and out, the velocity given exactly") {
  const Memory memory;
  constexpr double count_rad = 6.283185307179586 / 4096;
  constexpr double step = 1e-4;
  for (const double rad_s : {1.0, 5.0, 20.0}) {
    double work = 0, angle = 0.4;
    for (double velocity = rad_s; angle >= 0.4; angle += velocity * step) {
      if (angle > 0.6) velocity = -rad_s;
      const auto position = static_cast<std::int32_t>(angle / count_rad);
      work += static_cast<double>(torque(memory, position, velocity)) / 65536 * velocity * step;
    }
    REQUIRE(work < 0);
  }
}
