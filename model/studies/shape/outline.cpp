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

/// Keeps of `o` between first and last, both kept, what the line between them misses by more than
/// the tolerance (Douglas and Peucker, The Canadian Cartographer 10, 1973).
void keep(const Outline& o, std::size_t first, std::size_t last, std::vector<char>& kept) {
  std::size_t farthest = first;
  double most = kept_within_m;
  const Point from = o[first], way = o[last % o.size()] - from;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Point to = o[i] - from;
    const double share = dot(way, way) > 0 ? std::clamp(dot(to, way) / dot(way, way), 0.0, 1.0) : 0;
    const double away = length(to - way * share);
    if (away > most) {
      most = away;
      farthest = i;
    }
  }
  if (farthest == first) return;
  kept[farthest] = 1;
  keep(o, first, farthest, kept);
  keep(o, farthest, last, kept);
}

/// The necessary corners: without the others the outline moves by at most `kept_within_m`.
Outline simplified(const Outline& o) {
  // Two corners far from each other are corners for certain.
  const auto farthest_from = [&](Point p) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < o.size(); ++i) {
      if (length(o[i] - p) > length(o[best] - p)) best = i;
    }
    return best;
  };
  const std::size_t start = farthest_from(o.front());
  Outline turned(o.begin() + static_cast<std::ptrdiff_t>(start), o.end());
  turned.insert(turned.end(), o.begin(), o.begin() + static_cast<std::ptrdiff_t>(start));
  std::size_t middle = 0;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (length(turned[i] - turned[0]) > length(turned[middle] - turned[0])) middle = i;
  }
  std::vector<char> kept(turned.size(), 0);
  kept[0] = kept[middle] = 1;
  keep(turned, 0, middle, kept);
  keep(turned, middle, turned.size(), kept);
  Outline result;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (kept[i] != 0) result.push_back(turned[i]);
  }
  return result;
}

}  // namespace

double length(Point a) { return std::hypot(a.x, a.y); }

double doubled_area(const Outline& o) {
  double sum = 0;
  for (std::size_t i = 0; i < o.size(); ++i) sum += cross(o[i], o[(i + 1) % o.size()]);
  return sum;
}

bool crosses_itself(const Outline& o) {
  const std::size_t n = o.size();
  const auto left = [&](std::size_t i) { return std::min(o[i].x, o[(i + 1) % n].x); };
  const auto right = [&](std::size_t i) { return std::max(o[i].x, o[(i + 1) % n].x); };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    for (std::size_t l = k + 1; l < n && left(order[l]) <= right(i); ++l) {
      const std::size_t j = order[l];
      if ((i + 1) % n == j || (j + 1) % n == i) continue;
      if (meet(o[i], o[(i + 1) % n], o[j], o[(j + 1) % n])) return true;
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
  if (flat || std::fabs(doubled_area(o)) < 1e-6 * p.size_m * p.size_m) {
    throw std::invalid_argument("the path has no area; draw an outline around something");
  }
  o = simplified(o);
  if (doubled_area(o) < 0) std::reverse(o.begin(), o.end());
  for (const Point& q : o) {
    const double from_motors = length(q);
    if (q.y <= 0 || from_motors < p.nearest_m || from_motors > p.farthest_m) {
      throw std::invalid_argument(
          fmt::format("({:.0f}, {:.0f}) mm is out of the pen's reach, {:.0f} to {:.0f} mm from the "
                      "motors; choose a smaller --size or another --centre",
                      1e3 * q.x, 1e3 * q.y, 1e3 * p.nearest_m, 1e3 * p.farthest_m));
    }
  }
  return o;
}

}  // namespace feltgate::shape
