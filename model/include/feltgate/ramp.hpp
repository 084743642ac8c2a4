// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/ramp.sv: the torque reference follows the limited torque of the scene, in steps after
// arming, after a change of scene and where it may jump otherwise. Documentation:
// docs/blocks/ramp.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/limiter.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// What keeps a torque from growing.
struct Relief {
  bool frozen = false;  ///< the reference may only fall
  bool eased = false;   ///< the limit is hold_limit
};

/// As a core's limits say.
constexpr Relief relief_of(unsigned limits) {
  return {((limits >> Map::L::chatter) & 1U) != 0, ((limits >> Map::L::hold) & 1U) != 0};
}

/// In number policy N, for design D: what stands between a scene and the torque reference, its
/// limit included.
template <class D, class N>
class RampLaw {
 public:
  using Torque = typename N::template num<D::f.torque.key()>;
  using Ramp = typename N::template num<D::f.ramp.key()>;
  /// The torque limit as the limiter reads it.
  static constexpr int kLimitKey = LimiterLaw<D, N>::template key<D::f.torque.fraction>;

  /// Start of a wave: whether a ramp begins.
  void begin(bool armed, int scene, Relief relief = {}) {
    if (!armed || scene != scene_ || relief.eased != relief_.eased) ramping_ = true;
    scene_ = scene;
    armed_ = armed;
    relief_ = relief;
  }
  /// Between two waves: the torque may jump with the next.
  void restart() { ramping_ = true; }
  /// The scene's torque in [-limit, limit]; a negative limit counts as 0.
  template <class Rendered, class Limit>
  void limit(Rendered tau, Limit limit) {
    bool beyond = false;
    const auto target = LimiterLaw<D, N>::template limited<Torque, D::f.torque.key()>(
        armed_ ? tau : Rendered{}, limit, &beyond);
    aim(target, beyond);
  }
  /// With the scene away: 0, or the limit in either direction.
  template <class Limit>
  void pulse(int sign, Limit limit) {
    bool beyond = false;
    const auto held =
        LimiterLaw<D, N>::template limited<Torque, D::f.torque.key()>(most(), limit, &beyond);
    aim(sign == 0  ? Torque{}
        : sign > 0 ? held
                   : quantise<N, Torque, Round::truncate, Overflow::wrap>(-held),
        beyond);
  }
  /// The target, and whether it was beyond the limit.
  void aim(Torque target, bool beyond) {
    target_ = target;
    limit_torque_ = armed_ && beyond;
  }
  /// The reference's way to the target. A step is one LSB at least. The tick in which the target
  /// is found to be within one step ends the ramp; the reference moves on with the next. Frozen,
  /// the reference follows towards 0 only; of two torques of different signs it keeps the positive
  /// one.
  void move(Ramp step) {
    const bool grows =
        reference_ < Ramp{} ? reference_ >= target_ : reference_ < target_ || target_ < Torque{};
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

  /// The reference, its bits below the torque format dropped.
  Torque tau_ref() const {
    return quantise<N, Torque, Round::truncate, Overflow::wrap>(reference_);
  }
  bool limit_torque() const { return limit_torque_; }
  bool limit_ramp() const { return limit_ramp_; }
  bool limit_hold() const { return relief_.eased; }

  /// What lasts from tick to tick beside the scene, for those who keep it elsewhere.
  const Ramp& reference() const { return reference_; }
  bool ramping() const { return ramping_; }
  void resume(int scene, bool ramping, Ramp reference) {
    scene_ = scene;
    ramping_ = ramping;
    reference_ = reference;
  }

 private:
  /// One LSB of the reference.
  static Ramp least() {
    if constexpr (N::is_fixed) {
      return N::template from_raw<D::f.ramp.key()>(1);
    } else {
      return Ramp(1.0 / (1 << D::f.ramp.fraction));
    }
  }
  /// Beyond every limit, or at it.
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
