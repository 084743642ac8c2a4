// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A grey image as heights. Documentation: docs/devices/texture.md
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

/// Most pixels along a side that are read.
constexpr int most_side = 4096;

/// Reads a PNG of 8 bits a channel or less; colours become their luminance, what is transparent
/// black. Throws std::invalid_argument "file:1: what; mend" for what is no PNG, is broken off, has
/// 16 bits, less than 2 pixels across, or sides above `most_side`.
Image read_png(const std::string& path);

}  // namespace feltgate::texture
