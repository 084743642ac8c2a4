// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads a grey image as heights. Documentation: docs/devices/shapes.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::texture {

/// Heights as shares of the depth, 0 (black) to 1 (white).
struct Image {
  int width = 0, height = 0;
  std::vector<double> share;  ///< row by row, the upper one first
  double at(int column, int row) const {
    return share[static_cast<std::size_t>(row * width + column)];
  }
};

/// Largest number of pixels along a side.
constexpr int most_side = 4096;

/// Reads a PNG with at most 8 bits per channel; colours become luminance, transparent pixels black.
/// Throws std::invalid_argument "file:1: what; mend" when the file is not a PNG, is truncated, has
/// 16 bits, is less than 2 pixels wide, or has a side above `most_side`.
Image read_png(const std::string& path);

}  // namespace feltgate::texture
