// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/estimators/lowpass.sv: one-pole low-pass y += round(a1 * (x - y)), with the
// design's rounding. With 0 <= a1 < 1 the new state lies between the old state and the input, so it
// cannot overflow. Documentation: docs/blocks/dob.md
#pragma once

#include <cstdint>

#include "feltgate/numbers.hpp"

namespace feltgate {

/// The arithmetic, in number policy N; formats as packed keys. R rounds the product.
template <class N, int StateKey, int OperandKey, Round R = Round::half_up>
struct LowpassLaw {
  using State = typename N::template num<StateKey>;
  using Operand = typename N::template num<OperandKey>;

  /// x - y as the multiplier takes it; where the operand is narrower, low bits are truncated.
  static constexpr Operand operand(State x, State y) {
    return quantise<N, Operand, Round::truncate, Overflow::wrap>(x - y);
  }

  /// The new state from the old one and a1 * operand.
  template <class Product>
  static constexpr State next(State y, Product a1_times_operand) {
    return quantise<N, State, R, Overflow::wrap>(y + a1_times_operand);
  }

  /// The new state from the input x. Where stays_between() holds, the sum cannot wrap and is not
  /// checked.
  template <int CoefficientKey, class A1>
  static constexpr State step(State x, State y, A1 a1) {
    if constexpr (stays_between(Format::from_key(CoefficientKey))) {
      return quantise<N, State, R, Overflow::never>(y + operand(x, y) * a1);
    } else {
      return next(y, operand(x, y) * a1);
    }
  }

  /// Whether every coefficient of this format keeps the new state between y and x. With 0 <= a1 < 1
  /// the exact sum lies there, and rounding to nearest cannot pass a number of the same grid. An
  /// operand that drops d bits is too small by less than 2^d, and the sum by less than a1 * 2^d; if
  /// that is below half a step, rounding removes it.
  static constexpr bool stays_between(Format a1) {
    constexpr Format state = Format::from_key(StateKey), operand = Format::from_key(OperandKey);
    constexpr Format difference = growth::difference(state, state);
    constexpr int given_up = difference.fraction - operand.fraction;
    constexpr bool nearest = R == Round::half_up || R == Round::convergent;
    const bool small = a1.sign == 0 && a1.integer <= (given_up > 0 ? -1 - given_up : 0);
    return nearest && small && given_up >= 0 && operand.integer >= difference.integer;
  }
};

}  // namespace feltgate
