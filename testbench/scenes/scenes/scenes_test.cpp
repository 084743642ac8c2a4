// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// scenes: RTL against twin on every clock, and against the laws in every wave; the laws' distance
// from 113-bit arithmetic. Documentation: docs/blocks/scenes.md
#include <Vscenes.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/quad.hpp"
#include "feltgate/scenes.hpp"
#include "scene_bench.hpp"
#include "scene_twins.hpp"

// Twin of rtl/core/scenes/scenes.sv, clock by clock, made of the twins of the scenes.

namespace feltgate {

/// Clocked twin. A scene that D has not is not selected: then it renders nothing.
template <class D>
class Scenes {
 public:
  using Law = ScenePartLaw<D, Fixed>;
  using Part = typename Law::Part;
  using S = typename D::S;

  struct In {
    bool armed = false;
    int scene = 0;
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    std::int64_t position = 0;
    std::int64_t product = 0;
    bool over_limit = false;      ///< from the limiter
    std::int64_t law_torque = 0;  ///< of a program, raw
    bool law_late = false;
  };
  struct Out {
    std::int64_t distance = 0;
    bool square = false;  ///< follows the scene within the clock
    std::int64_t early_term = 0;
    std::int64_t late_term = 0;
    bool law = false;  ///< follows the scene within the clock
  };

  void reset() {
    membrane_.reset();
    charge_.reset();
  }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    const bool repel = built(in, S::charge_repel), attract = built(in, S::charge_attract);
    const std::int64_t width = at(Map::T::charge_width) ? gap_ : 0;
    const bool law = built(in, S::law);
    const bool programmed = law && at(Map::T::law_torque) && in.armed && !in.law_late;
    out_.early_term = (at(Map::T::scene_rounded) && in.armed ? rounded(in, repel) : 0) | width |
                      (programmed ? in.law_torque : 0);
    if (at(Map::T::scene_sum)) add();
    const std::int64_t gap =
        (decode_word(D::f.scene_offset, in.param) >> D::f.scene_offset.fraction) - in.position;
    clock_scenes(in, attract, repel, gap);
    out_.late_term = charge_.out().outside;
    out_.square = attract || repel;
    out_.law = law;
    const bool reference = at(Map::T::scene_distance);
    if (reference) {
      gap_ = gap;
      out_.distance = (gap << D::f.scene_offset.fraction) | (out_.square ? 0 : fraction(in));
    } else if (!held_) {
      out_.distance = 0;
    }
    held_ = reference;
  }

  const Out& out() const { return out_; }

 private:
  static bool built(const In& in, int scene) { return in.scene == scene && scene_built<D>(scene); }
  static std::int64_t fraction(const In& in) {
    return in.param & ((1u << D::f.scene_offset.fraction) - 1);
  }
  void clock_scenes(const In& in, bool attract, bool repel, std::int64_t gap) {
    setpoint_.clock({built(in, S::setpoint), in.wave, in.param});
    membrane_.clock({built(in, S::membrane), out_.distance > 0, gap < 0, in.wave, in.param});
    spring_.clock({built(in, S::spring_tension), built(in, S::spring_compression), gap_ < 0,
                   in.wave, in.product});
    damper_.clock({built(in, S::damper), in.wave, in.product});
    charge_.clock(
        {in.armed, attract, repel, out_.distance, in.wave, in.param, in.product, in.over_limit});
    wall_.clock({built(in, S::wall), gap_ < 0, in.wave, in.product});
  }
  /// At most one scene renders.
  void add() {
    constexpr int guard = Part::format.fraction - D::f.torque.fraction;
    plus_ = spring_.out().plus + charge_.out().plus + wall_.out().plus +
            (setpoint_.out().plus + membrane_.out().plus) * (1 << guard);
    minus_ = damper_.out().minus + charge_.out().minus + wall_.out().minus +
             membrane_.out().minus * (1 << guard);
  }
  /// The sum rounded as the scene is meant to; a wall never pulls.
  std::int64_t rounded(const In& in, bool repel) const {
    const auto sum = Part::from_raw(plus_) - Part::from_raw(minus_);
    if (built(in, S::wall) && sum >= Part{}) return 0;
    if (built(in, S::damper) || repel) return negated(Law::rounded(-sum)).raw();
    return Law::rounded(sum).raw();
  }

  SceneSetpoint<D> setpoint_;
  SceneMembrane<D> membrane_;
  SceneSpring<D> spring_;
  SceneDamper<D> damper_;
  SceneCharge<D> charge_;
  SceneWall<D> wall_;
  std::int64_t gap_ = 0, plus_ = 0, minus_ = 0;
  bool held_ = false;
  Out out_;
};

}  // namespace feltgate

// Connects the ports of the Verilated scenes to the twin's, and checks the result of each wave.

