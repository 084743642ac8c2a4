// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads the outline of a shape from an SVG file and places it in the reach of the pantograph.
// Documentation: docs/devices/shapes.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::shape {

struct Point {
  double x = 0, y = 0;  ///< m, y upward; directly after reading, in the file's units
};

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(Point a, double f) { return {a.x * f, a.y * f}; }
inline Point operator*(double f, Point a) { return a * f; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double length(Point a);

/// Corners in order; the last corner is connected to the first.
using Outline = std::vector<Point>;

/// Largest number of corners and curves of a path; a curve becomes `curve_steps` corners.
constexpr int most_commands = 2000, curve_steps = 24;

/// Reads the single closed outline of an SVG file: paths, rectangles, circles, ellipses, polygons,
/// with their transforms. Throws std::invalid_argument "file:line: what; mend" for a broken file,
/// for no outline or several, and for one that is open or has more than `most_commands` parts.
Outline read_svg(const std::string& path);

struct Placing {
  double size_m = 0.06;          ///< larger side of its bounding box
  Point centre_m = {0.0, 0.12};  ///< centre of its bounding box
};

/// The outline, scaled and placed, counter-clockwise. Edges shorter than 1 um are removed, and so
/// are corners whose removal moves the outline by at most 0.1 mm. Throws std::invalid_argument
/// "what; mend" when it crosses itself, has no area or is out of reach.
Outline placed(const Outline& outline, const Placing& placing);

/// Positive for a counter-clockwise outline.
double area(const Outline& outline);

/// Whether two edges that are not neighbours meet; touching counts.
bool crosses_itself(const Outline& outline);

// A smooth closed curve of lines and arcs, and the vertices that a law walks along.

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
