// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Vectors in space, and rotations as unit quaternions. Documentation: docs/devices/three-axes.md
#pragma once

#include <array>
#include <cmath>

namespace feltgate::plant {

/// A vector; rad/s or Nm, depending on its use.
struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Product of the components: principal moments times a rate.
constexpr Vec3 scaled(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }

/// A rotation: w is the cosine of half its angle, (x, y, z) its axis times the sine of half its
/// angle.
struct Quaternion {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;

  /// A rotation by `rad` about an axis of length 1.
  static Quaternion about(Vec3 axis, double rad) {
    const double s = std::sin(0.5 * rad);
    return {std::cos(0.5 * rad), s * axis.x, s * axis.y, s * axis.z};
  }
  constexpr Vec3 vector() const { return {x, y, z}; }
  constexpr Quaternion inverse() const { return {w, -x, -y, -z}; }
  /// The vector `v`, rotated.
  constexpr Vec3 turn(Vec3 v) const {
    const Vec3 t = 2.0 * cross(vector(), v);
    return v + w * t + cross(vector(), t);
  }
};

/// First b, then a.
constexpr Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  const Vec3 v = a.w * b.vector() + b.w * a.vector() + cross(a.vector(), b.vector());
  return {a.w * b.w - dot(a.vector(), b.vector()), v.x, v.y, v.z};
}

/// Torque of a spring between two orientations, on the one that should become `to`; Nm, in the
/// frame in which both are given: 2*k*sgn(w)*(x, y, z) of the rotation between them. It acts along
/// the shorter way and is k times the angle for a small angle. Its energy is 4*k*(1 - |w|).
inline Vec3 coupling_nm(double stiffness_nm_rad, const Quaternion& to, const Quaternion& from) {
  const Quaternion between = to * from.inverse();
  return (between.w < 0.0 ? -2.0 : 2.0) * stiffness_nm_rad * between.vector();
}
inline double coupling_j(double stiffness_nm_rad, const Quaternion& to, const Quaternion& from) {
  return 4.0 * stiffness_nm_rad * (1.0 - std::abs((to * from.inverse()).w));
}

}  // namespace feltgate::plant
