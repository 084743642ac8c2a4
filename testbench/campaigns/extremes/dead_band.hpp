// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Closed form of the dead band of y += round(a*(x - y)), in state LSB.
// Documentation: docs/fixed-point.md
#pragma once

#include <cstdint>

#include "feltgate/fixed.hpp"

namespace feltgate::extremes {

struct Band {
  std::int64_t low;
  std::int64_t high;
};

/// The state rests at x-y = d when round(a*d) = 0, with a = numerator/2^fraction:
/// truncate 0 <= a*d < 1, half_up -1/2 <= a*d < 1/2, convergent |a*d| <= 1/2, toward_zero |a*d|
/// < 1. Returned is y-x.
inline Band dead_band(Round round, std::int64_t numerator, int fraction) {
  const std::int64_t one = std::int64_t{1} << fraction;
  const std::int64_t half_closed = one / 2 / numerator;  // largest d: a*d <= 1/2
  const std::int64_t half_open = (one / 2 + numerator - 1) / numerator - 1;  // a*d < 1/2
  const std::int64_t one_open = (one + numerator - 1) / numerator - 1;       // a*d < 1
  switch (round) {
    case Round::truncate:
      return {-one_open, 0};
    case Round::half_up:
      return {-half_open, half_closed};
    case Round::convergent:
      return {-half_closed, half_closed};
    case Round::toward_zero:
      return {-one_open, one_open};
  }
  return {0, 0};
}

}  // namespace feltgate::extremes
