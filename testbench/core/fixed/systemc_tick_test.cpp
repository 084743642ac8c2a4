// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The shipped laws, a whole tick of them, in `fixed` against the same laws in SystemC's sc_fixed:
// every result of every tick of a random life; the first diverging tick and signal are named.
// Documentation: docs/fixed-point.md
#include <string>

#include "catch.hpp"
#include "chain_life.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "studies/bench/systemc_numbers.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;

template <class D>
ChainComparison compare(std::uint64_t seed, long ticks) {
  Laws<D, Fixed> ours;
  Laws<D, SystemC> theirs;
  return compare_lives<D>(seed, ticks, ours, theirs);
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
  check(compare<Lever>(61, ticks), ticks);
}

TEST_CASE("the laws of paper have the same trajectory in fixed and in SystemC",
          "[fixed][systemc]") {
  constexpr long ticks = 150'000;
  check(compare<Paper>(62, ticks), ticks);
}
