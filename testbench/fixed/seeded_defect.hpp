// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Seeded defects of the fixed-point tests: FELTGATE_DEFECT=N in the environment breaks the thing
// under test in a classic way, and the test must then fail. Unset or 0 tests the real code.
// Documentation: docs/fixed-point.md
#pragma once

#include <cstdlib>

#include "feltgate/fixed.hpp"

namespace feltgate::test {

/// The defect asked for by the environment, 0 for none. Read once.
inline int seeded_defect() {
  static const int defect = [] {
    const char* text = std::getenv("FELTGATE_DEFECT");
    return text == nullptr ? 0 : std::atoi(text);
  }();
  return defect;
}

/// Defects of narrow() that real libraries have had.
enum NarrowDefect {
  kSaturateThenRound = 1,    ///< the range is checked before rounding, which then overflows
  kConvergentNegatives = 2,  ///< negative ties are rounded half-up instead of to even
  kHalfAwayFromZero = 3,     ///< half-up mirrored for negative numbers
  kSymmetricSaturation = 4,  ///< the lowest value is unreachable
  kFloorForTowardZero = 5    ///< magnitude truncation forgets the negative numbers
};

/// narrow(), or narrow() with the seeded defect.
template <class To, Round R, Overflow O, int S, int I, int F>
To narrow_under_test(fixed<S, I, F> x, bool* saturated = nullptr) {
  const bool negative = x.raw() < 0;
  const int defect = seeded_defect();
  if constexpr (O == Overflow::saturate) {
    if (defect == kSaturateThenRound) {
      bool outside = false;
      narrow<To, Round::truncate, O>(x, &outside);
      if (!outside) return narrow<To, R, Overflow::wrap>(x);
    }
    if (defect == kSymmetricSaturation && To::format.sign == 1 && To::width > 1) {
      const To y = narrow<To, R, O>(x, saturated);
      return y == To::min() ? To::from_raw(To::min_raw() + 1) : y;
    }
  }
  if constexpr (R == Round::convergent) {
    if (defect == kConvergentNegatives && negative) return narrow<To, Round::half_up, O>(x);
  }
  if constexpr (R == Round::half_up) {
    // One source bit lower turns a tie into "just below the tie" and changes nothing else.
    const bool room = x.raw() > x.min_raw() && F > To::format.fraction;
    if (defect == kHalfAwayFromZero && negative && room) {
      return narrow<To, R, O>(fixed<S, I, F>::from_raw(x.raw() - 1), saturated);
    }
  }
  if constexpr (R == Round::toward_zero) {
    if (defect == kFloorForTowardZero) return narrow<To, Round::truncate, O>(x, saturated);
  }
  return narrow<To, R, O>(x, saturated);
}

}  // namespace feltgate::test
