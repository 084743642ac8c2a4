// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_wall: RTL against twin on every clock, clock() against tick(), the law against 128-bit
// integers, no pull, and what the wall takes from the hand. Documentation:
// docs/blocks/scene_wall.md
#include <Vscene_wall.h>

#include "../scenes/scene_wave.hpp"
#include "catch.hpp"
#include "feltgate/scene_wall.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = SceneWall<Design>;
using Velocity = Twin::Law::Velocity;
using A = Design::A;
constexpr int kWall = Design::S::wall;
constexpr std::int64_t kLeast = -(std::int64_t{1} << (kTorque.width() - 1));
__extension__ typedef __int128 Wide;

struct Block {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == kWall, bus.start, wave.position, bus.param, bus.product};
  }
  static std::int64_t operand(const Twin::Out& out) { return out.operand; }
  static void drive(Vscene_wall& rtl, const Twin::In& in) {
    rtl.select_i = in.select;
    rtl.start_i = in.start;
    rtl.position_i = port_bits<18>(in.position);
    rtl.param_i = in.param;
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Vscene_wall& rtl, const Twin::Out& out) {
    check("operand", sign_extend<26>(rtl.operand_o), out.operand);
    check("tau", sign_extend<kTorque.width()>(rtl.tau_o), out.tau);
  }
};

struct Tally {
  std::int64_t waves = 0, outside = 0, push = 0, no_pull = 0, far = 0, saturated = 0, ties = 0;
};

/// The torque by its definition: both products floored to a quarter of a step, the difference
/// rounded half up, held within (-16 Nm, 0).
std::int64_t oracle(const Memory& memory, std::int32_t position, std::int64_t velocity,
                    Tally* tally) {
  const std::int64_t contact = decode_word(Design::f.scene_offset, memory.word(A::wall_contact));
  const std::int64_t k = memory.word(A::wall_stiffness) & 0x1ffff;
  const std::int64_t b = memory.word(A::wall_damping) & 0x1ffff;
  std::int64_t x = contact - std::int64_t{256} * position;
  constexpr std::int64_t end = (std::int64_t{1} << 25) - 1;
  tally->far += x < -end - 1;
  x = x > end ? end : x < -end - 1 ? -end - 1 : x;
  if (x >= 0) {
    ++tally->outside;
    return 0;
  }
  constexpr int fine = kTorque.fraction + 2;
  constexpr int spring_drop = 8 + Design::P::wall_stiffness.fraction - fine;
  constexpr int damper_drop = Design::f.velocity.fraction + Design::P::wall_damping.fraction - fine;
  const Wide quarters = ((static_cast<Wide>(x) * k) >> spring_drop) -
                        ((static_cast<Wide>(velocity) * b) >> damper_drop);
  tally->ties += (quarters & 3) == 2;
  const Wide tau = (quarters + 2) >> 2;
  if (tau > 0) {
    ++tally->no_pull;
    return 0;
  }
  tally->push += tau < 0;
  tally->saturated += tau < kLeast;
  return tau < kLeast ? kLeast : static_cast<std::int64_t>(tau);
}

struct TickBeside {
  Tally* tally;
  Twin beside{};
  void forget() { beside.reset(); }
  const char* operator()(const Probe& p, const Vscene_wall& rtl, const Twin& twin) {
    const bool selected = p.wave.scene == kWall;
    beside.tick(p.memory.words(), selected, p.wave.position, Velocity::from_raw(p.wave.velocity));
    ++tally->waves;
    if (beside.out().tau != twin.out().tau) return "tick() differs from clock()";
    const std::int64_t tau = sign_extend<kTorque.width()>(rtl.tau_o);
    const std::int64_t wanted =
        selected ? oracle(p.memory, p.wave.position, p.wave.velocity, tally) : 0;
    return tau == wanted ? nullptr : "torque is not half_up(k*(contact - position) - b*velocity)";
  }
};

struct Next {
  Random random;
  Wave operator()(Memory& memory, std::int64_t) {
    Wave wave;
    wave.scene = random.one_in(10) ? static_cast<int>(random.below(16)) : kWall;
    if (random.one_in(10)) {
      memory.write(A::wall_contact,
                   random.coin() ? any_word(random) : random.between(-200000, 200000));
      for (const int a : {A::wall_stiffness, A::wall_damping}) {
        memory.write(a, random.coin() ? std::int64_t{1} << random.below(17) : random.below(131072));
      }
    }
    wave.position = any_position(random, memory, kWall);
    wave.velocity = static_cast<std::int32_t>(random.bits()) >> random.below(24);
    if (random.one_in(8)) wave.velocity = random.coin() ? INT32_MAX : INT32_MIN;
    wave.length = static_cast<int>(random.between(30, 36));
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_wall: random walls, positions, velocities, scenes and resets") {
  Tally tally;
  const auto probe = std::make_shared<Probe>();
  LockStep<Vscene_wall, Twin, Block> bench("scene_wall", 1);
  bench.run(Waves<Block, Next>(2, Next{Random(3)}, probe), scaled_clocks(2000000), {5000},
            AfterWave<TickBeside>(probe, {&tally}));
  INFO("waves " << tally.waves << ", outside " << tally.outside << ", push " << tally.push
                << ", no pull " << tally.no_pull << ", far " << tally.far << ", saturated "
                << tally.saturated << ", ties " << tally.ties);
  REQUIRE(tally.outside > 5000);
  REQUIRE(tally.push > 5000);
  REQUIRE(tally.no_pull > 2000);
  REQUIRE(tally.far > 500);
  REQUIRE(tally.saturated > 500);
  REQUIRE(tally.saturated < tally.waves / 2);
  REQUIRE(tally.ties > 500);
}

TEST_CASE("scene_wall: free below the contact, a push above it, never a pull") {
  Memory memory;
  memory.write(A::wall_contact, 0);
  Twin twin;
  const auto tau = [&](std::int32_t position, double rad_s) {
    const double raw = rad_s * static_cast<double>(std::int64_t{1} << Design::f.velocity.fraction);
    twin.tick(memory.words(), true, position, Velocity::from_raw(static_cast<std::int64_t>(raw)));
    return twin.out().tau;
  };
  for (std::int32_t x = 1; x <= 800; ++x) {
    REQUIRE(tau(-x, 0) == 0);
    REQUIRE(tau(-x, 50) == 0);
    REQUIRE(tau(x, 0) < 0);
    REQUIRE(tau(x, 1) < tau(x, 0));   // pressing in: the damper adds
    REQUIRE(tau(x, -1) > tau(x, 0));  // on the way out it takes away
    REQUIRE(tau(x, -1000) == 0);      // but never pulls
  }
  REQUIRE(tau(0, 100) == 0);
}

TEST_CASE("scene_wall: takes energy from every stroke in and out, the velocity given exactly") {
  const Memory memory;
  Twin twin;
  constexpr double count_rad = 6.283185307179586 / 4096;
  constexpr double step = 1e-4;
  for (const double rad_s : {1.0, 5.0, 20.0}) {
    double work = 0, angle = 0.4;
    for (double velocity = rad_s; angle >= 0.4; angle += velocity * step) {
      if (angle > 0.6) velocity = -rad_s;
      const double raw =
          velocity * static_cast<double>(std::int64_t{1} << Design::f.velocity.fraction);
      twin.tick(memory.words(), true, static_cast<std::int32_t>(angle / count_rad),
                Velocity::from_raw(static_cast<std::int64_t>(raw)));
      work += static_cast<double>(twin.out().tau) / 65536 * velocity * step;
    }
    REQUIRE(work < 0);
  }
}
