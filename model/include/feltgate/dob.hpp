// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/estimators/dob.sv: disturbance observer tau_hat = LPF(Ktn*I + g*Jn*w) - g*Jn*w.
// tau_hat is the load that opposes positive motor torque. While disarmed, the current counts as 0
// and the filter follows its input; so tau_hat is 0, and arming in motion causes no jump.
// Documentation: docs/blocks/dob.md
#pragma once

#include <cstdint>

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

  /// Ktn*I, truncated to the observer's last bit.
  template <class Product>
  static constexpr Drive drive(Product ktn_times_current) {
    return quantise<N, Drive, Round::truncate, Overflow::wrap>(ktn_times_current);
  }
  /// g*Jn*w, truncated. It enters and leaves the observer, so the truncated part cancels at rest.
  template <class Product>
  static constexpr Inertia inertia(Product gain_times_velocity) {
    return quantise<N, Inertia, Round::truncate, Overflow::wrap>(gain_times_velocity);
  }
  /// Input of the filter: exact.
  static constexpr State input(Drive drive, Inertia inertia) {
    return quantise<N, State, Round::truncate, Overflow::wrap>(drive + inertia);
  }
  /// tau_hat, rounded and saturated to the torque format; sets *saturated if it saturates.
  static constexpr Torque tau_hat(State state, Inertia inertia, bool* saturated) {
    return quantise<N, Torque, D::rounding, Overflow::saturate>(state - inertia, saturated);
  }
};

/// One tick of the disturbance observer.
template <class D, class N>
struct ObserverStep {
  typename DobLaw<D, N>::State state{};
  typename DobLaw<D, N>::Torque tau_hat{};
  bool limit = false;  ///< tau_hat saturated

  /// One tick; `current` is the current reference of the tick before.
  template <class W, class Current, class Velocity>
  void tick(const W& w, bool armed, Current current, Velocity velocity) {
    using Law = DobLaw<D, N>;
    const auto drive = armed ? Law::drive(current * w.torque_constant()) : typename Law::Drive{};
    const auto inertia = Law::inertia(velocity * w.inertia_gain());
    const auto input = Law::input(drive, inertia);
    constexpr int a1 = D::P::observer_a1.key();
    state = armed ? Law::Filter::template step<a1>(input, state, w.observer_a1()) : input;
    limit = false;
    tau_hat = Law::tau_hat(state, inertia, &limit);
  }
};

}  // namespace feltgate
