// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Mechanics of a handle in two rings: three joints whose axes meet in one point, outer about z,
// middle about y, inner about x. Inertia, and one step with stops and hand. Derivation:
// docs/devices/three-axes.md
#pragma once

#include <array>
#include <cstddef>

#include "../contact_step.hpp"
#include "../rotation.hpp"

namespace feltgate::plant {

/// One value per joint, in the order outer, middle, inner: rad, rad/s or Nm.
using GimbalJoints = std::array<double, 3>;

/// Principal moments of inertia about the centre, in the body's own frame, kg m^2.
struct GimbalBodies {
  Vec3 outer;                             ///< ring of the outer joint; only z matters
  Vec3 inner;                             ///< ring of the middle joint
  Vec3 handle;                            ///< includes the parts of the hand that move with it
  GimbalJoints joint_inertia_kg_m2 = {};  ///< parts that turn with the joint: motor, drum
};

struct GimbalPose {
  Quaternion handle;              ///< rotation from its own frame to the base's
  std::array<Vec3, 3> axes;       ///< of the joints, in the base's frame
  std::array<Vec3, 3> inner_by;   ///< angular velocity of the inner ring per joint speed, own frame
  std::array<Vec3, 3> handle_by;  ///< the same for the handle
  double middle_sine = 0.0, middle_cosine = 1.0, inner_sine = 0.0, inner_cosine = 1.0;

  /// Angular velocity of the handle, rad/s, in the base's frame.
  Vec3 turning(const GimbalJoints& omega) const {
    return omega[0] * axes[0] + omega[1] * axes[1] + omega[2] * axes[2];
  }
  /// Joint torques equivalent to a torque on the handle (base's frame), Nm: the transposed Jacobian
  /// times it.
  GimbalJoints torque(Vec3 nm) const {
    return {dot(axes[0], nm), dot(axes[1], nm), dot(axes[2], nm)};
  }
};

/// The pose for joint angles; R = Rz(theta[0]) Ry(theta[1]) Rx(theta[2]).
inline GimbalPose gimbal_pose(const GimbalJoints& theta) {
  GimbalPose p;
  const Quaternion outer = Quaternion::about({0.0, 0.0, 1.0}, theta[0]);
  const Quaternion inner = outer * Quaternion::about({0.0, 1.0, 0.0}, theta[1]);
  p.handle = inner * Quaternion::about({1.0, 0.0, 0.0}, theta[2]);
  p.axes = {Vec3{0.0, 0.0, 1.0}, outer.turn({0.0, 1.0, 0.0}), inner.turn({1.0, 0.0, 0.0})};
  p.middle_sine = std::sin(theta[1]);
  p.middle_cosine = std::cos(theta[1]);
  p.inner_sine = std::sin(theta[2]);
  p.inner_cosine = std::cos(theta[2]);
  // Each joint adds its own axis to the outer joints' axes, expressed in the rotated frame.
  const auto by_inner = [&p](Vec3 v) {
    return Vec3{v.x, p.inner_cosine * v.y + p.inner_sine * v.z,
                p.inner_cosine * v.z - p.inner_sine * v.y};
  };
  p.inner_by = {Vec3{-p.middle_sine, 0.0, p.middle_cosine}, Vec3{0.0, 1.0, 0.0}, Vec3{}};
  p.handle_by = {by_inner(p.inner_by[0]), by_inner(p.inner_by[1]), Vec3{1.0, 0.0, 0.0}};
  return p;
}

/// A symmetric matrix, stored by rows.
struct GimbalMatrix {
  std::array<Vec3, 3> rows;
  GimbalJoints times(const GimbalJoints& v) const {
    const Vec3 u{v[0], v[1], v[2]};
    return {dot(rows[0], u), dot(rows[1], u), dot(rows[2], u)};
  }
  /// The inverse of the matrix times v; the determinant must not be 0.
  GimbalJoints solve(const GimbalJoints& v) const {
    const Vec3 x = v[0] * cross(rows[1], rows[2]) + v[1] * cross(rows[2], rows[0]) +
                   v[2] * cross(rows[0], rows[1]);
    const double per = 1.0 / dot(rows[0], cross(rows[1], rows[2]));
    return {per * x.x, per * x.y, per * x.z};
  }
};

struct GimbalState {
  GimbalJoints theta_rad = {}, omega_rad_s = {};
  double hand_work_j = 0.0;  ///< done by the hand on the handle
  double viscous_j = 0.0;    ///< lost to viscous friction
};

/// Adds k*r to s, component by component.
inline void add(GimbalState& s, double k, const GimbalState& r) {
  for (std::size_t i = 0; i < 3; ++i) {
    s.theta_rad[i] += k * r.theta_rad[i];
    s.omega_rad_s[i] += k * r.omega_rad_s[i];
  }
  s.hand_work_j += k * r.hand_work_j;
  s.viscous_j += k * r.viscous_j;
}

/// The loads during one step, other than the stops.
struct GimbalLoad {
  GimbalJoints torque_nm = {};    ///< motors - dry friction; held
  double viscous_nm_s_rad = 0.0;  ///< at each joint
  Vec3 hand_nm;                   ///< on the handle, base's frame, held
  /// A hand that turns the handle towards an orientation, by a spring and a damper; target and rate
  /// are held.
  double stiffness_nm_rad = 0.0, damping_nm_s_rad = 0.0;
  Quaternion target;
  Vec3 target_rad_s;

