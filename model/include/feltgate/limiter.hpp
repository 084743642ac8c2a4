// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/limiter.sv: the core's one limiter. Documentation: docs/blocks/limiter.md
#pragma once

#include <cstdint>
#include <type_traits>

#include "feltgate/format.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// In number policy N, for design D. It reads a limit as so many low bits of its word, at the
/// binary point of what is limited.
template <class D, class N>
struct LimiterLaw {
  /// Format of a limit whose signal has `Fraction` fraction bits.
  template <int Fraction>
  static constexpr int key = Format{1, D::f.limiter.width() - 1 - Fraction, Fraction}.key();

  /// x in [-limit, limit] as a To, which holds it; sets *hit to whether x lay outside. A negative
  /// limit counts as 0; so does one that the format PortKey of the signal does not hold, and all
  /// lies outside.
  template <class To, int PortKey = D::f.limiter.key(), class X, class Limit>
  static constexpr To limited(X x, Limit limit, bool* hit) {
    if (misfit<PortKey>(limit)) {
      *hit = true;
      return To{};
    }
    *hit = beyond<N>(x, limit);
    if constexpr (!std::is_same_v<N, FixedLanes>) {  // most ticks; beyond a negative limit is all
      if (!*hit) return quantise<N, To, Round::truncate, Overflow::wrap>(x);
    }
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
