// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Textures for tests. Documentation: docs/devices/shapes.md
#pragma once

#include <cmath>
#include <vector>

#include "law/compile.hpp"
#include "studies/texture/texture_force.hpp"
#include "studies/texture/texture_law.hpp"

namespace feltgate::texture {

constexpr double pi = 3.14159265358979323846;

/// A sine between 0 and 1, `per_period` pixels a period.
inline std::vector<double> sine(int per_period, int count) {
  std::vector<double> row;
  for (int i = 0; i < count; ++i) row.push_back(0.5 + 0.5 * std::sin(2 * pi * i / per_period));
  return row;
}

}  // namespace feltgate::texture
