// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One step of linkage, stops and hand: fourth-order Runge-Kutta, split where a stop is met or left;
// the work of the hand is one of the states. Documentation: docs/devices/pantograph.md
#pragma once

#include <cstddef>

#include "../contact_step.hpp"
#include "linkage.hpp"

namespace feltgate::plant {

// Dynamics of a five-bar linkage: mass matrix, centrifugal and Coriolis torques, kinetic energy,
// from the centres and rotations of its bodies. Derivation: docs/devices/pantograph.md

struct LinkBody {
  double mass_kg = 0.0;
  double centre_m = 0.0;       ///< centre of mass, from the motor (crank) or elbow (rod)
  double inertia_kg_m2 = 0.0;  ///< about the centre of mass
};

struct LinkageBodies {
  LinkBody crank_1, rod_1, rod_5, crank_5;
  double pen_kg = 0.0;  ///< a point mass at the pen
  Joints joint_inertia_kg_m2 =
      {};  ///< of what turns with the joint: motor behind the capstan, drum
};

/// Mass matrix and torques of the linkage.
class LinkageDynamics {
 public:
  LinkageDynamics(const LinkageGeometry& geometry, const LinkageBodies& bodies)
      : linkage_(geometry), b_(bodies) {
    crank_1_ = b_.crank_1.centre_m / geometry.crank_1_m;
    rod_1_ = b_.rod_1.centre_m / geometry.rod_1_m;
    rod_5_ = b_.rod_5.centre_m / geometry.rod_5_m;
    crank_5_ = b_.crank_5.centre_m / geometry.crank_5_m;
  }
  const Linkage& linkage() const { return linkage_; }

  /// The mass matrix M in T = 1/2 omega' M omega, kg m^2.
  JointMatrix mass(const LinkagePose& p) const {
    JointMatrix m{b_.joint_inertia_kg_m2[0], 0.0, b_.joint_inertia_kg_m2[1]};
    add(m, b_.crank_1, crank_1_ * p.elbow_1_by_1, {}, {1.0, 0.0});
    add(m, b_.crank_5, {}, crank_5_ * p.elbow_5_by_5, {0.0, 1.0});
    add(m, b_.rod_1, (1.0 - rod_1_) * p.elbow_1_by_1 + rod_1_ * p.pen_by_1, rod_1_ * p.pen_by_5,
        p.rod_1_by);
    add(m, b_.rod_5, rod_5_ * p.pen_by_1, (1.0 - rod_5_) * p.elbow_5_by_5 + rod_5_ * p.pen_by_5,
        p.rod_5_by);
    add(m, {b_.pen_kg, 0.0, 0.0}, p.pen_by_1, p.pen_by_5, {});
    return m;
  }

  /// Torques that keep the speeds constant (C in M alpha + C = torque), Nm: mass times acceleration
  /// of each body at constant speeds, transformed to the joints.
  Joints coriolis(const LinkagePose& p, const Joints& omega) const {
    const LinkageSwing s = linkage_.swing(p, omega);
    Joints c = {};
    // Cranks turn about fixed points: their acceleration is radial and needs no torque.
    push(c, b_.rod_1, (1.0 - rod_1_) * s.elbow_1 + rod_1_ * s.pen, s.rod_1,
         (1.0 - rod_1_) * p.elbow_1_by_1 + rod_1_ * p.pen_by_1, rod_1_ * p.pen_by_5, p.rod_1_by);
    push(c, b_.rod_5, (1.0 - rod_5_) * s.elbow_5 + rod_5_ * s.pen, s.rod_5, rod_5_ * p.pen_by_1,
         (1.0 - rod_5_) * p.elbow_5_by_5 + rod_5_ * p.pen_by_5, p.rod_5_by);
    push(c, {b_.pen_kg, 0.0, 0.0}, s.pen, 0.0, p.pen_by_1, p.pen_by_5, {});
    return c;
  }

  /// Kinetic energy, J.
  double kinetic_j(const LinkagePose& p, const Joints& omega) const {
    return 0.5 * dot(omega, mass(p).times(omega));
  }

 private:
  static void add(JointMatrix& m, const LinkBody& body, Vec2 by_1, Vec2 by_5, const Joints& turn) {
    m.m11 += body.mass_kg * dot(by_1, by_1) + body.inertia_kg_m2 * turn[0] * turn[0];
    m.m15 += body.mass_kg * dot(by_1, by_5) + body.inertia_kg_m2 * turn[0] * turn[1];
    m.m55 += body.mass_kg * dot(by_5, by_5) + body.inertia_kg_m2 * turn[1] * turn[1];
  }
  static void push(Joints& c, const LinkBody& body, Vec2 acceleration, double spin, Vec2 by_1,
                   Vec2 by_5, const Joints& turn) {
    c[0] += body.mass_kg * dot(by_1, acceleration) + body.inertia_kg_m2 * turn[0] * spin;
    c[1] += body.mass_kg * dot(by_5, acceleration) + body.inertia_kg_m2 * turn[1] * spin;
  }

