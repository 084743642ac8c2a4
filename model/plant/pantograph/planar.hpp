// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Vectors of the plane and pairs of joints. Documentation: docs/pantograph.md
#pragma once

#include <array>
#include <cmath>

namespace feltgate::plant {

/// A point, speed or force of the plane: m, m/s, N by its use.
struct Vec2 {
  double x = 0.0, y = 0.0;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vec2 a) { return std::sqrt(dot(a, a)); }

/// One number for each of both driven joints, theta1 and theta5 in this order: rad, rad/s, Nm.
using Joints = std::array<double, 2>;

constexpr double dot(const Joints& a, const Joints& b) { return a[0] * b[0] + a[1] * b[1]; }

/// A symmetric matrix of the joints.
struct JointMatrix {
  double m11 = 0.0, m15 = 0.0, m55 = 0.0;

  constexpr Joints times(const Joints& v) const {
    return {m11 * v[0] + m15 * v[1], m15 * v[0] + m55 * v[1]};
  }
  /// Its inverse times `v`. The determinant must not be 0.
  constexpr Joints solve(const Joints& v) const {
    const double per = 1.0 / (m11 * m55 - m15 * m15);
    return {per * (m55 * v[0] - m15 * v[1]), per * (m11 * v[1] - m15 * v[0])};
  }
};

}  // namespace feltgate::plant
