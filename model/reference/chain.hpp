// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The real-arithmetic chain of one design: the laws of the twin, evaluated in double or in 113
// bits. Documentation: docs/architecture.md
#pragma once

#include "feltgate/dob.hpp"
#include "feltgate/scenes.hpp"
#include "feltgate/torque_control.hpp"
#include "feltgate/velocity_n.hpp"
#include "feltgate/words.hpp"
#include "reference/real_chain.hpp"

namespace feltgate {

/// IEEE binary128 of the compiler: 113 bits of mantissa.
__extension__ typedef __float128 Quad;

template <class D, class T>
class Chain : public RealChain {
 public:
  using N = Real<T>;

  explicit Chain(const char* name) : name_(name) { reset(); }
  const char* name() const override { return name_; }

  void reset() override {
    words_.reset();
    line_.reset();
    scenes_.reset();
    velocity_ = state_ = T{0};
    control_ = {};
    out_ = {};
  }

  void set_parameter(int address, double value) override {
    words_.set_value(address, static_cast<T>(value));
  }

  void tick(const ChainIn& in) override {
    using P = typename D::P;
    using A = typename D::A;
    const Mode mode = static_cast<Mode>(in.mode);

    const std::int16_t counts = travel_difference(in.travel, line_.oldest());
    line_.push(in.travel);
    bool saturated = false;
    const T raw = Velocity::raw(counts, &saturated);
    velocity_ = Velocity::Filter::next(velocity_,
                                       words_.template get<P::velocity_a1.key()>(A::velocity_a1) *
                                           Velocity::Filter::operand(raw, velocity_));

    const T drive =
        in.armed
            ? Observer::drive(control_.current *
                              words_.template get<P::torque_constant.key()>(A::torque_constant))
            : T{0};
    const T inertia =
        Observer::inertia(velocity_ * words_.template get<P::inertia_gain.key()>(A::inertia_gain));
    const T input = Observer::input(drive, inertia);
    state_ = in.armed ? Observer::Filter::next(
                            state_, words_.template get<P::observer_a1.key()>(A::observer_a1) *
                                        Observer::Filter::operand(input, state_))
                      : input;
    const T tau_hat = Observer::tau_hat(state_, inertia, &saturated);

    scenes_.tick(words_, in.armed, in.scene, in.position, velocity_);
    control_.tick(words_, in.armed, mode, scenes_.tau_ref(), tau_hat, velocity_);

    out_.velocity_rad_s = static_cast<double>(velocity_);
    out_.tau_hat_nm = static_cast<double>(tau_hat);
    out_.tau_ref_nm = static_cast<double>(scenes_.tau_ref());
    out_.current_a = static_cast<double>(control_.current);
    out_.voltage_v = static_cast<double>(control_.voltage);
    out_.duty_clocks = static_cast<double>(control_.duty);
  }

  const ChainOut& out() const override { return out_; }

 private:
  using Velocity = VelocityLaw<D, N>;
  using Observer = DobLaw<D, N>;

  const char* name_;
  Words<D, N> words_;
  DelayLine<D::m1> line_;
  ScenesLaw<D, N> scenes_;
  TorqueControlStep<D, N> control_;
  T velocity_{}, state_{};
  ChainOut out_;
};

}  // namespace feltgate
