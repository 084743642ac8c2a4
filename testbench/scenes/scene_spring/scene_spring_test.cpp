// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_spring: RTL against twin on every clock, and against law and plain integers in every wave;
// the law's signs and symmetry. Documentation: docs/blocks/scenes.md
#include <Vscene_spring.h>

#include "../scenes/scene_bench.hpp"
#include "../scenes/scene_twins.hpp"
#include "catch.hpp"
#include "feltgate/scene_spring.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Law = SceneSpringLaw<Design, Fixed>;

struct Block : BlockOf<Vscene_spring, SceneSpring<Design>> {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == S::spring_tension, wave.scene == S::spring_compression, bus.gap < 0,
            bus.wave, bus.product};
  }
  static void drive(Rtl& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, tension, compression, behind);
    FELTGATE_STROBES(rtl, in.wave, product_is, M, scene_stiffness);
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("plus", sign_extend<kPartWidth>(rtl.plus_o), out.plus);
  }
};

struct Tally {
  std::int64_t waves = 0, push = 0, pull = 0, far = 0, large = 0, ties = 0, off = 0;
};

/// The torque by its definition: half_up(k * (reference - position)).
std::int64_t oracle(const Memory& memory, bool tension, std::int32_t position, Tally* tally) {
  const std::int64_t reference = decode_word(
      Design::f.scene_offset, memory.word(tension ? A::tension_rest : A::compression_contact));
  const std::int64_t k =
      memory.word(tension ? A::tension_stiffness : A::compression_stiffness) & 0x1ffff;
  const int drop =
      (tension ? Design::P::tension_stiffness : Design::P::compression_stiffness).fraction + 8 -
      kTorque.fraction;
  const std::int64_t x = reference - std::int64_t{256} * position;
  constexpr std::int64_t end = (std::int64_t{1} << 25) - 1;
  tally->far += x > end || x < -end - 1;
  if (!tension && x < 0) {
    ++tally->off;
    return 0;
  }
  const std::int64_t half = std::int64_t{1} << (drop - 1);
  tally->ties += ((x * k) & (2 * half - 1)) == half;
  const std::int64_t tau = (x * k + half) >> drop;
  constexpr std::int64_t most = (std::int64_t{1} << (kTorque.width() - 1)) - 1;
  tally->large += tau > most || tau < -most - 1;
  ++(tau > 0 ? tally->push : tally->pull);
  return tau;
}

struct LawBeside {
  Tally* tally;
  void forget() {}
  const char* at(const Probe& p, const Block::Rtl& rtl, const Block::Twin&) {
    if (p.t != kRendered) return nullptr;
    const bool tension = p.wave.scene == S::spring_tension;
    const bool selected = tension || p.wave.scene == S::spring_compression;
    ++tally->waves;
    const std::int64_t tau = rounded(sign_extend<kPartWidth>(rtl.plus_o));
    if (!selected) return tau == 0 ? nullptr : "a torque while not selected";
    if (!tension && tau < 0) return "a compressed spring pulls";
    if (tau != Law::torque(p.memory.words(), tension, p.wave.position).raw()) {
      return "the law's torque";
    }
    return tau == oracle(p.memory, tension, p.wave.position, tally)
               ? nullptr
               : "torque is not half_up(k * (reference - position))";
  }
};

struct Next {
  Random random;
  Wave operator()(Memory& memory, std::int64_t) {
    Wave wave;
    wave.scene = random.one_in(10) ? static_cast<int>(random.below(16))
                 : random.coin()   ? S::spring_tension
                                   : S::spring_compression;
    if (random.one_in(10)) {
      for (const int a : {A::compression_contact, A::tension_rest}) {
        memory.write(a, random.coin() ? any_word(random) : random.between(-200000, 200000));
      }
      for (const int a : {A::compression_stiffness, A::tension_stiffness}) {
        memory.write(a, random.coin() ? std::int64_t{1} << random.below(17) : random.below(131072));
      }
    }
    wave.position = any_position(random, memory, wave.scene % 9);
    wave.length = static_cast<int>(random.between(Wave::kShortest, 32));
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_spring: random springs, positions, scenes and resets") {
  Tally tally;
  run_waves<Block>("scene_spring", 1, Next{Random(3)}, LawBeside{&tally}, scaled_clocks(2000000),
                   5000);
  INFO("waves " << tally.waves << ", push " << tally.push << ", pull " << tally.pull << ", far "
                << tally.far << ", large " << tally.large << ", ties " << tally.ties << ", off "
                << tally.off);
  REQUIRE(tally.push > 5000);
  REQUIRE(tally.pull > 5000);
  REQUIRE(tally.far > 500);
  REQUIRE(tally.large > 500);
  REQUIRE(tally.ties > 50);
  REQUIRE(tally.off > 2000);
}

TEST_CASE("scene_spring: signs and symmetry") {
  Memory memory;
  memory.write(A::tension_rest, 0);
  memory.write(A::compression_contact, 0);
  const auto tau = [&memory](bool tension, std::int32_t x) {
    return Law::torque(memory.words(), tension, x).raw();
  };
  for (std::int32_t x = 0; x <= 4000; ++x) {
    const std::int64_t above = tau(true, x), below = tau(true, -x);
    REQUIRE(above + below >= 0);  // they differ in size only at a tie, which goes up
    REQUIRE(above + below <= 1);
    REQUIRE((x == 0 ? above == 0 : above < 0));
    REQUIRE((x == 0 ? below == 0 : below > 0));
    REQUIRE(tau(false, x) == 0);
    REQUIRE((x == 0 ? tau(false, -x) == 0 : tau(false, -x) > 0));
  }
}

TEST_CASE("scene_spring: the distance is exact over the whole range") {
  Memory memory;
  memory.write(A::tension_stiffness, 0x1ffff);
  memory.write(A::tension_rest, -(std::int64_t{1} << 25));
  const std::int64_t furthest = Law::torque(memory.words(), true, kEnd).raw();
  memory.write(A::tension_rest, -(std::int64_t{1} << 24));
  const std::int64_t nearer = Law::torque(memory.words(), true, kEnd).raw();
  REQUIRE(furthest < nearer * 5 / 4);
  REQUIRE(nearer < 0);
}
