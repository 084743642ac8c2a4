// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scenes.sv, clock by clock, made of the twins of the scenes.
// Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "../scene_charge/scene_charge_twin.hpp"
#include "../scene_damper/scene_damper_twin.hpp"
#include "../scene_membrane/scene_membrane_twin.hpp"
#include "../scene_setpoint/scene_setpoint_twin.hpp"
#include "../scene_spring/scene_spring_twin.hpp"
#include "../scene_wall/scene_wall_twin.hpp"
#include "feltgate/scenes.hpp"

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
