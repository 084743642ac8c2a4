// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One tick of the whole chain, from the sampled counts to the duty, by the laws of the blocks in
// any number policy: no pins, no clocks, no supervisor. Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <cstdint>

#include "feltgate/dob.hpp"
#include "feltgate/scenes.hpp"
#include "feltgate/torque_control.hpp"
#include "feltgate/velocity_n.hpp"
#include "feltgate/words.hpp"
#include "reference/real_chain.hpp"

namespace feltgate {

/// The chain of design D in number policy N; `words()` holds its parameters.
template <class D, class N>
class ControlChain {
 public:
  using VelocityRule = VelocityLaw<D, N>;
  using Observer = DobLaw<D, N>;
  using Velocity = typename VelocityRule::Velocity;
  using Torque = typename Observer::Torque;

  void reset() {
    words_.reset();
    line_.reset();
    scenes_.reset();
    velocity_ = {};
    state_ = {};
    tau_hat_ = {};
    control_ = {};
    velocity_saturated_ = tau_hat_saturated_ = false;
  }

  void tick(const ChainIn& in) {
    using P = typename D::P;
    using A = typename D::A;
    const std::int16_t counts = travel_difference(in.travel, line_.oldest());
    line_.push(in.travel);
    velocity_saturated_ = tau_hat_saturated_ = false;
    const Velocity raw = VelocityRule::raw(counts, &velocity_saturated_);
    velocity_ =
        VelocityRule::Filter::next(velocity_, VelocityRule::Filter::operand(raw, velocity_) *
                                                  word<P::velocity_a1.key()>(A::velocity_a1));

    const typename Observer::Drive drive =
        in.armed
            ? Observer::drive(control_.current * word<P::torque_constant.key()>(A::torque_constant))
            : typename Observer::Drive{};
    const typename Observer::Inertia inertia =
        Observer::inertia(velocity_ * word<P::inertia_gain.key()>(A::inertia_gain));
    const typename Observer::State input = Observer::input(drive, inertia);
    state_ = in.armed
                 ? Observer::Filter::next(state_, Observer::Filter::operand(input, state_) *
                                                      word<P::observer_a1.key()>(A::observer_a1))
                 : input;
    tau_hat_ = Observer::tau_hat(state_, inertia, &tau_hat_saturated_);

    scenes_.tick(words_, in.armed, in.scene, scene_position(in.position), velocity_);
    control_.tick(words_, in.armed, static_cast<Mode>(in.mode), scenes_.tau_ref(), tau_hat_,
                  velocity_);
  }

  Words<D, N>& words() { return words_; }
  const Velocity& velocity() const { return velocity_; }
  const Torque& tau_hat() const { return tau_hat_; }
  Torque tau_ref() const { return scenes_.tau_ref(); }
  const TorqueControlStep<D, N>& control() const { return control_; }

  /// The limits word without its last bit, which belongs to the gates (engines/engine.hpp).
  unsigned limits() const {
    const auto bit = [](bool holds, int n) { return (holds ? 1u : 0u) << n; };
    return bit(scenes_.limit_torque(), 0) | bit(scenes_.limit_ramp(), 1) |
           bit(control_.limit.current, 2) | bit(control_.limit.voltage, 3) |
           bit(control_.limit.duty, 4) | bit(velocity_saturated_, 5) | bit(tau_hat_saturated_, 6);
  }

 private:
  template <int Key>
  auto word(int address) const {
    return words_.template get<Key>(address);
  }
  /// What a scene sees: in fixed point the position saturates to 18 bits.
  static std::int32_t scene_position(std::int32_t position) {
    if constexpr (N::is_fixed) {
      constexpr auto end = fixed_of<D::f.scene_position.key()>::max_raw();
      return static_cast<std::int32_t>(std::clamp<std::int64_t>(position, -end - 1, end));
    } else {
      return position;
    }
  }

  Words<D, N> words_;
  DelayLine<D::m1> line_;
  ScenesLaw<D, N> scenes_;
  TorqueControlStep<D, N> control_;
  Velocity velocity_{};
  typename Observer::State state_{};
  Torque tau_hat_{};
  bool velocity_saturated_ = false, tau_hat_saturated_ = false;
};

}  // namespace feltgate
