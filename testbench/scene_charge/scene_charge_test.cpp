// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_charge: RTL against twin on every clock, clock() against tick(), the division against plain
// integers, signs and symmetry. Documentation: docs/blocks/scene_charge.md
#include <Vscene_charge.h>

#include "../scenes/scene_wave.hpp"
#include "catch.hpp"
#include "feltgate/scene_charge.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = SceneCharge<Design>;
using A = Design::A;
constexpr int kAttract = Design::S::charge_attract;
constexpr int kRepel = Design::S::charge_repel;

struct Block {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.scene == kAttract || wave.scene == kRepel,
            wave.scene == kAttract,
            bus.start,
            wave.position,
            bus.param,
            bus.product};
  }
  static std::int64_t operand(const Twin::Out& out) { return out.operand; }
  static void drive(Vscene_charge& rtl, const Twin::In& in) {
    rtl.select_i = in.select;
    rtl.attract_i = in.attract;
    rtl.start_i = in.start;
    rtl.position_i = port_bits<18>(in.position);
    rtl.param_i = in.param;
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Vscene_charge& rtl, const Twin::Out& out) {
    check("operand", sign_extend<26>(rtl.operand_o), out.operand);
    check("tau", sign_extend<kTorque.width()>(rtl.tau_o), out.tau);
  }
};

struct Tally {
  std::int64_t waves = 0, outside = 0, saturated = 0, at_centre = 0, far = 0;
  std::int64_t core = 0, border = 0, core_saturated = 0, up = 0, down = 0;
};

std::int64_t magnitude(std::int64_t x) { return x < 0 ? -x : x; }

/// The torque by its definition, in 64-bit integers.
std::int64_t oracle(const Memory& memory, bool attract, std::int32_t position, Tally* tally) {
  const int bank = 32 * (attract ? kAttract : kRepel);
  const std::int64_t centre = decode_word(Design::f.scene_offset, memory.word(bank + 1)) >> 8;
  std::int64_t x = position - centre;  // the block saturates centre - position
  tally->far += x > 131072 || x < -131071;
  x = x > 131072 ? 131072 : x < -131071 ? -131071 : x;
  const std::int64_t core = memory.word(bank + 12) & 0x7fffffff;
  tally->border += magnitude(x) == core;
  std::int64_t away = 0;
  if (magnitude(x) < core) {
    const std::int64_t slope = memory.word(bank + 6) & 0x1ffff;
    const int drop =
        (attract ? Design::P::attract_core_slope : Design::P::repel_core_slope).fraction - 16;
    // Half up on the pull towards the centre.
    const std::int64_t half = drop > 0 ? std::int64_t{1} << (drop - 1) : 0;
    const std::int64_t pull = (-x * slope + half) >> drop;
    std::int64_t tau = attract ? pull : -pull;
    ++tally->core;
    tally->core_saturated += tau > 65535 || tau < -65536;
    return tau > 65535 ? 65535 : tau < -65536 ? -65536 : tau;
  }
  const std::int64_t strength = memory.word(bank + 2);
  ++tally->outside;
  tally->at_centre += x == 0;
  if (x == 0 || strength / (x * x) > 65535) {
    ++tally->saturated;
    away = 65535;
  } else {
    away = strength / (x * x);
  }
  if (x < 0) away = -away;
  return attract ? -away : away;
}

struct TickBeside {
  Tally* tally;
  Twin beside{};
  void forget() { beside.reset(); }
  const char* operator()(const Probe& p, const Vscene_charge& rtl, const Twin& twin) {
    const bool attract = p.wave.scene == kAttract;
    const bool selected = attract || p.wave.scene == kRepel;
    beside.tick(p.memory.words(), selected, attract, p.wave.position);
    if (beside.out().tau != twin.out().tau) return "tick() differs from clock()";
    const std::int64_t tau = sign_extend<kTorque.width()>(rtl.tau_o);
    ++tally->waves;
    tally->up += tau > 0;
    tally->down += tau < 0;
    const std::int64_t wanted = selected ? oracle(p.memory, attract, p.wave.position, tally) : 0;
    return tau == wanted ? nullptr : "torque is not what integers give";
  }
};