  /// Torque on the handle, base's frame, Nm.
  Vec3 on_handle(const GimbalPose& p, Vec3 turning) const {
    return hand_nm + coupling_nm(stiffness_nm_rad, target, p.handle) +
           damping_nm_s_rad * (target_rad_s - turning);
  }
};

/// Equations of motion of the gimbal, and their step.
class GimbalMechanics {
 public:
  GimbalMechanics(const GimbalBodies& bodies, const AngleStops& stops /* of the middle joint */)
      : b_(bodies), contact_(stops) {}

  GimbalMatrix mass(const GimbalPose& p) const {
    GimbalMatrix m;
    const auto entry = [&](std::size_t i, std::size_t j) {
      return dot(p.inner_by[i], scaled(b_.inner, p.inner_by[j])) +
             dot(p.handle_by[i], scaled(b_.handle, p.handle_by[j]));
    };
    for (std::size_t i = 0; i < 3; ++i) m.rows[i] = {entry(i, 0), entry(i, 1), entry(i, 2)};
    m.rows[0].x += b_.outer.z + b_.joint_inertia_kg_m2[0];
    m.rows[1].y += b_.joint_inertia_kg_m2[1];
    m.rows[2].z += b_.joint_inertia_kg_m2[2];
    return m;
  }

  /// Torques that keep the joint speeds constant, Nm: Euler's equation of each body at constant
  /// speeds.
  GimbalJoints coriolis(const GimbalPose& p, const GimbalJoints& omega) const {
    const auto sum = [&omega](const std::array<Vec3, 3>& by) {
      return omega[0] * by[0] + omega[1] * by[1] + omega[2] * by[2];
    };
    const Vec3 inner = sum(p.inner_by), handle = sum(p.handle_by);
    // In a frame that turns, the contribution of the outer joints turns backwards.
    const Vec3 inner_rate = cross(inner, {0.0, omega[1], 0.0});
    const Vec3 from_inner{inner_rate.x, p.inner_cosine * inner_rate.y + p.inner_sine * inner_rate.z,
                          p.inner_cosine * inner_rate.z - p.inner_sine * inner_rate.y};
    const Vec3 handle_rate = from_inner + cross(handle, {omega[2], 0.0, 0.0});
    const Vec3 on_inner = scaled(b_.inner, inner_rate) + cross(inner, scaled(b_.inner, inner));
    const Vec3 on_handle =
        scaled(b_.handle, handle_rate) + cross(handle, scaled(b_.handle, handle));
    GimbalJoints c;
    for (std::size_t i = 0; i < 3; ++i) {
      c[i] = dot(p.inner_by[i], on_inner) + dot(p.handle_by[i], on_handle);
    }
    return c;
  }

  /// Energy lost in the stops since the start, J.
  double stop_loss_j() const { return stop_loss_j_; }
  double kinetic_j(const GimbalState& s) const {
    const GimbalJoints p = mass(gimbal_pose(s.theta_rad)).times(s.omega_rad_s);
    return 0.5 * (p[0] * s.omega_rad_s[0] + p[1] * s.omega_rad_s[1] + p[2] * s.omega_rad_s[2]);
  }
  /// Kinetic energy plus the energy that the stops would return, J.
  double stored_j(const GimbalState& s) const {
    return kinetic_j(s) + contact_.stored_j(s.theta_rad[1]);
  }

  /// Advances by dt_s.
  void step(GimbalState& s, const GimbalLoad& load, double dt_s) {
    stop_loss_j_ += contact_step(
        contact_, s, dt_s, s.omega_rad_s[1],
        [&](const GimbalState& from, int zone, double t) {
          return runge_kutta(from, t, [&](const GimbalState& at) { return rate(at, load, zone); });
        },
        [](const GimbalState& at) { return at.theta_rad[1]; });
  }

 private:
  GimbalState rate(const GimbalState& s, const GimbalLoad& load, int zone) const {
    const GimbalPose p = gimbal_pose(s.theta_rad);
    const GimbalJoints c = coriolis(p, s.omega_rad_s);
    const Vec3 turning = p.turning(s.omega_rad_s);
    const Vec3 hand = load.on_handle(p, turning);
    const GimbalJoints by_hand = p.torque(hand);
    GimbalJoints net;
    GimbalState r;
    for (std::size_t i = 0; i < 3; ++i) {
      const double viscous_nm = load.viscous_nm_s_rad * s.omega_rad_s[i];
      net[i] = load.torque_nm[i] - viscous_nm + by_hand[i] - c[i];
      r.viscous_j += viscous_nm * s.omega_rad_s[i];
    }
    net[1] += contact_.torque_nm(zone, s.theta_rad[1]);
    r.theta_rad = s.omega_rad_s;
    r.omega_rad_s = mass(p).solve(net);
    r.hand_work_j = dot(hand, turning);
    return r;
  }

  GimbalBodies b_;
  AngleContact contact_;
  double stop_loss_j_ = 0.0;
};

}  // namespace feltgate::plant
