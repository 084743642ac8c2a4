// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One step of linkage, stops and hand: fourth-order Runge-Kutta, cut where a stop is met or left,
// with the work of the hand as one of its states. Documentation: docs/pantograph.md
#pragma once

#include <cmath>
#include <cstddef>

#include "linkage_dynamics.hpp"
#include "linkage_stops.hpp"

namespace feltgate::plant {

struct LinkageState {
  Joints theta_rad = {}, omega_rad_s = {};
  Vec2 hand_m, hand_m_s;     ///< of a hand with a mass
  double hand_work_j = 0.0;  ///< done by the hand on the pen
  double viscous_j = 0.0;    ///< lost to viscous friction
};

/// What acts over one step, besides the stops.
struct LinkageLoad {
  Joints torque_nm = {};          ///< of motors less dry friction, held
  double viscous_nm_s_rad = 0.0;  ///< at each joint
  Vec2 force_n;                   ///< at the pen, held
  /// A hand with a mass, behind its grip: towards a place that moves, both held.
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

class LinkageMechanics {
 public:
  LinkageMechanics(const LinkageGeometry& geometry, const LinkageBodies& bodies,
                   const LinkageStops& stops)
      : dynamics_(geometry, bodies), contact_(stops) {}

  const LinkageDynamics& dynamics() const { return dynamics_; }
  const Linkage& linkage() const { return dynamics_.linkage(); }
  /// Lost in stops since the start, J.
  double stop_loss_j() const { return stop_loss_j_; }
  /// Kinetic energy and what the stops would give back, J; the hand's own is not in it.
  double stored_j(const LinkageState& s) const {
    return dynamics_.kinetic_j(linkage().pose(s.theta_rad), s.omega_rad_s) +
           contact_.stored_j(between(s));
  }

  /// Advances by dt_s. A linkage that no longer closes shows as NaN.
  void step(LinkageState& s, const LinkageLoad& load, double dt_s) {
    int zone = contact_.zone(between(s), s.omega_rad_s[1] - s.omega_rad_s[0]);
    double left_s = dt_s;
    LinkageState next = flow(s, load, zone, left_s);
    for (int cuts = 0; cuts < kMostCuts && !contact_.within(zone, between(next)); ++cuts) {
      const bool up = zone == 0 || (zone < 4 && between(next) > contact_.upper(zone));
      if (std::isnan(between(next))) break;
      const double end = up ? contact_.upper(zone) : contact_.lower(zone);
      const double cut_s = cross_at(s, load, zone, end, left_s, between(next) - end);
      s = flow(s, load, zone, cut_s);
      left_s -= cut_s;
      do zone += up ? 1 : -1;
      while (zone > 0 && zone < 4 && contact_.upper(zone) <= contact_.lower(zone));
      next = flow(s, load, zone, left_s);
    }
    s = next;
    stop_loss_j_ += contact_.settle(between(s));
  }

  /// The hand puts the joints there: the force at the pen that it takes over dt_s, N, beside a load
  /// whose own force is not looked at. Stops are passed through.
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
  static constexpr int kMostCuts = 4;  // of one step; a linkage that trembles goes on uncut

  static double between(const LinkageState& s) { return s.theta_rad[1] - s.theta_rad[0]; }

  // How fast everything changes, in the places of what changes.
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

  static void add(LinkageState& s, double k, const LinkageState& r) {
    for (std::size_t i = 0; i < 2; ++i) {
      s.theta_rad[i] += k * r.theta_rad[i];
      s.omega_rad_s[i] += k * r.omega_rad_s[i];
    }
    s.hand_m = s.hand_m + k * r.hand_m;
    s.hand_m_s = s.hand_m_s + k * r.hand_m_s;
    s.hand_work_j += k * r.hand_work_j;
    s.viscous_j += k * r.viscous_j;
  }

  // The classic Runge-Kutta step.
  LinkageState flow(const LinkageState& s, const LinkageLoad& load, int zone, double dt_s) const {
    const LinkageState k1 = rate(s, load, zone);
    LinkageState at = s;
    add(at, 0.5 * dt_s, k1);
    const LinkageState k2 = rate(at, load, zone);
    at = s;
    add(at, 0.5 * dt_s, k2);
    const LinkageState k3 = rate(at, load, zone);
    at = s;
    add(at, dt_s, k3);
    const LinkageState k4 = rate(at, load, zone);
    at = s;
    add(at, dt_s / 6.0, k1);
    add(at, dt_s / 3.0, k2);
    add(at, dt_s / 3.0, k3);
    add(at, dt_s / 6.0, k4);
    return at;
  }

  // After what time the angle between the cranks passes `end`: regula falsi, Illinois' way.
  double cross_at(const LinkageState& s, const LinkageLoad& load, int zone, double end,
                  double most_s, double beyond) const {
    double a = 0.0, b = most_s, at_a = between(s) - end, at_b = beyond, cut = 0.0;
    // It begins on the border and comes back to it: from somewhere between.
    for (int half = 0; half < 12 && std::abs(at_a) < LinkageContact::kNear_rad; ++half) {
      a = 0.5 * (half == 0 ? b : a);
      at_a = between(flow(s, load, zone, a)) - end;
      if (at_a * at_b < 0.0) break;
      at_a = 0.0;
    }
    for (int turn = 0; turn < 24; ++turn) {
      if (at_a * at_b >= 0.0) break;
      cut = (a * at_b - b * at_a) / (at_b - at_a);
      const double at_cut = between(flow(s, load, zone, cut)) - end;
      if (std::abs(at_cut) < 1e-16) break;
      if (at_cut * at_b < 0.0) {
        a = b;
        at_a = at_b;
      } else {
        at_a *= 0.5;
      }
      b = cut;
      at_b = at_cut;
    }
    return cut;
  }

  LinkageDynamics dynamics_;
  LinkageContact contact_;
  double stop_loss_j_ = 0.0;
};

}  // namespace feltgate::plant