  Linkage linkage_;
  LinkageBodies b_;
  double crank_1_, rod_1_, rod_5_, crank_5_;  ///< centres as shares of the lengths
};

struct LinkageState {
  Joints theta_rad = {}, omega_rad_s = {};
  Vec2 hand_m, hand_m_s;     ///< of a hand with a mass
  double hand_work_j = 0.0;  ///< done by the hand on the pen
  double viscous_j = 0.0;    ///< lost to viscous friction
};

/// Adds k*r to s, component by component.
inline void add(LinkageState& s, double k, const LinkageState& r) {
  for (std::size_t i = 0; i < 2; ++i) {
    s.theta_rad[i] += k * r.theta_rad[i];
    s.omega_rad_s[i] += k * r.omega_rad_s[i];
  }
  s.hand_m = s.hand_m + k * r.hand_m;
  s.hand_m_s = s.hand_m_s + k * r.hand_m_s;
  s.hand_work_j += k * r.hand_work_j;
  s.viscous_j += k * r.viscous_j;
}

/// The loads during one step, other than the stops.
struct LinkageLoad {
  Joints torque_nm = {};          ///< motors - dry friction; held
  double viscous_nm_s_rad = 0.0;  ///< at each joint
  Vec2 force_n;                   ///< at the pen, held
  /// A hand with a mass behind its grip, drawn to a moving target; target and rate are held.
  bool hand = false;
  double hand_per_kg = 0.0;  ///< 1/mass
  double damping_ns_m = 0.0, stiffness_n_m = 0.0;
  double grip_damping_ns_m = 0.0, grip_stiffness_n_m = 0.0;
  Vec2 target_m, target_m_s;

  /// Force on the pen, N.
  Vec2 on_pen(const LinkageState& s, Vec2 pen, Vec2 pen_speed) const {
    if (!hand) return force_n;
    return force_n + grip_stiffness_n_m * (s.hand_m - pen) +
           grip_damping_ns_m * (s.hand_m_s - pen_speed);
  }
};

/// Equations of motion of the linkage, and their step.
class LinkageMechanics {
 public:
  LinkageMechanics(const LinkageGeometry& geometry, const LinkageBodies& bodies,
                   const AngleStops& stops /* on theta5 - theta1 */)
      : dynamics_(geometry, bodies), contact_(stops) {}

  const LinkageDynamics& dynamics() const { return dynamics_; }
  const Linkage& linkage() const { return dynamics_.linkage(); }
  /// Energy lost in the stops since the start, J.
  double stop_loss_j() const { return stop_loss_j_; }
  /// Kinetic energy plus the energy that the stops would return, J; excludes the hand's own.
  double stored_j(const LinkageState& s) const {
    return dynamics_.kinetic_j(linkage().pose(s.theta_rad), s.omega_rad_s) +
           contact_.stored_j(between(s));
  }

  /// Advances by dt_s. If the linkage no longer closes, the state becomes NaN.
  void step(LinkageState& s, const LinkageLoad& load, double dt_s) {
    stop_loss_j_ += contact_step(
        contact_, s, dt_s, s.omega_rad_s[1] - s.omega_rad_s[0],
        [&](const LinkageState& from, int zone, double t) {
          return runge_kutta(from, t, [&](const LinkageState& at) { return rate(at, load, zone); });
        },
        between);
  }

  /// The hand sets the joints to these values: returns the force at the pen that this takes over
  /// dt_s, N, in addition to `load`, whose own force is ignored. Stops have no effect.
  Vec2 impose(LinkageState& s, const Joints& theta, const Joints& omega, const LinkageLoad& load,
              double dt_s) const {
    Joints middle, speed, alpha;
    for (std::size_t i = 0; i < 2; ++i) {
      middle[i] = 0.5 * (s.theta_rad[i] + theta[i]);
      speed[i] = (theta[i] - s.theta_rad[i]) / dt_s;
      alpha[i] = (omega[i] - s.omega_rad_s[i]) / dt_s;
    }
    const LinkagePose p = linkage().pose(middle);
    const Joints c = dynamics_.coriolis(p, speed);
    Joints asked = dynamics_.mass(p).times(alpha);
    for (std::size_t i = 0; i < 2; ++i) {
      asked[i] += c[i] + load.viscous_nm_s_rad * speed[i] - load.torque_nm[i];
    }
    s.theta_rad = theta;
    s.omega_rad_s = omega;
    s.hand_work_j += dot(asked, speed) * dt_s;
    s.viscous_j += load.viscous_nm_s_rad * dot(speed, speed) * dt_s;
    return p.force(asked);
  }

 private:
  static double between(const LinkageState& s) { return s.theta_rad[1] - s.theta_rad[0]; }

  // Rates of all states, stored in the places of the states.
  LinkageState rate(const LinkageState& s, const LinkageLoad& load, int zone) const {
    const LinkagePose p = linkage().pose(s.theta_rad);
    const Joints c = dynamics_.coriolis(p, s.omega_rad_s);
    const Vec2 pen_speed = p.pen_speed(s.omega_rad_s);
    const Vec2 force = load.on_pen(s, p.pen, pen_speed);
    const Joints by_force = p.torque(force);
    const double stop_nm = contact_.torque_nm(zone, between(s));
    Joints net;
    for (std::size_t i = 0; i < 2; ++i) {
      net[i] = load.torque_nm[i] - load.viscous_nm_s_rad * s.omega_rad_s[i] + by_force[i] - c[i];
    }
    net[0] -= stop_nm;
    net[1] += stop_nm;
    LinkageState r;
    r.theta_rad = s.omega_rad_s;
    r.omega_rad_s = dynamics_.mass(p).solve(net);
    if (load.hand) {
      r.hand_m = s.hand_m_s;
      r.hand_m_s = load.hand_per_kg *
                   (load.stiffness_n_m * (load.target_m - s.hand_m) +
                    load.damping_ns_m * (load.target_m_s - s.hand_m_s) - (force - load.force_n));
    }
    r.hand_work_j = dot(force, pen_speed);
    r.viscous_j = load.viscous_nm_s_rad * dot(s.omega_rad_s, s.omega_rad_s);
    return r;
  }

  LinkageDynamics dynamics_;
  AngleContact contact_;
  double stop_loss_j_ = 0.0;
};

}  // namespace feltgate::plant
