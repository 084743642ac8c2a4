// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A smooth closed curve of lines and arcs, and the vertices that a law walks along.
// Documentation: docs/devices/shapes.md
#pragma once

#include "studies/shape/outline.hpp"

namespace feltgate::shape {

/// A line (curvature 0) or an arc.
struct Piece {
  Point from;
  double heading_rad = 0;  ///< of its start
  double length_m = 0;
  double curvature_per_m = 0;  ///< positive where it turns left, as around a convex corner
};

/// A unit vector.
Point direction(double heading_rad);
/// The place and the direction at a distance s from the piece's start.
Point place(const Piece& piece, double s);
Point direction(const Piece& piece, double s);

/// A closed curve, counter-clockwise, without kinks.
struct Curve {
  std::vector<Piece> pieces;
  double length_m = 0;
};

/// Every corner becomes an arc of this radius. Throws std::invalid_argument "what; mend" where an
/// edge is too short for the arcs at its ends.
Curve rounded(const Outline& outline, double radius_m);

/// Vertices, and at each the direction of the curve, a unit vector.
struct Polygon {
  std::vector<Point> at, along;
};

/// Vertices on the curve, one half at equal distances along it and one half by how much it turns.
Polygon sampled(const Curve& curve, int vertices);

}  // namespace feltgate::shape
