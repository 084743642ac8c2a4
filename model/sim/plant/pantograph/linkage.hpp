// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Geometry of a five-bar linkage: two motors drive the cranks, and the pen is where two circles
// meet. It shares no code with the laws that a core evaluates. Derivation:
// docs/devices/pantograph.md
#pragma once

#include <array>
#include <cmath>
#include <optional>

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

/// Lengths in m. Motor 1 is at (0, 0), motor 5 at (-base_m, 0); elbow 1 belongs to motor 1.
struct LinkageGeometry {
  double base_m = 0.0;     ///< a5, between the motors; 0: both at one point
  double crank_1_m = 0.0;  ///< a1, motor 1 to elbow 1
  double rod_1_m = 0.0;    ///< a2, elbow 1 to pen
  double rod_5_m = 0.0;    ///< a3, elbow 5 to pen
  double crank_5_m = 0.0;  ///< a4, motor 5 to elbow 5
};

/// Positions for one pair of angles, and their derivatives by the angles (m/rad, rad/rad).
struct LinkagePose {
  Vec2 elbow_1, elbow_5, pen;
  Vec2 rod_1, rod_5;                    ///< from the elbow to the pen
  Vec2 elbow_1_by_1, elbow_5_by_5;      ///< an elbow follows its own motor only
  Vec2 pen_by_1, pen_by_5;              ///< columns of the Jacobian
  Joints rod_1_by = {}, rod_5_by = {};  ///< angles of the rods, by theta1 and theta5
  double rods_cross_m2 = 0.0;           ///< rod_1 x rod_5; 0 if the linkage is straight

  Vec2 pen_speed(const Joints& omega) const { return omega[0] * pen_by_1 + omega[1] * pen_by_5; }
  /// Joint torques equivalent to a force at the pen, Nm: the transposed Jacobian times the force.
  Joints torque(Vec2 force_n) const { return {dot(pen_by_1, force_n), dot(pen_by_5, force_n)}; }
  /// Force at the pen equivalent to joint torques, N.
  Vec2 force(const Joints& torque_nm) const {
    const double per = 1.0 / cross(pen_by_1, pen_by_5);
    return {per * (torque_nm[0] * pen_by_5.y - torque_nm[1] * pen_by_1.y),
            per * (torque_nm[1] * pen_by_1.x - torque_nm[0] * pen_by_5.x)};
  }
  /// Joint speeds that move the pen with `speed` (m/s), rad/s.
  Joints omega(Vec2 speed) const {
    const double per = 1.0 / cross(pen_by_1, pen_by_5);
    return {per * cross(speed, pen_by_5), per * cross(pen_by_1, speed)};
  }
};

/// Accelerations at constant angular speeds of the cranks.
struct LinkageSwing {
  Vec2 elbow_1, elbow_5, pen;       ///< m/s^2
  double rod_1 = 0.0, rod_5 = 0.0;  ///< rad/s^2
};

/// Direct and inverse geometry.
class Linkage {
 public:
  explicit Linkage(const LinkageGeometry& geometry) : g_(geometry) {}
  const LinkageGeometry& geometry() const { return g_; }

