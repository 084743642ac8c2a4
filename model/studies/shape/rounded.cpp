// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/shape/rounded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace feltgate::shape {

Point direction(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }

Point direction(const Piece& p, double s) {
  return direction(p.heading_rad + s * p.curvature_per_m);
}

Point place(const Piece& p, double s) {
  if (p.curvature_per_m == 0) return p.from + direction(p.heading_rad) * s;
  const double r = 1 / p.curvature_per_m, turned = p.heading_rad + s * p.curvature_per_m;
  return {p.from.x + r * (std::sin(turned) - std::sin(p.heading_rad)),
          p.from.y - r * (std::cos(turned) - std::cos(p.heading_rad))};
}

Curve rounded(const Outline& o, double radius_m) {
  const std::size_t n = o.size();
  std::vector<double> turn(n), tangent(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point in = o[i] - o[(i + n - 1) % n], out = o[(i + 1) % n] - o[i];
    turn[i] = std::atan2(cross(in, out), dot(in, out));
    tangent[i] = radius_m * std::tan(std::fabs(turn[i]) / 2);
  }
  Curve c;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (i + 1) % n;
    const Point edge = o[k] - o[i];
    const double left = length(edge) - tangent[i] - tangent[k];
    if (left < 0) {
      throw std::invalid_argument(fmt::format(
          "the edge of {:.2f} mm at ({:.1f}, {:.1f}) mm is too short for a radius of {:.2f} mm, "
          "which takes {:.2f} mm of it; choose a smaller --radius, or a larger --size",
          1e3 * length(edge), 1e3 * o[i].x, 1e3 * o[i].y, 1e3 * radius_m,
          1e3 * (tangent[i] + tangent[k])));
    }
    const double to = std::atan2(edge.y, edge.x);
    const Point start = o[i] + edge * (tangent[i] / length(edge));
    if (left > 0) c.pieces.push_back({start, to, left, 0});
    if (turn[k] != 0 && radius_m > 0) {
      const Point corner = o[k] - edge * (tangent[k] / length(edge));
      c.pieces.push_back(
          {corner, to, radius_m * std::fabs(turn[k]), std::copysign(1 / radius_m, turn[k])});
    }
  }
  for (const Piece& p : c.pieces) c.length_m += p.length_m;
  return c;
}

Polygon sampled(const Curve& curve, int vertices) {
  double turning = 0;
  for (const Piece& p : curve.pieces) turning += p.length_m * std::fabs(p.curvature_per_m);
  // A vertex is due whenever this has grown by 1 / vertices.
  const auto weight = [&](const Piece& p) {
    const double bent = turning > 0 ? p.length_m * std::fabs(p.curvature_per_m) / turning
                                    : p.length_m / curve.length_m;
    return 0.5 * p.length_m / curve.length_m + 0.5 * bent;
  };
  Polygon polygon;
  double before = 0;
  std::size_t piece = 0;
  for (int i = 0; i < vertices; ++i) {
    const double due = static_cast<double>(i) / vertices;
    while (piece + 1 < curve.pieces.size() && before + weight(curve.pieces[piece]) <= due) {
      before += weight(curve.pieces[piece++]);
    }
    const Piece& p = curve.pieces[piece];
    const double s = p.length_m * std::min(1.0, (due - before) / weight(p));
    polygon.at.push_back(place(p, s));
    polygon.along.push_back(direction(p, s));
  }
  return polygon;
}

}  // namespace feltgate::shape
