// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/estimators/dob.sv, clock by clock, by the law of the chain. Documentation:
// docs/blocks/dob.md
#pragma once

#include <cstdint>

#include "../lowpass/lowpass_twin.hpp"
#include "feltgate/dob.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class Dob {
 public:
  using Law = DobLaw<D, Fixed>;
  using Current = fixed_of<D::f.current.key()>;
  using Velocity = fixed_of<D::f.velocity.key()>;
  using TorqueConstant = fixed_of<D::P::torque_constant.key()>;
  using InertiaGain = fixed_of<D::P::inertia_gain.key()>;

  struct In {
    bool armed = false;
    std::uint64_t wave = 0;
    std::int64_t product = 0;  ///< Ktn*I in T::drive_torque, g*Jn*w in T::observer_input
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t tau_hat = 0;
    bool saturated = false;
  };

  void reset() {
    filter_.reset();
    tau_hat_ = typename Law::Torque{};
    out_ = {};
  }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    filter_.clock({at(T::observer_difference), at(T::observer_state), !in.armed,
                   static_cast<std::int64_t>(input_.raw()), in.product});
    if (at(T::tau_hat)) observe();
    if (at(T::observer_input)) {
      inertia_ = Law::inertia(decltype(Velocity{} * InertiaGain{})::from_raw(in.product));
      input_ = Law::input(drive_, inertia_);
    }
    if (at(T::drive_torque)) {
      drive_ = in.armed ? Law::drive(decltype(Current{} * TorqueConstant{})::from_raw(in.product))
                        : typename Law::Drive{};
    }
    out_.operand = filter_.out().operand;
  }

  const Out& out() const { return out_; }
  typename Law::Torque tau_hat() const { return tau_hat_; }

 private:
  void observe() {
    out_.saturated = false;
    tau_hat_ = Law::tau_hat(filter_.state(), inertia_, &out_.saturated);
    out_.tau_hat = tau_hat_.raw();
  }

  Lowpass<D::f.observer.key(), D::f.observer_difference.key(), D::P::observer_a1.key(), D::rounding>
      filter_;
  typename Law::Drive drive_{};
  typename Law::Inertia inertia_{};
  typename Law::State input_{};
  typename Law::Torque tau_hat_{};
  Out out_;
};

}  // namespace feltgate