struct Next {
  Random random;
  Wave operator()(Memory& memory, std::int64_t) {
    Wave wave;
    wave.scene = random.one_in(10) ? static_cast<int>(random.below(16))
                 : random.coin()   ? kAttract
                                   : kRepel;
    const int bank = wave.scene * 32;
    if (random.one_in(4))
      memory.write(bank + 1, random.one_in(4) ? any_word(random) : random.between(-400000, 400000));
    if (random.one_in(4)) memory.write(bank + 2, any_word(random));
    if (random.one_in(4))
      memory.write(bank + 6, random.below(std::uint64_t{1} << random.below(18)));
    if (random.one_in(4))
      memory.write(bank + 12, random.coin() ? any_word(random) : random.below(2048));
    wave.position = any_position(random, memory, wave.scene);
    const std::int64_t centre = decode_word(Design::f.scene_offset, memory.word(bank + 1)) >> 8;
    const std::int64_t core = memory.word(bank + 12) & 0x7fffffff;
    if (random.one_in(3)) wave.position = static_cast<std::int32_t>(random.between(-30, 30));
    if (random.one_in(4) && core < 100000 && centre > -30000 && centre < 30000) {
      wave.position = static_cast<std::int32_t>(centre + (random.coin() ? core : -core) +
                                                random.between(-1, 1));
    }
    if (random.one_in(20))
      wave.position = static_cast<std::int32_t>(centre > 131071 ? 131071 : centre);
    wave.length = static_cast<int>(random.between(30, 36));
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_charge: random charges, positions, scenes and resets") {
  Tally tally;
  const auto probe = std::make_shared<Probe>();
  LockStep<Vscene_charge, Twin, Block> bench("scene_charge", 1);
  bench.run(Waves<Block, Next>(2, Next{Random(3)}, probe), scaled_clocks(3000000), {5000},
            AfterWave<TickBeside>(probe, {&tally}));
  INFO("waves " << tally.waves << ", outside " << tally.outside << ", saturated " << tally.saturated
                << ", at the centre " << tally.at_centre << ", far " << tally.far << ", core "
                << tally.core << ", border " << tally.border << ", core saturated "
                << tally.core_saturated << ", up " << tally.up << ", down " << tally.down);
  REQUIRE(tally.outside > 10000);
  REQUIRE(tally.saturated > 1000);
  REQUIRE(tally.saturated < tally.outside / 2);
  REQUIRE(tally.at_centre > 300);
  REQUIRE(tally.far > 300);
  REQUIRE(tally.core > 10000);
  REQUIRE(tally.border > 1000);
  REQUIRE(tally.core_saturated > 1000);
  REQUIRE(tally.core_saturated < tally.core * 2 / 3);
  REQUIRE(tally.up > 10000);
  REQUIRE(tally.down > 10000);
}

namespace {

/// The design's charge at every distance up to 3000 counts, then at random ones, as waves.
struct Sweep {
  Random random;
  int scene;
  Wave operator()(Memory&, std::int64_t number) {
    Wave wave;
    wave.scene = scene;
    wave.position = number <= 6000 ? static_cast<std::int32_t>(number - 3000)
                                   : static_cast<std::int32_t>(random.between(-131072, 131071));
    wave.length = 30;
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_charge: the design's charge at every small distance") {
  for (const int scene : {kAttract, kRepel}) {
    Tally tally;
    const auto probe = std::make_shared<Probe>();
    LockStep<Vscene_charge, Twin, Block> bench("scene_charge", 4);
    bench.run(Waves<Block, Sweep>(2, {Random(5), scene}, probe), 30 * 8000, {},
              AfterWave<TickBeside>(probe, {&tally}));
    REQUIRE(tally.waves > 7990);
    REQUIRE(tally.up > 2000);
    REQUIRE(tally.down > 2000);
  }
}

TEST_CASE("scene_charge: sign table") {
  Memory memory;
  for (const int bank : {32 * kAttract, 32 * kRepel}) {
    memory.write(bank + 1, 100 * 256 + 77);  // the fraction is ignored
    memory.write(bank + 2, std::int64_t{1000} * 65536);
    memory.write(bank + 12, 0);
  }
  Twin twin;
  const auto tau = [&](bool attract, std::int32_t x) {
    twin.tick(memory.words(), true, attract, 100 + x);
    return twin.out().tau;
  };
  REQUIRE(tau(true, 0) == -65535);  // sgn(0) = +1
  REQUIRE(tau(false, 0) == 65535);
  for (std::int32_t x = 1; x < 20000; x += x < 300 ? 1 : 77) {
    const std::int64_t size = tau(false, x);
    REQUIRE(size >= 0);
    REQUIRE(size == (std::int64_t{65536000} / (std::int64_t{x} * x) > 65535
                         ? 65535
                         : std::int64_t{65536000} / (std::int64_t{x} * x)));
    REQUIRE(tau(false, -x) == -size);
    REQUIRE(tau(true, x) == -size);
    REQUIRE(tau(true, -x) == size);
  }
}
