// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Draws for stimuli from the seeded generator of the models. Documentation: docs/testing.md
#pragma once

#include <cstdint>

#include "feltgate/random.hpp"

namespace feltgate::test {

class Random : public SplitMix64 {
 public:
  explicit constexpr Random(std::uint64_t seed) : SplitMix64(seed * 0x9e3779b97f4a7c15U + 1U) {}

  /// Uniform in [0, n), n in [1, 2^32]; the bias of n/2^32 does not matter to a stimulus.
  constexpr std::uint32_t below(std::uint64_t n) {
    return static_cast<std::uint32_t>(((bits() >> 32) * n) >> 32);
  }
  /// Uniform in [low, high], both included; the range spans less than 2^32.
  constexpr std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low + 1)));
  }
  /// True once in n draws on average.
  constexpr bool one_in(std::uint64_t n) { return below(n) == 0; }
  /// One element of a list.
  template <class List>
  const typename List::value_type& pick(const List& list) {
    return list[below(list.size())];
  }
  constexpr bool coin() { return (bits() >> 63) != 0; }
};

}  // namespace feltgate::test
