// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The shipped laws, a whole tick of them, in `fixed` against the same laws in SystemC's sc_fixed:
// every result of every tick of a random life; the first diverging tick and signal are named.
// FELTGATE_DEFECT=1..4 breaks the arithmetic. Documentation: docs/fixed-point.md
#include <string>

#include "bench/systemc_numbers.hpp"
#include "catch.hpp"
#include "chain_life.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "seeded_defect.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;

enum ArithmeticDefect {
  kTruncated = 1,        ///< half-up rounding drops its bit
  kWrapped = 2,          ///< what should saturate wraps
  kLimitedTooEarly = 3,  ///< the range is checked before rounding
  kNarrowStates = 4      ///< words of more than 36 bits, the observer's, lack their two top bits
};

/// `fixed` with a defect; 0 for the real one.
template <int Defect>
struct Defective : Fixed {
  template <int Key, Round R, Overflow O, class X>
  static fixed_of<Key> narrowed(X x, bool* saturated) {
    using To = fixed_of<Key>;
    constexpr bool saturates = O == Overflow::saturate;
    if constexpr (Defect == kTruncated && R == Round::half_up) {
      return narrow<To, Round::truncate, O>(x, saturated);
    } else if constexpr (Defect == kWrapped && saturates) {
      return narrow<To, R, Overflow::wrap>(x, saturated);
    } else if constexpr (Defect == kLimitedTooEarly && saturates) {
      using Limited = fixed<To::format.sign, To::format.integer, X::format.fraction>;
      return narrow<To, R, Overflow::wrap>(
          narrow<Limited, Round::truncate, Overflow::saturate>(x, saturated));
    } else if constexpr (Defect == kNarrowStates && To::width > 36) {
      using Short = fixed<To::format.sign, To::format.integer - 2, To::format.fraction>;
      return To::from_raw(narrow<Short, R, Overflow::wrap>(x, saturated).raw());
    } else {
      return narrow<To, R, O>(x, saturated);
    }
  }
};

template <class D, int Defect>
ChainComparison compare(std::uint64_t seed, long ticks) {
  Laws<D, Defective<Defect>> ours;
  Laws<D, SystemC> theirs;
  return compare_lives<D>(seed, ticks, ours, theirs);
}

template <class D>
ChainComparison compare_under_test(std::uint64_t seed, long ticks) {
  switch (seeded_defect()) {
    case kTruncated:
      return compare<D, kTruncated>(seed, ticks);
    case kWrapped:
      return compare<D, kWrapped>(seed, ticks);
    case kLimitedTooEarly:
      return compare<D, kLimitedTooEarly>(seed, ticks);
    case kNarrowStates:
      return compare<D, kNarrowStates>(seed, ticks);
    default:
      return compare<D, 0>(seed, ticks);
  }
}

void check(const ChainComparison& c, long ticks) {
  INFO("first divergence: " << c.first_divergence);
  CHECK(c.first_divergence.empty());
  CHECK(not_exercised(c, ticks).empty());
}

}  // namespace

TEST_CASE("the laws of lever have the same trajectory in fixed and in SystemC",
          "[fixed][systemc]") {
  constexpr long ticks = 150'000;
  check(compare_under_test<Lever>(61, ticks), ticks);
}

TEST_CASE("the laws of paper have the same trajectory in fixed and in SystemC",
          "[fixed][systemc]") {
  constexpr long ticks = 150'000;
  check(compare_under_test<Paper>(62, ticks), ticks);
}
