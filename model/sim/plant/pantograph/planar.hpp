// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Vectors in the plane, and pairs of joint values. Documentation: docs/pantograph.md
#pragma once

#include <array>
#include <cmath>

namespace feltgate::plant {

/// A point, speed or force in the plane: m, m/s or N, depending on its use.
struct Vec2 {
  double x = 0.0, y = 0.0;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vec2 a) { return std::sqrt(dot(a, a)); }

/// One value per driven joint, in the order theta1, theta5: rad, rad/s or Nm.
using Joints = std::array<double, 2>;

constexpr double dot(const Joints& a, const Joints& b) { return a[0] * b[0] + a[1] * b[1]; }

/// A symmetric 2x2 matrix over the joints.
struct JointMatrix {
  double m11 = 0.0, m15 = 0.0, m55 = 0.0;

  constexpr Joints times(const Joints& v) const {
    return {m11 * v[0] + m15 * v[1], m15 * v[0] + m55 * v[1]};
  }
  /// The inverse of the matrix times `v`; the determinant must not be 0.
  constexpr Joints solve(const Joints& v) const {
    const double per = 1.0 / (m11 * m55 - m15 * m15);
    return {per * (m55 * v[0] - m15 * v[1]), per * (m11 * v[1] - m15 * v[0])};
  }
};

}  // namespace feltgate::plant
