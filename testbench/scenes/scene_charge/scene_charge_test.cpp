// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scene_charge: RTL against twin on every clock, and against law and plain integers in every wave;
// the law's signs, symmetry and border. Documentation: docs/blocks/scenes.md
#include <Vscene_charge.h>

#include "../scenes/scene_bench.hpp"
#include "../scenes/scene_twins.hpp"
#include "catch.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Law = SceneChargeLaw<Design, Fixed>;

struct Block : BlockOf<Vscene_charge, SceneCharge<Design>> {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {bus.armed,
            wave.scene == S::charge_attract,
            wave.scene == S::charge_repel,
            bus.distance,
            bus.wave,
            bus.param,
            bus.product,
            bus.over_limit};
  }
  static void drive(Rtl& rtl, const Twin::In& in) {
    rtl.armed_i = in.armed;
    rtl.attract_i = in.attract;
    rtl.repel_i = in.repel;
    rtl.distance_positive_i = in.distance > 0;
    rtl.division_i = (in.wave >> Map::M::charge_square) & 0x3ffff;
    FELTGATE_STROBES(rtl, in.wave >> 1, after, T, charge_core);
    FELTGATE_STROBES(rtl, in.wave, at, T, scene_distance, charge_width_limited, charge_core);
    FELTGATE_STROBES(rtl, in.wave, param_is, W, attract_strength);
    FELTGATE_STROBES(rtl, in.wave >> 1, param_was, W, attract_strength);
    FELTGATE_STROBES(rtl, in.wave, product_is, M, attract_core_slope, repel_core_slope);
    rtl.param_i = in.param;
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
    rtl.over_limit_i = in.over_limit;
  }
  /// As the limiter takes it.
  static std::int64_t outside(const Rtl& rtl) {
    const std::int64_t size = sign_extend<kTorque.width()>(rtl.outside_o);
    return (rtl.outside_not_o ? ~size : size) + rtl.outside_up_o;
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("plus", sign_extend<kPartWidth>(rtl.plus_o), out.plus);
    check("minus", sign_extend<kPartWidth>(rtl.minus_o), out.minus);
    check("outside", outside(rtl), out.outside);
  }
};

struct Tally {
  std::int64_t waves = 0, outside = 0, saturated = 0, at_centre = 0, far = 0, disarmed = 0;
  std::int64_t core = 0, border = 0, core_large = 0, up = 0, down = 0;
};

std::int64_t size(std::int64_t x) { return x < 0 ? -x : x; }

/// The core's half-width as the limiter reads it.
std::int64_t half_width(const Memory& memory, int scene) {
  return decode_word(Format::from_key(Law::kWidthKey),
                     memory.slot(scene, Map::T::charge_width_limited));
}

/// The torque by its definition, in 64-bit integers.
std::int64_t oracle(const Memory& memory, int scene, std::int32_t position, Tally* tally) {
  const bool attract = scene == S::charge_attract;
  const std::int64_t x = position - (memory.reference(scene) >> 8);
  tally->far += x > kEnd + 1 || x < -kEnd - 1;
  const std::int64_t core = half_width(memory, scene);
  tally->border += core > 0 && size(x) == core;
  if (core > 0 && size(x) <= core) {
    const std::int64_t slope = memory.factor(scene, Map::W::charge_slope);
    const int drop =
        (attract ? Design::P::attract_core_slope : Design::P::repel_core_slope).fraction - 16;
    // Half up on the pull towards the centre.
    const std::int64_t half = drop > 0 ? std::int64_t{1} << (drop - 1) : 0;
    const std::int64_t pull = (-x * slope + half) >> drop;
    ++tally->core;
    tally->core_large += size(pull) > 65535;
    return attract ? pull : -pull;
  }
  const std::int64_t strength = memory.slot(scene, Map::W::attract_strength);
  std::int64_t away = 65535;
  ++tally->outside;
  tally->at_centre += x == 0;
  if (x == 0 || strength / (x * x) > 65535) {
    ++tally->saturated;
  } else {
    away = strength / (x * x);
  }
  if (x < 0) away = -away;
  return attract ? -away : away;
}

