// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/scenes/scenes.sv: the torque of the selected scene, followed by limiter and ramp,
// which give the torque reference. Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/ramp.hpp"
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

/// What replaces the scene's torque during the self-test: nothing, 0, or the self-test's torque in
/// either direction.
enum class TestPulse : std::uint8_t { none, rest, up, down };

/// All scenes tick by tick, in number policy N.
template <class D, class N>
class ScenesLaw {
 public:
  using S = typename D::S;
  using Torque = typename N::template num<D::f.torque.key()>;
  using Rendered = typename ScenePartLaw<D, N>::Torque;
  using Velocity = typename N::template num<D::f.velocity.key()>;

  void reset() { *this = ScenesLaw{}; }

  /// One tick. `position` in counts, saturated to 18 bits in Fixed; `w` holds the words in force.
  template <class W>
  void tick(const W& w, bool armed, int scene, std::int32_t position, Velocity velocity,
            Relief relief = {}, TestPulse pulse = TestPulse::none) {
    constexpr int limit_key = RampLaw<D, N>::kLimitKey;
    Rendered rendered = torque(w, scene, position, velocity, &side_);
    if constexpr (scene_built<D>(S::law)) {
      if (scene == S::law) rendered = ScenePartLaw<D, N>::whole(programmed_);
    }
    ramp_.begin(armed && pulse == TestPulse::none, scene, relief);
    // The least of all that limit.
    auto limit = w.template get<limit_key>(D::A::torque_limit);
    const auto lower = [&](bool limits, int address) {
      const auto other = w.template get<limit_key>(address);
      if (limits && other < limit) limit = other;
    };
    lower(relief.derated, D::A::hold_limit);
    lower(pulse != TestPulse::none, D::A::self_test_torque);
    if (pulse == TestPulse::none) {
      ramp_.limit(rendered, limit);
    } else {
      ramp_.pulse(pulse == TestPulse::up ? 1 : pulse == TestPulse::down ? -1 : 0, limit);
    }
    ramp_.move(w.ramp_step());
  }

  /// Sets the torque that a program asks for [Nm], for the scene law; it holds until the next call.
  void program(Torque torque) { programmed_ = torque; }

  /// Torque reference [Nm], positive toward counting up.
  Torque tau_ref() const { return ramp_.tau_ref(); }
  bool limit_torque() const { return ramp_.limit_torque(); }
  bool limit_ramp() const { return ramp_.limit_ramp(); }

  /// Internal state, for callers that share it.
  RampLaw<D, N>& ramp() { return ramp_; }
  MembraneSide side() const { return side_; }
  void set_side(MembraneSide side) { side_ = side; }

  /// The torque of one scene before limit and ramp; 0 for the scene law. Updates `side`.
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
  RampLaw<D, N> ramp_;
  MembraneSide side_ = MembraneSide::unknown;
  Torque programmed_{};
};

}  // namespace feltgate
