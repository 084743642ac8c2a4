// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/shape/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace feltgate::shape {

namespace {

constexpr double shortest_m = 1e-6, kept_within_m = 0.1e-3;
/// Reach of the pantograph's pen: distances from its motors.
constexpr double nearest_m = 0.04, farthest_m = 0.19;

/// Whether a-b and c-d have a point in common; touching counts.
bool meet(Point a, Point b, Point c, Point d) {
  const auto side = [](Point p, Point q, Point r) { return cross(q - p, r - p); };
  const double s1 = side(a, b, c), s2 = side(a, b, d), s3 = side(c, d, a), s4 = side(c, d, b);
  if (((s1 > 0) != (s2 > 0)) && ((s3 > 0) != (s4 > 0)) && s1 != 0 && s2 != 0) return true;
  const auto on = [](Point p, Point q, Point r, double s) {
    return s == 0 && dot(r - p, r - q) <= 0;
  };
  return on(a, b, c, s1) || on(a, b, d, s2) || on(c, d, a, s3) || on(c, d, b, s4);
}

Outline::const_iterator farthest(const Outline& o, Point from) {
  return std::max_element(o.begin(), o.end(),
                          [&](Point a, Point b) { return length(a - from) < length(b - from); });
}

/// Adds to `kept` the corner at `first`, and those behind it up to `last` that the line between
/// both misses by more than the tolerance (Douglas and Peucker, The Canadian Cartographer 10,
/// 1973).
void keep(const Outline& o, std::size_t first, std::size_t last, Outline* kept) {
  const Point way = o[last] - o[first];
  const auto away = [&](std::size_t i) {
    const Point to = o[i] - o[first];
    const double share = dot(way, way) > 0 ? std::clamp(dot(to, way) / dot(way, way), 0.0, 1.0) : 0;
    return length(to - way * share);
  };
  std::size_t most = first;
  for (std::size_t i = first + 1; i < last; ++i) most = away(i) > away(most) ? i : most;
  if (away(most) <= kept_within_m) return kept->push_back(o[first]);
  keep(o, first, most, kept);
  keep(o, most, last, kept);
}

/// The necessary corners: without the others the outline moves by at most `kept_within_m`.
Outline simplified(Outline o) {
  // Two corners far from each other are corners for certain.
  std::rotate(o.begin(), o.begin() + (farthest(o, o.front()) - o.cbegin()), o.end());
  const auto middle = static_cast<std::size_t>(farthest(o, o.front()) - o.cbegin());
  o.push_back(o.front());
  Outline kept;
  keep(o, 0, middle, &kept);
  keep(o, middle, o.size() - 1, &kept);
  return kept;
}

}  // namespace

double length(Point a) { return std::hypot(a.x, a.y); }

double area(const Outline& o) {
  double sum = 0;
  for (std::size_t i = 0; i < o.size(); ++i) sum += cross(o[i], o[(i + 1) % o.size()]) / 2;
  return sum;
}

bool crosses_itself(const Outline& o) {
  const std::size_t n = o.size();
  const auto end = [&](std::size_t i) { return o[(i + 1) % n]; };
  std::vector<std::size_t> edges(n);  // by their left ends
  std::iota(edges.begin(), edges.end(), std::size_t{0});
  const auto left = [&](std::size_t i) { return std::min(o[i].x, end(i).x); };
  std::sort(edges.begin(), edges.end(),
            [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
  for (auto e = edges.begin(); e != edges.end(); ++e) {
    const double right = std::max(o[*e].x, end(*e).x);
    for (auto f = e + 1; f != edges.end() && left(*f) <= right; ++f) {
      const bool neighbours = (*e + 1) % n == *f || (*f + 1) % n == *e;
      if (!neighbours && meet(o[*e], end(*e), o[*f], end(*f))) return true;
    }
  }
  return false;
}

Outline placed(const Outline& given, const Placing& p) {
  Point low = given.front(), high = given.front();
  for (const Point& q : given) {
    low = {std::min(low.x, q.x), std::min(low.y, q.y)};
    high = {std::max(high.x, q.x), std::max(high.y, q.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  if (!(side > 0) || !std::isfinite(side)) {
    throw std::invalid_argument("the path is a point; draw a closed outline");
  }
  const double scale = p.size_m / side;
  const Point middle = (low + high) * 0.5;
  Outline o;
  for (const Point& q : given) {
    const Point at = (q - middle) * scale + p.centre_m;
    if (o.empty() || length(at - o.back()) > shortest_m) o.push_back(at);
  }
  while (o.size() > 1 && length(o.back() - o.front()) <= shortest_m) o.pop_back();
  const bool flat = o.size() < 3 || std::min(high.x - low.x, high.y - low.y) < 1e-6 * side;
  if (!flat && crosses_itself(o)) {
    throw std::invalid_argument(
        "the path crosses or touches itself; unite it in a drawing program");
  }
  if (flat || std::fabs(area(o)) < 5e-7 * p.size_m * p.size_m) {
    throw std::invalid_argument("the path has no area; draw an outline around something");
  }
  o = simplified(o);
  if (area(o) < 0) std::reverse(o.begin(), o.end());
  for (const Point& q : o) {
    const double from_motors = length(q);
    if (q.y <= 0 || from_motors < nearest_m || from_motors > farthest_m) {
      throw std::invalid_argument(
          fmt::format("({:.0f}, {:.0f}) mm is out of the pen's reach, {:.0f} to {:.0f} mm from the "
                      "motors; choose a smaller --size or another --centre",
                      1e3 * q.x, 1e3 * q.y, 1e3 * nearest_m, 1e3 * farthest_m));
    }
  }
  return o;
}

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
