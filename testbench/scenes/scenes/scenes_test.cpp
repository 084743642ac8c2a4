// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scenes: RTL against twin on every clock, and against the laws in every wave; the laws' distance
// from 113-bit arithmetic. Documentation: docs/blocks/scenes.md
#include <algorithm>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/quad.hpp"
#include "scenes_bench.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// Scenes, arming, words and motion at random.
struct Next {
  Random random;
  Wave wave{};
  Wave operator()(Memory& memory, std::int64_t) {
    if (random.one_in(25)) wave.scene = static_cast<int>(random.below(11));
    if (random.one_in(50)) wave.scene = static_cast<int>(random.below(16));
    if (random.one_in(20)) wave.armed = !random.one_in(4);
    wave.disarmed_from =
        random.one_in(20) ? static_cast<int>(random.below(kRendered + 1)) : Map::wave_length;
    if (random.one_in(40)) write(memory);
    wave.law_torque = decode_word(kTorque, static_cast<std::uint32_t>(any_word(random)));
    wave.law_late = random.one_in(wave.law_late ? 4 : 30);
    if (random.one_in(12)) {  // on the reference, where a sign is that of 0, or beside it
      const std::int64_t reference = memory.reference(wave.scene) >> 8;
      const std::int64_t beside = random.between(-3, 3) * random.below(2);
      wave.position = static_cast<std::int32_t>(
          std::clamp(reference + beside, std::int64_t{-kEnd - 1}, std::int64_t{kEnd}));
    } else if (random.one_in(3)) {
      wave.position = any_position(random, memory, wave.scene);
    } else {
      wave.position = std::clamp(wave.position + static_cast<std::int32_t>(random.between(-40, 40)),
                                 -kEnd - 1, kEnd);
    }
    wave.velocity = static_cast<std::int32_t>(random.bits()) >> random.below(16);
    wave.length = random.one_in(50) ? 50 : static_cast<int>(random.between(Wave::kShortest, 29));
    return wave;
  }
  void write(Memory& memory) {
    memory.write(A::setpoint_torque, random.between(-60000, 60000));
    memory.write(A::membrane_torque, random.below(1u << (kTorque.width() - 1)) >> random.below(6));
    if (random.one_in(16)) memory.write(A::membrane_torque, -1 - random.between(0, 60000));
    if (random.one_in(4)) {  // the lever where it is, or a part of a count beside it
      const std::int64_t part = random.coin() ? std::int64_t{1} << random.below(8) : 0;
      memory.write(random.coin() ? A::membrane_lower : A::membrane_upper,
                   std::int64_t{256} * wave.position + part);
    }
    memory.write(A::tension_rest, random.between(-300000, 300000));
    memory.write(A::attract_centre, random.between(-300000, 300000));
    // Now and then so wide and steep that the core's torque is beyond any limit.
    const bool wide = random.one_in(4);
    for (const int core : {A::attract_core, A::repel_core}) {
      memory.write(core, random.one_in(3)   ? 0
                         : random.one_in(3) ? std::uint64_t{1} << random.below(21)
                                            : random.below(wide ? 100000 : 400));
    }
    for (const int strength : {A::attract_strength, A::repel_strength}) {
      memory.write(strength, random.coin() ? random.below(1u << 18) : any_word(random));
    }
    for (const int slope : {A::attract_core_slope, A::repel_core_slope}) {
      memory.write(slope, random.below(131072) >> (wide ? 0 : random.below(8)));
    }
    memory.write(A::damper_damping, random.below(131072));
    memory.write(A::tension_stiffness, random.below(131072) >> random.below(8));
    memory.write(static_cast<int>(random.below(512)), any_word(random));
  }
};

bool pulls_never(int scene) { return scene == S::wall; }
bool pushes_only(int scene) { return scene == S::spring_compression; }

}  // namespace

