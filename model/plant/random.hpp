// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// SplitMix64 (Steele, Lea, Flood 2014) for draws that belong to a model: the same numbers with
// every compiler and library. Documentation: docs/plant.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace feltgate::plant {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// 64 uniform bits.
  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
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

}  // namespace feltgate::plant
