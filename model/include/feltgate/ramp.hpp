// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/actuation/ramp.sv: the torque reference follows the limited torque of the scene.
// It moves in steps after arming, after a change of scene, and after other events that may make the
// torque jump. Documentation: docs/blocks/torque_control.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/limiter.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// Conditions that keep a torque from growing.
struct Relief {
  bool frozen = false;   ///< the reference may only move towards 0
  bool derated = false;  ///< hold_limit limits too
};

/// The relief that bits of a core's limits word stand for.
constexpr Relief relief_of(unsigned limits) {
  return {((limits >> Map::L::chatter) & 1U) != 0, ((limits >> Map::L::hold) & 1U) != 0};
}

/// The path from a scene's torque to the torque reference, including the torque limit; in number
/// policy N, for design D.
template <class D, class N>
class RampLaw {
 public:
  using Torque = typename N::template num<D::f.torque.key()>;
  using Ramp = typename N::template num<D::f.ramp.key()>;
  /// Format of the torque limit, as the limiter reads it.
  static constexpr int kLimitKey = LimiterLaw<D, N>::template key<D::f.torque.fraction>;

  /// Starts a wave and decides whether a ramp begins.
  void begin(bool armed, int scene, Relief relief = {}) {
    if (!armed || scene != scene_ || relief.derated != relief_.derated) ramping_ = true;
    scene_ = scene;
    armed_ = armed;
    relief_ = relief;
  }
  /// Lets the torque ramp in the next wave; call it between two waves.
  void restart() { ramping_ = true; }
  /// Sets the target: the scene's torque in [-limit, limit]; a negative limit counts as 0.
  template <class Rendered, class Limit>
  void limit(Rendered tau, Limit limit) {
    bool over_limit = false;
    const auto target = LimiterLaw<D, N>::template limited<Torque, D::f.torque.key()>(
        armed_ ? tau : Rendered{}, limit, &over_limit);
    aim(target, over_limit);
  }
  /// Sets the target without a scene: 0 for sign 0, else the limit with that sign.
  template <class Limit>
  void pulse(int sign, Limit limit) {
    bool over_limit = false;
    const auto held =
        LimiterLaw<D, N>::template limited<Torque, D::f.torque.key()>(most(), limit, &over_limit);
    aim(sign == 0  ? Torque{}
        : sign > 0 ? held
                   : quantise<N, Torque, Round::truncate, Overflow::wrap>(-held),
        over_limit);
  }
  /// Sets the target; `over_limit`: it was beyond the limit.
  void aim(Torque target, bool over_limit) {
    target_ = target;
    limit_torque_ = armed_ && over_limit;
  }
  /// Moves the reference towards the target by one step, at least one LSB. The tick in which the
  /// target is found within one step ends the ramp; the reference reaches the target in the next
  /// tick. While frozen, the reference may only move towards 0, and stays where it is if target and
  /// reference have different signs.
  void move(Ramp step) {
    const bool grows = reference_ < Ramp{} ? reference_ >= target_ || target_ > Torque{}
                                           : reference_ < target_ || target_ < Torque{};
    limit_ramp_ = armed_ && (ramping_ || (relief_.frozen && grows));
    if (!limit_ramp_) {
      reference_ = quantise<N, Ramp, Round::truncate, Overflow::wrap>(target_);
      return;
    }
    if (step <= Ramp{}) step = least();
    if (relief_.frozen) step = Ramp{};
    const auto excess = reference_ - target_;
    if (excess <= step && -excess <= step) {
      ramping_ = false;
    } else if (excess > step) {
      reference_ = quantise<N, Ramp, Round::truncate, Overflow::wrap>(reference_ - step);
    } else {
      reference_ = quantise<N, Ramp, Round::truncate, Overflow::wrap>(reference_ + step);
    }
  }

  /// The reference, truncated to the torque format.
  Torque tau_ref() const {
    return quantise<N, Torque, Round::truncate, Overflow::wrap>(reference_);
  }
  bool limit_torque() const { return limit_torque_; }
  bool limit_ramp() const { return limit_ramp_; }
  bool limit_hold() const { return relief_.derated; }

 private:
  /// One LSB of the reference.
  static Ramp least() {
    if constexpr (N::is_fixed) {
      return N::template from_raw<D::f.ramp.key()>(1);
    } else {
      return Ramp(1.0 / (1 << D::f.ramp.fraction));
    }
  }
  /// A torque at or beyond every limit.
  static Torque most() {
    if constexpr (N::is_fixed) {
      constexpr Format torque = D::f.torque;
      return N::template from_raw<torque.key()>((std::int64_t{1} << (torque.width() - 1)) - 1);
    } else {
      return Torque(1e6);
    }
  }

  int scene_ = 0;
  bool armed_ = false, ramping_ = true, limit_torque_ = false, limit_ramp_ = false;
  Relief relief_;
  Torque target_{};
  Ramp reference_{};
};

}  // namespace feltgate