TEST_CASE("scenes: everything at random") {
  Tally tally;
  run_waves<Block>("scenes", 1, Next{Random(3)}, LawBeside{&tally}, scaled_clocks(3000000), 10000);
  INFO("waves " << tally.waves << ", disarmed " << tally.disarmed << ", halted " << tally.halted);
  REQUIRE(tally.waves > 90000);
  REQUIRE(tally.disarmed > tally.waves / 10);
  REQUIRE(tally.halted > tally.waves / 50);
  for (int scene = 0; scene < 16; ++scene) {
    const std::int64_t up = tally.up[static_cast<std::size_t>(scene)];
    const std::int64_t down = tally.down[static_cast<std::size_t>(scene)];
    CAPTURE(scene, up, down);
    const bool acts = scene != S::free && scene_built<Built>(scene);
    REQUIRE((up > 100) == (acts && !pulls_never(scene)));
    REQUIRE((down > 100) == (acts && !pushes_only(scene)));
  }
}

#ifdef FELTGATE_QUAD
namespace feltgate::test {

/// Twin and reference side by side, both past the ramp; the largest distance in torque steps.
class Comparison {
 public:
  explicit Comparison(int scene) : scene_(scene) {
    // A step of 8 Nm ends every ramp in the first tick.
    fixed_words_.set_raw(A::ramp_step, (std::int64_t{1} << 27) - 1);
    real_words_.set_value(A::ramp_step, 8);
    fixed_words_.set_raw(A::setpoint_torque, 13371);
    real_words_.set_value(A::setpoint_torque, Quad{13371} / 65536);
    // In a wall, two large products may cancel: what is left shows every bit of its coefficients.
    use_quantised(A::wall_stiffness, Design::P::wall_stiffness);
    use_quantised(A::wall_damping, Design::P::wall_damping);
    at(0, 0);
  }
  void at(std::int32_t position, std::int64_t velocity) {
    fixed_.tick(fixed_words_, true, scene_, position,
                ScenesLaw<Design, Fixed>::Velocity::from_raw(velocity));
    const Quad exact_velocity = static_cast<Quad>(velocity) /
                                static_cast<Quad>(std::int64_t{1} << Design::f.velocity.fraction);
    real_.tick(real_words_, true, scene_, position, exact_velocity);
    const Quad lsb = Quad{1} / static_cast<Quad>(std::int64_t{1} << kTorque.fraction);
    const Quad error = real_.tau_ref() / lsb - static_cast<Quad>(fixed_.tau_ref().raw());
    const double size = static_cast<double>(error < 0 ? -error : error);
    worst = larger(worst, size);
    acting += fixed_.tau_ref().raw() != 0;
    limited += fixed_.limit_torque();
  }
  double worst = 0;
  std::int64_t acting = 0, limited = 0;

 private:
  void use_quantised(int address, Format format) {
    for (const ParameterInfo& p : Design::parameters) {
      if (p.address != address) continue;
      real_words_.set_value(address, static_cast<Quad>(p.raw) /
                                         static_cast<Quad>(std::int64_t{1} << format.fraction));
    }
  }

  int scene_;
  Words<Design, Fixed> fixed_words_;
  Words<Design, Real<Quad>> real_words_;
  ScenesLaw<Design, Fixed> fixed_;
  ScenesLaw<Design, Real<Quad>> real_;
};

}  // namespace feltgate::test

TEST_CASE("scenes: within one step of torque of the exact laws, given position and velocity") {
  for (const int scene :
       {S::free, S::setpoint, S::membrane, S::spring_compression, S::spring_tension, S::damper,
        S::charge_attract, S::charge_repel, S::wall}) {
    Comparison c(scene);
    Random random(11);
    for (std::int32_t p = -2500; p <= 2500; ++p) c.at(p, p * 20011);
    for (int k = 0; k < 50000; ++k) {
      const std::int64_t range = std::int64_t{1} << random.between(2, 17);
      c.at(static_cast<std::int32_t>(random.between(-range, range - 1)),
           static_cast<std::int32_t>(random.bits()) >> random.below(12));
    }
    INFO("scene " << scene << ", worst " << c.worst << ", acting " << c.acting << ", limited "
                  << c.limited);
    REQUIRE(c.worst <= 1.0);
    REQUIRE((c.acting > 500) == (scene != S::free));
  }
}
#endif