namespace feltgate::test {

#ifdef FELTGATE_SCENE_MASK
/// The design with another set of scenes.
struct Built : Design {
  static constexpr int scene_mask = FELTGATE_SCENE_MASK;
};
#else
using Built = Design;
#endif

struct Block : BlockOf<Vscenes, Scenes<Built>> {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {bus.armed,   wave.scene,     bus.wave,       bus.param,   wave.position,
            bus.product, bus.over_limit, bus.law_torque, bus.law_late};
  }
  static void drive(Rtl& rtl, const Twin::In& in) {
    rtl.armed_i = in.armed;
    rtl.scene_i = static_cast<std::uint8_t>(in.scene);
    rtl.wave_i = in.wave;
    rtl.param_i = in.param;
    rtl.position_i = port_bits<18>(in.position);
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
    rtl.over_limit_i = in.over_limit;
    rtl.law_torque_i = port_bits<kTorque.width()>(in.law_torque);
    rtl.law_late_i = in.law_late;
  }
  /// As the limiter takes it: rounded.
  static std::int64_t early_term(const Rtl& rtl) {
    return sign_extend<Design::f.scene_torque.width()>(rtl.early_term_o) + rtl.early_up_o;
  }
  static std::int64_t late_term(const Rtl& rtl) {
    const std::int64_t term = sign_extend<kTorque.width()>(rtl.late_term_o);
    return (rtl.late_not_o ? ~term : term) + rtl.late_up_o;
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("distance", sign_extend<Design::f.scene_distance.width()>(rtl.distance_o), out.distance);
    check("square", rtl.square_o, out.square);
    check("early_term", early_term(rtl), out.early_term);
    check("late_term", late_term(rtl), out.late_term);
    check("law", rtl.law_o, out.law);
  }
};

struct Tally {
  std::int64_t waves = 0, disarmed = 0, halted = 0;
  std::array<std::int64_t, 16> up{}, down{};  ///< waves with a torque, by scene
};

/// The law of the scene; what holds of its torque whatever the law; each word in its clock alone.
struct LawBeside {
  using Law = ScenesLaw<Built, Fixed>;
  using T = Map::T;
  Tally* tally;
  MembraneSide side = MembraneSide::unknown;
  std::int64_t seen = 0;

  void forget() { side = MembraneSide::unknown; }
  const char* at(const Probe& p, const Vscenes& rtl, const Scenes<Built>&) {
    const Wave& w = p.wave;
    const std::int64_t distance = distance_of(p.memory, w);
    const bool shows = p.t == T::scene_distance || p.t == T::scene_distance + 1;
    const bool built = scene_built<Built>(w.scene);
    const std::int64_t wanted =
        is_charge(w.scene) && !built ? distance | (p.memory.reference(w.scene) & 255) : distance;
    if (sign_extend<Design::f.scene_distance.width()>(rtl.distance_o) != (shows ? wanted : 0)) {
      return "the distance, in two clocks alone";
    }
    if ((rtl.square_o != 0) != (is_charge(w.scene) && built)) return "the square is the charges'";
    const std::int64_t early_term = Block::early_term(rtl);
    if (p.t == T::scene_rounded) {
      seen = early_term;
    } else if (early_term != (p.t == T::charge_width ? distance >> 8 : 0)) {
      return "the distance in whole counts, and nothing in other clocks";
    }
    return p.t == kRendered ? whole(p, Block::late_term(rtl)) : nullptr;
  }

 private:
  const char* whole(const Probe& p, std::int64_t late_term) {
    const Wave& w = p.wave;
    const std::int64_t tau = seen + late_term;
    const auto velocity = Law::Velocity::from_raw(w.velocity);
    auto law = Law::torque(p.memory.words(), w.scene, w.position, velocity, &side).raw();
    if (w.scene == S::law && scene_built<Built>(w.scene) && !w.law_late) law = w.law_torque;
    const auto scene = static_cast<std::size_t>(w.scene);
    ++tally->waves;
    tally->up[scene] += tau > 0;
    tally->down[scene] += tau < 0;
    tally->disarmed += !w.armed;
    if (seen != 0 && late_term != 0) return "two torques at once";
    if (!w.armed) return tau == 0 ? nullptr : "a torque while disarmed";
    if (w.disarmed_from <= kRendered) {
      ++tally->halted;
      return late_term == 0 && (seen == 0 || w.disarmed_from == kRendered)
                 ? nullptr
                 : "a torque once disarmed";
    }
    if (tau != law) return "the law's torque";
    if (w.scene == S::wall && tau > 0) return "a wall pulls";
    if (w.scene == S::spring_compression && tau < 0) return "a compressed spring pulls";
    if (w.scene == S::damper && ((tau > 0 && w.velocity > 0) || (tau < 0 && w.velocity < 0))) {
      return "a damper drives";
    }
    return nullptr;
  }
};

}  // namespace feltgate::test

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
