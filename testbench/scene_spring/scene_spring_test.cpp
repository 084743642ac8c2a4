// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_spring: RTL against twin on every clock, clock() against tick(), the law against 128-bit
// integers. Documentation: docs/blocks/scene_spring.md
#include <Vscene_spring.h>

#include "../scenes/scene_wave.hpp"
#include "catch.hpp"
#include "feltgate/scene_spring.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = SceneSpring<Design>;
using A = Design::A;
constexpr int kTension = Design::S::spring_tension;
constexpr int kCompression = Design::S::spring_compression;

struct Block {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == kTension || wave.scene == kCompression,
            wave.scene == kTension,
            bus.start,
            wave.position,
            bus.param,
            bus.product};
  }
  static std::int64_t operand(const Twin::Out& out) { return out.operand; }
  static void drive(Vscene_spring& rtl, const Twin::In& in) {
    rtl.select_i = in.select;
    rtl.tension_i = in.tension;
    rtl.start_i = in.start;
    rtl.position_i = port_bits<18>(in.position);
    rtl.param_i = in.param;
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Vscene_spring& rtl, const Twin::Out& out) {
    check("operand", sign_extend<26>(rtl.operand_o), out.operand);
    check("tau", sign_extend<kTorque.width()>(rtl.tau_o), out.tau);
  }
};

struct Tally {
  std::int64_t waves = 0, push = 0, pull = 0, far = 0, saturated = 0, ties = 0, off = 0;
};

/// The torque by its definition: half_up(k * saturated(reference - position)), saturated.
std::int64_t oracle(const Memory& memory, bool tension, std::int32_t position, Tally* tally) {
  const std::int64_t reference = decode_word(
      Design::f.scene_offset, memory.word(tension ? A::tension_rest : A::compression_contact));
  const std::int64_t k =
      memory.word(tension ? A::tension_stiffness : A::compression_stiffness) & 0x1ffff;
  const int drop =
      (tension ? Design::P::tension_stiffness : Design::P::compression_stiffness).fraction + 8 -
      kTorque.fraction;
  std::int64_t x = reference - std::int64_t{256} * position;
  constexpr std::int64_t end = (std::int64_t{1} << 25) - 1;
  tally->far += x > end || x < -end - 1;
  x = x > end ? end : x < -end - 1 ? -end - 1 : x;
  if (!tension && x < 0) {
    ++tally->off;
    return 0;
  }
  const std::int64_t half = std::int64_t{1} << (drop - 1);
  tally->ties += ((x * k) & (2 * half - 1)) == half;
  std::int64_t tau = (x * k + half) >> drop;
  constexpr std::int64_t most = (std::int64_t{1} << (kTorque.width() - 1)) - 1;
  tally->saturated += tau > most || tau < -most - 1;
  tau = tau > most ? most : tau < -most - 1 ? -most - 1 : tau;
  ++(tau > 0 ? tally->push : tally->pull);
  return tau;
}

struct TickBeside {
  Tally* tally;
  Twin beside{};
  void forget() { beside.reset(); }
  const char* operator()(const Probe& p, const Vscene_spring& rtl, const Twin& twin) {
    const bool tension = p.wave.scene == kTension;
    const bool selected = tension || p.wave.scene == kCompression;
    beside.tick(p.memory.words(), selected, tension, p.wave.position);
    ++tally->waves;
    if (beside.out().tau != twin.out().tau) return "tick() differs from clock()";
    const std::int64_t tau = sign_extend<kTorque.width()>(rtl.tau_o);
    const std::int64_t wanted = selected ? oracle(p.memory, tension, p.wave.position, tally) : 0;
    return tau == wanted ? nullptr : "torque is not half_up(k * (reference - position))";
  }
};

struct Next {
  Random random;
  Wave operator()(Memory& memory, std::int64_t) {
    Wave wave;
    wave.scene = random.one_in(10) ? static_cast<int>(random.below(16))
                 : random.coin()   ? kTension
                                   : kCompression;
    if (random.one_in(10)) {
      for (const int a : {A::compression_contact, A::tension_rest}) {
        memory.write(a, random.coin() ? any_word(random) : random.between(-200000, 200000));
      }
      for (const int a : {A::compression_stiffness, A::tension_stiffness}) {
        memory.write(a, random.coin() ? std::int64_t{1} << random.below(17) : random.below(131072));
      }
    }
    wave.position = any_position(random, memory, wave.scene % 9);
    wave.length = static_cast<int>(random.between(30, 36));
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_spring: random springs, positions, scenes and resets") {
  Tally tally;
  const auto probe = std::make_shared<Probe>();
  LockStep<Vscene_spring, Twin, Block> bench("scene_spring", 1);
  bench.run(Waves<Block, Next>(2, Next{Random(3)}, probe), scaled_clocks(2000000), {5000},
            AfterWave<TickBeside>(probe, {&tally}));
  INFO("waves " << tally.waves << ", push " << tally.push << ", pull " << tally.pull << ", far "
                << tally.far << ", saturated " << tally.saturated << ", ties " << tally.ties
                << ", off " << tally.off);
  REQUIRE(tally.push > 5000);
  REQUIRE(tally.pull > 5000);
  REQUIRE(tally.far > 500);
  REQUIRE(tally.saturated > 500);
  REQUIRE(tally.saturated < tally.waves / 2);
  REQUIRE(tally.ties > 50);
  REQUIRE(tally.off > 2000);
}

TEST_CASE("scene_spring: signs and symmetry") {
  Memory memory;
  memory.write(A::tension_rest, 0);
  memory.write(A::compression_contact, 0);
  Twin twin;
  for (std::int32_t x = 0; x <= 4000; ++x) {
    twin.tick(memory.words(), true, true, x);
    const std::int64_t above = twin.out().tau;
    twin.tick(memory.words(), true, true, -x);
    const std::int64_t below = twin.out().tau;
    REQUIRE(above + below >= 0);  // they differ in size only at a tie, which goes up
    REQUIRE(above + below <= 1);
    REQUIRE((x == 0 ? above == 0 : above < 0));
    REQUIRE((x == 0 ? below == 0 : below > 0));
    twin.tick(memory.words(), true, false, x);
    REQUIRE(twin.out().tau == 0);
    twin.tick(memory.words(), true, false, -x);
    REQUIRE((x == 0 ? twin.out().tau == 0 : twin.out().tau > 0));
  }
}
