// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/scenes.sv: selects a scene, limits its torque, ramps it after arming and after a
// change of scene. Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

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

  /// Start of a wave: whether a ramp begins.
  void begin(bool armed, int scene) {
    if (!armed || scene != scene_) ramping_ = true;
    scene_ = scene;
    armed_ = armed;
  }
  /// The scene's torque in [-limit, limit]; a negative limit counts as 0.
  void limit(Torque tau, Torque limit) {
    limit_torque_ = armed_ && beyond<N>(tau, limit);
    const Torque bound = limit < Torque{} ? Torque{} : limit;
    bool unused = false;
    target_ = armed_ ? clamp_magnitude(tau, bound, &unused) : Torque{};
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
  using Velocity = typename N::template num<D::f.velocity.key()>;

  void reset() { *this = ScenesLaw{}; }

  /// One tick. Position in counts, saturated to 18 bits in Fixed; `w` holds the words in force.
  template <class W>
  void tick(const W& w, bool armed, int scene, std::int32_t position, Velocity velocity) {
    port_.begin(armed, scene);
    port_.limit(torque(w, scene, position, velocity, &side_), w.torque_limit());
    port_.move(w.ramp_step());
  }

  /// Torque reference [Nm], positive toward counting up.
  Torque tau_ref() const { return port_.tau_ref(); }
  bool limit_torque() const { return port_.limit_torque(); }
  bool limit_ramp() const { return port_.limit_ramp(); }

  /// State, for the clocked twin that shares it.
  ScenesPort<D, N>& port() { return port_; }
  MembraneSide side() const { return side_; }
  void set_side(MembraneSide side) { side_ = side; }

  /// The torque of one scene before limit and ramp; moves `side` on.
  template <class W>
  static Torque torque(const W& w, int scene, std::int32_t position, Velocity velocity,
                       MembraneSide* side) {
    if (scene != S::membrane) *side = MembraneSide::unknown;
    if (!scene_built<D>(scene)) return Torque{};
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
        return Torque{};
    }
  }

 private:
  ScenesPort<D, N> port_;
  MembraneSide side_ = MembraneSide::unknown;
};

/// Clocked twin. Each wave is driven by clock() or by tick(); the two may take turns.
template <class D>
class Scenes {
 public:
  using S = typename D::S;
  using Torque = fixed_of<D::f.torque.key()>;
  using Velocity = fixed_of<D::f.velocity.key()>;

  struct In {
    bool armed = false;  ///< stable during a wave, as is the scene
    int scene = 0;
    bool start = false;         ///< clock 1 of a wave
    std::int32_t position = 0;  ///< counts, 18 bits, stable during a wave
    std::uint32_t param = 0;
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t operand = 0;  ///< follows the scene at once, as does square
    bool square = false;
    std::int64_t tau_ref = 0;
    bool limit_torque = false;
    bool limit_ramp = false;
  };

  void reset() { *this = Scenes{}; }

  void clock(const In& in) {
    ScenesPort<D, Fixed>& port = law_.port();
    if ((stage_ & stage(27)) != 0) port.move(step_);
    if ((stage_ & stage(26)) != 0) {
      step_ = fixed_of<D::f.ramp.key()>::from_raw(decode_word(D::f.ramp, in.param));
    }
    if ((stage_ & stage(25)) != 0) {
      const std::int64_t tau = setpoint_.out().tau + membrane_.out().tau + spring_.out().tau +
                               damper_.out().tau + charge_.out().tau + wall_.out().tau;
      port.limit(Torque::from_raw(tau), Torque::from_raw(decode_word(D::f.torque, in.param)));
    }
    if (in.start) port.begin(in.armed, in.scene);
    stage_ = (stage_ << 1) | (in.start ? 1u : 0u);
    clock_scenes(in);
    law_.set_side(membrane_.side());
    scene_ = in.scene;
  }

  /// A whole wave at once. Position in counts, 18 bits; what operand shows is not kept up.
  template <class W>
  void tick(const W& w, bool armed, int scene, std::int32_t position, Velocity velocity) {
    law_.tick(w, armed, scene, position, velocity);
    membrane_.set_side(law_.side());
    scene_ = scene;
  }

  /// Outputs with the inputs of this clock, before the next edge.
  Out peek(const In& in) const { return show(in.scene); }
  Out out() const { return show(scene_); }

  /// Torque reference [Nm], positive toward counting up.
  Torque tau_ref() const { return law_.tau_ref(); }
  bool limit_torque() const { return law_.limit_torque(); }
  bool limit_ramp() const { return law_.limit_ramp(); }

 private:
  static constexpr std::uint32_t stage(int clock) { return 1u << (clock - 2); }
  static bool runs(int scene, int wanted) { return scene == wanted && scene_built<D>(scene); }
  static bool charge(int scene) {
    return runs(scene, S::charge_attract) || runs(scene, S::charge_repel);
  }

  Out show(int scene) const {
    constexpr bool spring =
        scene_built<D>(S::spring_compression) || scene_built<D>(S::spring_tension);
    Out o;
    o.square = charge(scene);
    o.operand = o.square                  ? charge_.out().operand
                : spring                  ? spring_.out().operand
                : scene_built<D>(S::wall) ? wall_.out().operand
                                          : 0;
    o.tau_ref = tau_ref().raw();
    o.limit_torque = limit_torque();
    o.limit_ramp = limit_ramp();
    return o;
  }

  void clock_scenes(const In& in) {
    const bool tension = in.scene == S::spring_tension;
    const bool spring = runs(in.scene, S::spring_tension) || runs(in.scene, S::spring_compression);
    const bool attract = in.scene == S::charge_attract;
    setpoint_.clock({runs(in.scene, S::setpoint), in.start, in.param});
    membrane_.clock({runs(in.scene, S::membrane), in.start, in.position, in.param});
    spring_.clock({spring, tension, in.start, in.position, in.param, in.product});
    damper_.clock({runs(in.scene, S::damper), in.start, in.product});
    charge_.clock({charge(in.scene), attract, in.start, in.position, in.param, in.product});
    wall_.clock({runs(in.scene, S::wall), in.start, in.position, in.param, in.product});
  }

  SceneSetpoint<D> setpoint_;
  SceneMembrane<D> membrane_;
  SceneSpring<D> spring_;
  SceneDamper<D> damper_;
  SceneCharge<D> charge_;
  SceneWall<D> wall_;
  ScenesLaw<D, Fixed> law_;
  fixed_of<D::f.ramp.key()> step_{};
  std::uint32_t stage_ = 0;
  int scene_ = 0;
};

}  // namespace feltgate
