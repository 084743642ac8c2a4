// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/actuation/limiter.sv, the only limiter of the core. Documentation:
// docs/blocks/torque_control.md
#pragma once

#include <cstdint>

#include "feltgate/format.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// In number policy N, for design D. The limiter reads a limit from the low bits of its word, with
/// the binary point of the limited signal.
template <class D, class N>
struct LimiterLaw {
  /// Format of a limit for a signal with `Fraction` fraction bits.
  template <int Fraction>
  static constexpr int key = Format{1, D::f.limiter.width() - 1 - Fraction, Fraction}.key();

  /// x limited to [-limit, limit], as type To, which must hold it; sets *hit to whether x was
  /// outside. A negative limit counts as 0. A limit that does not fit the signal's format PortKey
  /// also counts as 0, and then *hit is always true.
  template <class To, int PortKey = D::f.limiter.key(), class X, class Limit>
  static constexpr To limited(X x, Limit limit, bool* hit) {
    if (misfit<PortKey>(limit)) {
      *hit = true;
      return To{};
    }
    *hit = beyond(x, limit);
    // The common case; with a negative limit *hit is always true.
    if (!*hit) return quantise<N, To, Round::truncate, Overflow::wrap>(x);
    if (limit < Limit{}) limit = Limit{};
    if (x > limit) return quantise<N, To, Round::truncate, Overflow::wrap>(limit);
    if (x < -limit) return quantise<N, To, Round::truncate, Overflow::wrap>(-limit);
    return quantise<N, To, Round::truncate, Overflow::wrap>(x);
  }

 private:
  template <int PortKey, class Limit>
  static constexpr bool misfit([[maybe_unused]] Limit limit) {
    if constexpr (N::is_fixed) {
      return N::raw(limit) >= std::int64_t{1} << (Format::from_key(PortKey).width() - 1);
    } else {
      return false;
    }
  }
};

}  // namespace feltgate
