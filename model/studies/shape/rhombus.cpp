// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/pantograph.md
#include "studies/shape/rhombus.hpp"

#include <algorithm>
#include <cmath>

namespace feltgate::shape {

std::array<double, 2> cranks(Point p) {
  const double middle = std::atan2(p.y, p.x);
  const double half = std::acos(std::min(1.0, std::hypot(p.x, p.y) / (2 * link_m)));
  return {middle - half, middle + half};
}

Point force_at(Point p, const std::array<double, 2>& torque) {
  const auto [a, b] = cranks(p);
  // torque = L (c F_y - s F_x) for each crank, solved for F.
  const double c1 = std::cos(a), s1 = std::sin(a), c5 = std::cos(b), s5 = std::sin(b);
  const double determinant = link_m * (c1 * s5 - s1 * c5);
  return {(c5 * torque[0] - c1 * torque[1]) / determinant,
          (s5 * torque[0] - s1 * torque[1]) / determinant};
}

std::array<double, 2> crank_speeds(Point p, Point v) {
  const auto [a, b] = cranks(p);
  // v = L w_1 (-s_1, c_1) + L w_5 (-s_5, c_5), solved for the speeds.
  const double c1 = std::cos(a), s1 = std::sin(a), c5 = std::cos(b), s5 = std::sin(b);
  const double determinant = link_m * (c1 * s5 - s1 * c5);
  return {(c5 * v.x + s5 * v.y) / determinant, -(c1 * v.x + s1 * v.y) / determinant};
}

}  // namespace feltgate::shape
