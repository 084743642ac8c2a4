// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// SplitMix64 (Steele, Lea, Flood 2014), a random generator: a seed gives the same numbers with
// every compiler and library. A draw is one chain of multiplications; the generator can be copied.
// Documentation: docs/plant.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fixed.hpp"

namespace feltgate {

/// The generator.
class SplitMix64 {
 public:
  explicit constexpr SplitMix64(std::uint64_t seed) : state_(seed) {}

  /// 64 uniform bits.
  constexpr std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  /// Uniform from 0 to n-1, n >= 1; the bias is below n / 2^64.
  constexpr std::int64_t below(std::int64_t n) {
    const auto high = static_cast<std::int64_t>(bits() >> 1);
    return static_cast<std::int64_t>((static_cast<int128_t>(high) * n) >> 63);
  }
  /// Uniform in (0, 1).
  double uniform() { return (static_cast<double>(bits() >> 11) + 0.5) * 0x1p-53; }
  /// Uniform in (low, high).
  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal by Box-Muller, cut at 4 sigma so that an encoder's edges keep their order.
  double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return std::clamp(radius * std::cos(6.283185307179586476925286766559 * uniform()), -4.0, 4.0);
  }

 private:
  std::uint64_t state_;
};

}  // namespace feltgate
