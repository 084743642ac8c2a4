// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/estimators/velocity_mt.sv: M/T velocity over whole encoder cycles, counts between
// two edges over the clocks between them. Documentation: docs/blocks/velocity_mt.md
#pragma once

#include <cstdint>

#include "feltgate/numbers.hpp"

namespace feltgate {

/// What a span of clocks is as a velocity, in number policy N, for design D with `counts` in a
/// turn.
template <class D, class N>
struct SpanLaw {
  static constexpr Format format = D::f.velocity;
  using Velocity = typename N::template num<format.key()>;
  static constexpr std::int64_t largest = (std::int64_t{1} << (format.width() - 1)) - 1;

  /// rad/s of half a count in a clock, times 2^F, truncated.
  static constexpr std::int64_t half(int counts) {
    constexpr int128_t pi = 0x6487ed5110b4611a;  // 2^61
    return static_cast<std::int64_t>(
        ((pi * static_cast<int128_t>(D::clock_hz)) << format.fraction) /
        (static_cast<int128_t>(counts) << 61));
  }

  /// |velocity| of `halves` half counts in `clocks`; truncated and limited in fixed point, exact in
  /// real arithmetic. Precondition: clocks is not 0.
  static constexpr Velocity magnitude(int counts, int halves, std::int64_t clocks, bool* limited) {
    if constexpr (N::is_fixed) {
      const std::int64_t whole = half(counts) * halves / clocks;
      *limited = whole > largest;
      return N::template from_raw<format.key()>(*limited ? largest : whole);
    } else {
      (void)limited;
      const auto pi = static_cast<Velocity>(3.14159265358979323846264338327950288L);
      return pi * static_cast<Velocity>(halves) * static_cast<Velocity>(D::clock_hz) /
             (static_cast<Velocity>(counts) * static_cast<Velocity>(clocks));
    }
  }
};

}  // namespace feltgate