struct LawBeside {
  Tally* tally;
  void forget() {}
  const char* at(const Probe& p, const Block::Rtl& rtl, const Block::Twin&) {
    if (p.t != kRendered) return nullptr;
    const Wave& w = p.wave;
    const std::int64_t outside = Block::outside(rtl);
    const std::int64_t core = rounded(sign_extend<kPartWidth>(rtl.plus_o)) -
                              rounded(sign_extend<kPartWidth>(rtl.minus_o));
    const std::int64_t tau = core + outside;
    ++tally->waves;
    if (!is_charge(w.scene)) return tau == 0 ? nullptr : "a torque while not selected";
    if (!w.armed || w.disarmed_from <= kRendered) {
      ++tally->disarmed;
      return outside == 0 ? nullptr : "a torque while disarmed";
    }
    if (core != 0 && outside != 0) return "both laws at once";
    tally->up += tau > 0;
    tally->down += tau < 0;
    const bool attract = w.scene == S::charge_attract;
    if (tau != Law::torque(p.memory.words(), attract, w.position).raw()) return "the law's torque";
    return tau == oracle(p.memory, w.scene, w.position, tally) ? nullptr
                                                               : "torque is not what integers give";
  }
};

struct Next {
  Random random;
  Wave operator()(Memory& memory, std::int64_t) {
    Wave wave;
    wave.scene = random.one_in(10) ? static_cast<int>(random.below(16))
                 : random.coin()   ? S::charge_attract
                                   : S::charge_repel;
    wave.armed = !random.one_in(20);
    if (random.one_in(20)) wave.disarmed_from = static_cast<int>(random.below(kRendered + 1));
    const int bank = wave.scene * 32;
    if (is_charge(wave.scene)) change(memory, bank);
    wave.position = any_position(random, memory, wave.scene);
    const std::int64_t centre = memory.reference(wave.scene) >> 8;
    const std::int64_t core = half_width(memory, wave.scene);
    if (random.one_in(3)) wave.position = static_cast<std::int32_t>(random.between(-30, 30));
    if (random.one_in(4) && core > -100 && core < 100000 && centre > -30000 && centre < 30000) {
      wave.position = static_cast<std::int32_t>(centre + (random.coin() ? core : -core) +
                                                random.between(-1, 1));
    }
    if (random.one_in(20)) wave.position = static_cast<std::int32_t>(centre);
    wave.length = static_cast<int>(random.between(Wave::kShortest, 30));
    return wave;
  }
  void change(Memory& memory, int bank) {
    if (random.one_in(4)) {
      memory.write(bank + Map::T::scene_distance,
                   random.one_in(4) ? any_word(random) : random.between(-400000, 400000));
    }
    if (random.one_in(4)) memory.write(bank + Map::W::attract_strength, any_word(random));
    if (random.one_in(4)) {
      memory.write(bank + Map::W::charge_slope, random.below(std::uint64_t{1} << random.below(18)));
    }
    if (random.one_in(4)) {
      memory.write(bank + Map::W::attract_core,
                   random.one_in(3) ? any_word(random) : random.below(2048));
    }
  }
};

}  // namespace

TEST_CASE("scene_charge: random charges, positions, scenes and resets") {
  Tally tally;
  run_waves<Block>("scene_charge", 1, Next{Random(3)}, LawBeside{&tally}, scaled_clocks(3000000),
                   5000);
  INFO("waves " << tally.waves << ", outside " << tally.outside << ", saturated " << tally.saturated
                << ", at the centre " << tally.at_centre << ", far " << tally.far << ", core "
                << tally.core << ", border " << tally.border << ", core large " << tally.core_large
                << ", up " << tally.up << ", down " << tally.down << ", disarmed "
                << tally.disarmed);
  REQUIRE(tally.outside > 10000);
  REQUIRE(tally.saturated > 1000);
  REQUIRE(tally.saturated < tally.outside / 2);
  REQUIRE(tally.at_centre > 300);
  REQUIRE(tally.far > 300);
  REQUIRE(tally.core > 10000);
  REQUIRE(tally.border > 1000);
  REQUIRE(tally.core_large > 1000);
  REQUIRE(tally.up > 10000);
  REQUIRE(tally.down > 10000);
  REQUIRE(tally.disarmed > 3000);
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
                                   : static_cast<std::int32_t>(random.between(-kEnd - 1, kEnd));
    return wave;
  }
};

}  // namespace