  /// The pose for crank angles. The pen is on the far side of the line between the elbows, seen
  /// from the motors ("elbows up"; with theta5 > theta1). Where the rods do not reach each other,
  /// all values are NaN.
  LinkagePose pose(const Joints& theta) const {
    LinkagePose p;
    const Vec2 along_1{std::cos(theta[0]), std::sin(theta[0])};
    const Vec2 along_5{std::cos(theta[1]), std::sin(theta[1])};
    p.elbow_1 = g_.crank_1_m * along_1;
    p.elbow_5 = Vec2{-g_.base_m, 0.0} + g_.crank_5_m * along_5;
    p.elbow_1_by_1 = g_.crank_1_m * quarter_turn(along_1);
    p.elbow_5_by_5 = g_.crank_5_m * quarter_turn(along_5);
    // Intersection of two circles: foot of the pen on the line of the elbows, then at a right
    // angle.
    const Vec2 between = p.elbow_5 - p.elbow_1;
    const double between2 = dot(between, between);
    const double a2 = g_.rod_1_m * g_.rod_1_m, a3 = g_.rod_5_m * g_.rod_5_m;
    const double foot = 0.5 + 0.5 * (a2 - a3) / between2;  // as a share of `between`
    const double rise = std::sqrt(a2 / between2 - foot * foot);
    p.rod_1 = foot * between - rise * quarter_turn(between);
    p.pen = p.elbow_1 + p.rod_1;
    p.rod_5 = p.pen - p.elbow_5;
    // Rods keep their lengths: rod . (pen' - elbow') = 0 for both.
    p.rods_cross_m2 = cross(p.rod_1, p.rod_5);
    p.pen_by_1 = meet(p, dot(p.rod_1, p.elbow_1_by_1), 0.0);
    p.pen_by_5 = meet(p, 0.0, dot(p.rod_5, p.elbow_5_by_5));
    p.rod_1_by = {cross(p.rod_1, p.pen_by_1 - p.elbow_1_by_1) / a2,
                  cross(p.rod_1, p.pen_by_5) / a2};
    p.rod_5_by = {cross(p.rod_5, p.pen_by_1) / a3,
                  cross(p.rod_5, p.pen_by_5 - p.elbow_5_by_5) / a3};
    return p;
  }

  /// The same condition, differentiated once more.
  LinkageSwing swing(const LinkagePose& p, const Joints& omega) const {
    LinkageSwing s;
    s.elbow_1 = -omega[0] * omega[0] * p.elbow_1;
    s.elbow_5 = -omega[1] * omega[1] * (p.elbow_5 - Vec2{-g_.base_m, 0.0});
    const Vec2 pen = p.pen_speed(omega);
    const Vec2 rod_1 = pen - omega[0] * p.elbow_1_by_1;
    const Vec2 rod_5 = pen - omega[1] * p.elbow_5_by_5;
    s.pen = meet(p, dot(p.rod_1, s.elbow_1) - dot(rod_1, rod_1),
                 dot(p.rod_5, s.elbow_5) - dot(rod_5, rod_5));
    s.rod_1 = cross(p.rod_1, s.pen - s.elbow_1) / (g_.rod_1_m * g_.rod_1_m);
    s.rod_5 = cross(p.rod_5, s.pen - s.elbow_5) / (g_.rod_5_m * g_.rod_5_m);
    return s;
  }

  /// The crank angles for this pen position, with elbow 1 on the right of the line from its motor
  /// to the pen and elbow 5 on the left. theta1 is within pi of `near_rad`, theta5 within pi of
  /// theta1 + pi/2. Nothing where the pen cannot be.
  std::optional<Joints> inverse(Vec2 pen, double near_rad = 0.0) const {
    constexpr double quarter = 1.5707963267948966192313216916398;
    const auto right = corner(pen, g_.crank_1_m, g_.rod_1_m);
    const Vec2 from_5 = pen - Vec2{-g_.base_m, 0.0};
    const auto left = corner(from_5, g_.crank_5_m, g_.rod_5_m);
    if (!right || !left) return std::nullopt;
    const double theta_1 = beside(std::atan2(pen.y, pen.x) - *right, near_rad);
    return Joints{theta_1, beside(std::atan2(from_5.y, from_5.x) + *left, theta_1 + quarter)};
  }

 private:
  static constexpr Vec2 quarter_turn(Vec2 v) { return {-v.y, v.x}; }

  // The vector v with rod_1 . v = by_1 and rod_5 . v = by_5.
  static Vec2 meet(const LinkagePose& p, double by_1, double by_5) {
    return 1.0 / p.rods_cross_m2 * (by_5 * quarter_turn(p.rod_1) - by_1 * quarter_turn(p.rod_5));
  }

  // Angle at the motor in the triangle of motor, elbow and pen.
  static std::optional<double> corner(Vec2 pen, double crank, double rod) {
    const double far2 = dot(pen, pen);
    const double cosine = (crank * crank + far2 - rod * rod) / (2.0 * crank * std::sqrt(far2));
    if (!(std::abs(cosine) <= 1.0)) return std::nullopt;
    return std::acos(cosine);
  }

  static double beside(double angle, double near) {
    return near + std::remainder(angle - near, 6.283185307179586476925286766559);
  }

  LinkageGeometry g_;
};

}  // namespace feltgate::plant
