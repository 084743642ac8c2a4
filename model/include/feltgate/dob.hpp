// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/dob.sv: disturbance observer tau_hat = LPF(Ktn*I + g*Jn*w) - g*Jn*w, the load that
// opposes positive motor torque. Disarmed, the current counts as 0 and the filter follows its
// input, so tau_hat is 0 and arming in motion makes no jump. Documentation: docs/blocks/dob.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/lowpass.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// The arithmetic, in number policy N, for design D.
template <class D, class N>
struct DobLaw {
  using State = typename N::template num<D::f.observer.key()>;
  using Drive = typename N::template num<D::f.drive_torque.key()>;
  using Inertia = typename N::template num<D::f.inertia_torque.key()>;
  using Torque = typename N::template num<D::f.torque.key()>;
  using Filter = LowpassLaw<N, D::f.observer.key(), D::f.observer_difference.key(), D::rounding>;

  /// Ktn*I, truncated below the observer's last bit.
  template <class Product>
  static constexpr Drive drive(Product ktn_times_current) {
    return quantise<N, Drive, Round::truncate, Overflow::wrap>(ktn_times_current);
  }
  /// g*Jn*w, truncated; it enters and leaves the observer alike, so what is cut cancels at rest.
  template <class Product>
  static constexpr Inertia inertia(Product gain_times_velocity) {
    return quantise<N, Inertia, Round::truncate, Overflow::wrap>(gain_times_velocity);
  }
  /// Filter input: exact.
  static constexpr State input(Drive drive, Inertia inertia) {
    return quantise<N, State, Round::truncate, Overflow::wrap>(drive + inertia);
  }
  /// tau_hat, rounded and saturated to the torque format.
  static constexpr Torque tau_hat(State state, Inertia inertia, bool* saturated) {
    return quantise<N, Torque, D::rounding, Overflow::saturate>(state - inertia, saturated);
  }
};

/// Clocked twin.
template <class D>
class Dob {
 public:
  using Law = DobLaw<D, Fixed>;
  using Current = fixed_of<D::f.current.key()>;
  using Velocity = fixed_of<D::f.velocity.key()>;
  using TorqueConstant = fixed_of<D::P::torque_constant.key()>;
  using InertiaGain = fixed_of<D::P::inertia_gain.key()>;
  using A1 = fixed_of<D::P::observer_a1.key()>;

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

  /// A whole wave at once.
  void tick(bool armed, Current current, Velocity velocity, TorqueConstant ktn, InertiaGain gain,
            A1 a1) {
    drive_ = armed ? Law::drive(current * ktn) : typename Law::Drive{};
    inertia_ = Law::inertia(velocity * gain);
    input_ = Law::input(drive_, inertia_);
    const auto state = filter_.state();
    filter_.set_state(armed ? Law::Filter::next(state, Law::Filter::operand(input_, state) * a1)
                            : input_);
    observe();
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
