// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The outline of a shape as an SVG file has it, brought into the reach of the pantograph.
// Documentation: docs/devices/shapes.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::shape {

struct Point {
  double x = 0, y = 0;  ///< m; of an outline that was just read in the file's units, y upward
};

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(Point a, double f) { return {a.x * f, a.y * f}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double length(Point a);

/// Corners in order; the last one is joined with the first.
using Outline = std::vector<Point>;

/// Most corners and curves of the path that is read; a curve becomes `curve_steps` corners.
constexpr int most_commands = 2000, curve_steps = 24;

/// The one closed outline of an SVG file: paths, rectangles, circles, ellipses, polygons, with
/// their transforms. Throws std::invalid_argument "file:line: what; mend" for a file without one,
/// with several, with one that is open or has more than `most_commands` parts, or that is broken.
Outline read_svg(const std::string& path);

/// Reach of the pantograph's pen, from its motors.
constexpr double nearest_pen_m = 0.04, farthest_pen_m = 0.19;

struct Placing {
  double size_m = 0.06;              ///< larger side of what surrounds it
  Point centre_m = {0.0, 0.12};      ///< middle of what surrounds it
  double nearest_m = nearest_pen_m;  ///< reach of the pen around the motors
  double farthest_m = farthest_pen_m;
};

/// Scaled and placed, counter-clockwise, without edges shorter than 1 um and corners that the
/// outline does without within 0.1 mm. Throws std::invalid_argument "what; mend" where it crosses
/// itself, has no area or is out of reach.
Outline placed(const Outline& outline, const Placing& placing);

/// Twice the area: positive where the outline runs counter-clockwise.
double doubled_area(const Outline& outline);

/// Whether two edges that are no neighbours meet.
bool crosses_itself(const Outline& outline);

}  // namespace feltgate::shape
