// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A polygon as a law file for the pantograph: a proxy walks along the outline, with its direction
// interpolated between vertices, and a pen inside is pushed to it.
// Documentation: docs/devices/shapes.md
#pragma once

#include <string>

#include "studies/shape/outline.hpp"

namespace feltgate::shape {

struct LawRequest {
  std::string summary;  ///< first line of the file
  double stiffness_n_per_m = 50, damping_ns_per_m = 0;
};

/// Largest values that the law's parameters take, and fewest and most vertices.
constexpr double most_stiffness_n_per_m = 200, most_damping_ns_per_m = 0.2;
constexpr int fewest_vertices = 8, most_vertices = 100;

/// The text of the law (docs/laws.md), lines of at most 100 columns.
std::string law_text(const Polygon& polygon, const LawRequest& request);

}  // namespace feltgate::shape
