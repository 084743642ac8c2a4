// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain tick by tick, without pins or clocks: from a sampled count to the duty, in number
// policy N. In Fixed its integers are those of the core's snapshots. Documentation: docs/engines.md
#pragma once

#include <algorithm>
#include <cstdint>

#include "feltgate/dob.hpp"
#include "feltgate/scenes.hpp"
#include "feltgate/torque_control.hpp"
#include "feltgate/velocity_n.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// The laws of one design in a row, with their state and the parameter words. tick() is a whole
/// tick; the core's twin calls the four stages in the clocks in which the RTL shows their results.
template <class D, class N>
class ChainTick {
 public:
  using Velocity = typename VelocityLaw<D, N>::Velocity;
  using Torque = typename DobLaw<D, N>::Torque;

  /// The state after a reset; the parameter words stay, as in the RTL.
  void reset() {
    line_.reset();
    scenes_.reset();
    velocity_ = {};
    observer_ = {};
    tau_hat_ = {};
    control_ = {};
    limit_velocity_ = limit_tau_hat_ = false;
  }

  Words<D, N>& words() { return words_; }
  const Words<D, N>& words() const { return words_; }

  /// One tick. `position` [count] and `travel` [count, wraps] are what the wave sampled; `armed`,
  /// `scene` and `mode` hold during the tick.
  void tick(std::int32_t position, std::int16_t travel, bool armed, int scene, Mode mode) {
    estimate(travel);
    observe(armed);
    render(armed, scene, position);
    drive(armed, mode);
  }

  /// Velocity from the travel.
  void estimate(std::int16_t travel) {
    using Law = VelocityLaw<D, N>;
    limit_velocity_ = false;
    const std::int16_t counts = travel_difference(travel, line_.oldest());
    line_.push(travel);
    const Velocity raw = Law::raw(counts, &limit_velocity_);
    velocity_ = Law::Filter::next(velocity_, Law::Filter::operand(raw, velocity_) *
                                                 word<P::velocity_a1.key()>(A::velocity_a1));
  }
  /// tau_hat from the velocity and the current of the tick before.
  void observe(bool armed) {
    using Law = DobLaw<D, N>;
    const auto drive =
        armed ? Law::drive(control_.current * word<P::torque_constant.key()>(A::torque_constant))
              : typename Law::Drive{};
    const auto inertia = Law::inertia(velocity_ * word<P::inertia_gain.key()>(A::inertia_gain));
    const auto input = Law::input(drive, inertia);
    observer_ = armed ? Law::Filter::next(observer_, Law::Filter::operand(input, observer_) *
                                                         word<P::observer_a1.key()>(A::observer_a1))
                      : input;
    limit_tau_hat_ = false;
    tau_hat_ = Law::tau_hat(observer_, inertia, &limit_tau_hat_);
  }
  /// tau_ref from the position, and the velocity in a damper.
  void render(bool armed, int scene, std::int32_t position) {
    scenes_.tick(words_, armed, scene, scene_position(position), velocity_);
  }
  /// Current, voltage and duty.
  void drive(bool armed, Mode mode) {
    control_.tick(words_, armed, mode, scenes_.tau_ref(), tau_hat_, velocity_);
  }

  Velocity velocity() const { return velocity_; }
  Torque tau_hat() const { return tau_hat_; }
  Torque tau_ref() const { return scenes_.tau_ref(); }
  /// Current, voltage, duty, their limits, and the region of the voltage gain.
  const TorqueControlStep<D, N>& control() const { return control_; }

  // The limits of the last tick; in real arithmetic only the first five can be set.
  bool limit_torque() const { return scenes_.limit_torque(); }
  bool limit_ramp() const { return scenes_.limit_ramp(); }
  bool limit_velocity() const { return limit_velocity_; }
  bool limit_tau_hat() const { return limit_tau_hat_; }
  /// The same as bits 0 to 6 of the limits word: torque, ramp, current, voltage, duty, velocity,
  /// tau_hat.
  std::uint8_t limits() const {
    return static_cast<std::uint8_t>(limit_torque() | limit_ramp() << 1 |
                                     control_.limit.current << 2 | control_.limit.voltage << 3 |
                                     control_.limit.duty << 4 | limit_velocity_ << 5 |
                                     limit_tau_hat_ << 6);
  }

 private:
  using P = typename D::P;
  using A = typename D::A;

  template <int Key>
  auto word(int address) const {
    return words_.template get<Key>(address);
  }
  /// Scenes see 18 bits of the position, saturated; in real arithmetic all of it.
  static std::int32_t scene_position(std::int32_t position) {
    if constexpr (N::is_fixed) {
      constexpr std::int32_t end = (1 << (D::f.scene_position.width() - 1)) - 1;
      return std::clamp(position, -end - 1, end);
    } else {
      return position;
    }
  }

  Words<D, N> words_;
  DelayLine<D::m1> line_;
  ScenesLaw<D, N> scenes_;
  TorqueControlStep<D, N> control_;
  Velocity velocity_{};
  typename DobLaw<D, N>::State observer_{};
  Torque tau_hat_{};
  bool limit_velocity_ = false, limit_tau_hat_ = false;
};

}  // namespace feltgate
