// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/scenes.sv: selects a scene, limits its torque, ramps it after arming and after a
// change of scene. Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/limiter.hpp"
#include "feltgate/scene_charge.hpp"
#include "feltgate/scene_damper.hpp"
#include "feltgate/scene_membrane.hpp"
#include "feltgate/scene_setpoint.hpp"
#include "feltgate/scene_spring.hpp"
#include "feltgate/scene_wall.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// Whether design D has scene number `scene`.
template <class D>
constexpr bool scene_built(int scene) {
  return scene >= 0 && scene < 16 && ((D::scene_mask >> scene) & 1) != 0;
}

/// Limit and ramp, in number policy N: what stands between a scene and the torque reference.
template <class D, class N>
class ScenesPort {
 public:
  using Torque = typename N::template num<D::f.torque.key()>;
  using Ramp = typename N::template num<D::f.ramp.key()>;
  /// The torque limit as the limiter reads it.
  static constexpr int kLimitKey = Limiter<D, N>::template key<D::f.torque.fraction>;

  /// Start of a wave: whether a ramp begins.
  void begin(bool armed, int scene) {
    if (!armed || scene != scene_) ramping_ = true;
    scene_ = scene;
    armed_ = armed;
  }
  /// The scene's torque in [-limit, limit]; a negative limit counts as 0.
  template <class Rendered, class Limit>
  void limit(Rendered tau, Limit limit) {
    target_ =
        Limiter<D, N>::template limited<Torque>(armed_ ? tau : Rendered{}, limit, &limit_torque_);
    limit_torque_ = armed_ && limit_torque_;
  }
  /// The reference's way to the target. A negative step counts as 0. The tick in which the target
  /// is found to be within one step ends the ramp; the reference moves on with the next.
  void move(Ramp step) {
    limit_ramp_ = armed_ && ramping_;
    if (!limit_ramp_) {
      reference_ = quantise<N, Ramp, Round::truncate, Overflow::wrap>(target_);
      return;
    }
    if (step < Ramp{}) step = Ramp{};
    const auto excess = reference_ - target_;
    if (excess <= step && -excess <= step) {
      ramping_ = false;
    } else if (excess > step) {
      reference_ = quantise<N, Ramp, Round::truncate, Overflow::wrap>(reference_ - step);
    } else {
      reference_ = quantise<N, Ramp, Round::truncate, Overflow::wrap>(reference_ + step);
    }
  }

  /// The reference, its bits below the torque format dropped.
  Torque tau_ref() const {
    return quantise<N, Torque, Round::truncate, Overflow::wrap>(reference_);
  }
  bool limit_torque() const { return limit_torque_; }
  bool limit_ramp() const { return limit_ramp_; }

  /// What lasts from tick to tick beside the scene, for those who keep it elsewhere.
  const Ramp& reference() const { return reference_; }
  bool ramping() const { return ramping_; }
  void resume(int scene, bool ramping, Ramp reference) {
    scene_ = scene;
    ramping_ = ramping;
    reference_ = reference;
  }

 private:
  int scene_ = 0;
  bool armed_ = false, ramping_ = true, limit_torque_ = false, limit_ramp_ = false;
  Torque target_{};
  Ramp reference_{};
};

/// All scenes tick by tick, in number policy N.
template <class D, class N>
class ScenesLaw {
 public:
  using S = typename D::S;
  using Torque = typename N::template num<D::f.torque.key()>;
  using Rendered = typename ScenePart<D, N>::Torque;
  using Velocity = typename N::template num<D::f.velocity.key()>;

  void reset() { *this = ScenesLaw{}; }

  /// One tick. Position in counts, saturated to 18 bits in Fixed; `w` holds the words in force.
  template <class W>
  void tick(const W& w, bool armed, int scene, std::int32_t position, Velocity velocity) {
    port_.begin(armed, scene);
    port_.limit(torque(w, scene, position, velocity, &side_),
                w.template get<ScenesPort<D, N>::kLimitKey>(D::A::torque_limit));
    port_.move(w.ramp_step());
  }

  /// Torque reference [Nm], positive toward counting up.
  Torque tau_ref() const { return port_.tau_ref(); }
  bool limit_torque() const { return port_.limit_torque(); }
  bool limit_ramp() const { return port_.limit_ramp(); }

  /// State, for whoever shares it.
  ScenesPort<D, N>& port() { return port_; }
  MembraneSide side() const { return side_; }
  void set_side(MembraneSide side) { side_ = side; }

  /// The torque of one scene before limit and ramp; moves `side` on.
  template <class W>
  static Rendered torque(const W& w, int scene, std::int32_t position, Velocity velocity,
                         MembraneSide* side) {
    if (scene != S::membrane) *side = MembraneSide::unknown;
    if (!scene_built<D>(scene)) return Rendered{};
    switch (scene) {
      case S::setpoint:
        return SceneSetpointLaw<D, N>::torque(w);
      case S::membrane:
        return SceneMembraneLaw<D, N>::torque(w, position, side);
      case S::spring_compression:
        return SceneSpringLaw<D, N>::torque(w, false, position);
      case S::spring_tension:
        return SceneSpringLaw<D, N>::torque(w, true, position);
      case S::damper:
        return SceneDamperLaw<D, N>::torque(w, velocity);
      case S::charge_attract:
        return SceneChargeLaw<D, N>::torque(w, true, position);
      case S::charge_repel:
        return SceneChargeLaw<D, N>::torque(w, false, position);
      case S::wall:
        return SceneWallLaw<D, N>::torque(w, position, velocity);
      default:
        return Rendered{};
    }
  }

 private:
  ScenesPort<D, N> port_;
  MembraneSide side_ = MembraneSide::unknown;
};

}  // namespace feltgate
