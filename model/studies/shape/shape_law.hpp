// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A polygon as a law file for the pantograph: a proxy walks along the outline, with its direction
// interpolated between vertices, and a pen inside is pushed to it.
// Documentation: docs/devices/shapes.md
#pragma once

#include <string>
#include <vector>

#include "studies/shape/rounded.hpp"

namespace feltgate::shape {

struct LawRequest {
  std::string summary;  ///< first line of the file
  double stiffness_n_per_m = 50, damping_ns_per_m = 0;
  bool texture = false;  ///< of one shape: parameters ripple, m, and ripples around the outline
};

/// Largest values that the law's parameters take, and fewest and most vertices.
constexpr double most_stiffness_n_per_m = 200, most_damping_ns_per_m = 0.2;
constexpr int fewest_vertices = 8, most_vertices = 100;
constexpr int most_measured_vertices = 80;  ///< of a law that knows the way along the outline

/// Shapes that a law holds at once; words of table memory for each, in each of two tables, and most
/// of them together.
constexpr int most_shapes = 7, most_resident_words = 214;
constexpr std::size_t resident_words(int vertices) {
  return static_cast<std::size_t>(vertices) + 3;
}

/// The text of the law (docs/laws.md), lines of at most 100 columns.
std::string law_text(const Polygon& polygon, const LawRequest& request);

/// A law with several shapes of as many vertices each, of which the parameter `shape` chooses,
/// without texture. They fit where their words are at most `most_resident_words`.
std::string law_text(const std::vector<Polygon>& shapes, const LawRequest& request);

}  // namespace feltgate::shape
