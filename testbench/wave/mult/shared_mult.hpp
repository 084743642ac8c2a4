// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The shared multiplier as a block under test sees it: its own products four clocks after their
// operands, products of random operands in every other clock, so that taking one a clock early or
// late shows. Documentation: docs/architecture.md
#pragma once

#include <cstdint>

#include "mult_twin.hpp"
#include "random.hpp"

namespace feltgate::test {

class SharedMult {
 public:
  explicit SharedMult(std::uint64_t seed) : random_(seed) {}

  /// On the product bus in this clock. Call it once per clock, before operands() or others().
  std::int64_t product() const { return mult_.out().product; }
  /// This clock belongs to the block under test.
  void operands(std::int64_t a, std::int64_t b) { mult_.clock({a, b}); }
  /// This clock belongs to another block.
  void others() {
    constexpr std::int64_t a = std::int64_t{1} << 34;
    constexpr std::int64_t b = std::int64_t{1} << 17;
    const auto upper = static_cast<std::int64_t>(random_.bits() % (2 * a));
    mult_.clock({upper - a, random_.between(-b, b - 1)});
  }

 private:
  Random random_;
  Mult mult_;
};

}  // namespace feltgate::test