TEST_CASE("scene_charge: the design's charge at every small distance") {
  for (const int scene : {S::charge_attract, S::charge_repel}) {
    Tally tally;
    run_waves<Block>("scene_charge", 4, Sweep{Random(5), scene}, LawBeside{&tally},
                     Wave::kShortest * 8000);
    REQUIRE(tally.waves > 7990);
    REQUIRE(tally.up > 2000);
    REQUIRE(tally.down > 2000);
  }
}

namespace {

/// A charge at 100 counts whose strength is 1000 Nm count^2 and whose slope is the design's.
struct Charge {
  explicit Charge(std::int64_t core) {
    for (const int scene : {S::charge_attract, S::charge_repel}) {
      const int bank = 32 * scene;
      memory.write(bank + Map::T::scene_distance, 100 * 256 + 77);  // the fraction is ignored
      memory.write(bank + Map::W::attract_strength, std::int64_t{1000} * 65536);
      memory.write(bank + Map::W::attract_core, core);
    }
  }
  std::int64_t tau(bool attract, std::int32_t x) const {
    return Law::torque(memory.words(), attract, 100 + x).raw();
  }
  Memory memory;
};

std::int64_t outside(std::int64_t x) {
  const std::int64_t q = std::int64_t{65536000} / (x * x);
  return q > 65535 ? 65535 : q;
}

}  // namespace

TEST_CASE("scene_charge: sign table") {
  const Charge charge(0);
  REQUIRE(charge.tau(true, 0) == -65535);  // sgn(0) = +1
  REQUIRE(charge.tau(false, 0) == 65535);
  for (std::int32_t x = 1; x < 20000; x += x < 300 ? 1 : 77) {
    const std::int64_t away = charge.tau(false, x);
    REQUIRE(away == outside(x));
    REQUIRE(charge.tau(false, -x) == -away);
    REQUIRE(charge.tau(true, x) == -away);
    REQUIRE(charge.tau(true, -x) == away);
  }
}

TEST_CASE("scene_charge: the core holds up to and including its half-width; 0 or less is none") {
  for (const std::int64_t core : {1, 2, 50, 1000}) {
    const Charge charge(core);
    for (const bool attract : {true, false}) {
      const std::int64_t slope =
          charge.memory.factor(attract ? S::charge_attract : S::charge_repel, Map::W::charge_slope);
      const int drop =
          (attract ? Design::P::attract_core_slope : Design::P::repel_core_slope).fraction - 16;
      const std::int64_t half = std::int64_t{1} << (drop - 1);
      for (const std::int64_t x : {core, -core}) {
        const std::int64_t pull = (-x * slope + half) >> drop;
        REQUIRE(charge.tau(attract, static_cast<std::int32_t>(x)) == (attract ? pull : -pull));
      }
      for (const int sign : {1, -1}) {
        const std::int64_t away = sign * outside(core + 1);
        REQUIRE(charge.tau(attract, static_cast<std::int32_t>(sign * (core + 1))) ==
                (attract ? -away : away));
      }
      REQUIRE(charge.tau(attract, 0) == 0);
    }
  }
  for (const std::int64_t core : {0, -1, -1000}) {
    REQUIRE(Charge(core).tau(true, 0) == -65535);
    REQUIRE(Charge(core).tau(false, 1) == 65535);
  }
}
