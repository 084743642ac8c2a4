// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes an image as a law file: a field of heights for a pen on three Cartesian axes.
// Documentation: docs/devices/shapes.md
#pragma once

#include <string>

#include "studies/texture/image.hpp"

namespace feltgate::texture {

enum class Normals {
  interpolated,  ///< interpolated between the pixels' normals: force shading
  facets,        ///< normals of the line, or triangle, between pixels
};

struct LawRequest {
  std::string summary;  ///< first line of the file
  double texel_m = 1e-3, depth_m = 2e-3;
  double stiffness_n_per_m = 500, damping_ns_per_m = 0;
  Normals normals = Normals::interpolated;
};

/// Pixels along a side.
constexpr int most_field = 16;
/// Largest slope of a texture, depth, depth that the pen is felt in, and values of parameters.
constexpr double most_slope = 2, most_depth_m = 10e-3, most_pen_m = 20e-3;
constexpr double most_stiffness_n_per_m = 1000, most_damping_ns_per_m = 2;
/// Radius of the capstans that convert an angle to a distance.
constexpr double capstan_m = 10e-3;

/// The text of the law (docs/laws.md), lines of at most 100 columns. Throws std::invalid_argument
/// "what; mend" for too many pixels, all alike, or too steep.
std::string field_law(const Image& field, const LawRequest& request);

}  // namespace feltgate::texture
