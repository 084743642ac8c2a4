// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A Runge-Kutta step that is split where an angle meets or leaves a stop.
// docs/devices/pantograph.md
#pragma once

#include <algorithm>
#include <cmath>

namespace feltgate::plant {

// Elastic stops that limit an angle. Energy and passivity: docs/devices/pantograph.md

/// A spring at each end of the angle; it returns restitution^2 of the energy that it took.
struct AngleStops {
  double least_rad = 0.0, most_rad = 0.0;
  double stiffness_nm_rad = 0.0;
  double restitution = 1.0;  ///< 0.1 to 1
};

/// Both stops, with their deepest compression. A spring is loaded with its stiffness and unloaded
/// with stiffness/restitution^2: from the same torque, the torque reaches 0 before the whole way is
/// back. When pressed again it follows the unloading line up to its deepest point. So the torque is
/// continuous, and its potential only falls when a contact gets deeper: whatever the motion, the
/// stop gives no net energy. (Walton and Braun, J. Rheol. 30, 1986: loading and unloading of a
/// sphere.)
class AngleContact {
 public:
  static constexpr double kNear_rad = 1e-14;  ///< an angle this near to a border is on it

  explicit AngleContact(const AngleStops& stops)
      : s_(stops),
        kept_(stops.restitution * stops.restitution),
        back_nm_rad_(stops.stiffness_nm_rad / kept_) {}

  /// Zone of the contact. 0: deeper than before at the low end; 1: unloading there; 2: free; 3 and
  /// 4: the same at the high end, unloading and deeper. On a border the speed decides.
  int zone(double angle_rad, double rad_s) const {
    int zone = 0;
    while (zone < 4) {
      const double beyond = angle_rad - upper(zone);
      if (beyond <= (rad_s > 0.0 ? -kNear_rad : kNear_rad)) break;
      ++zone;
    }
    return zone;
  }
  bool within(int zone, double angle_rad) const {
    return (zone == 0 || angle_rad >= lower(zone)) && (zone == 4 || angle_rad <= upper(zone));
  }
  /// Upper and lower end of a zone, rad; zone 4 has no upper end, zone 0 no lower one.
  double upper(int zone) const {
    const double ends[] = {s_.least_rad - low_rad_, s_.least_rad - dent(low_rad_),
                           s_.most_rad + dent(high_rad_), s_.most_rad + high_rad_};
    return ends[zone];
  }
  double lower(int zone) const { return upper(zone - 1); }

  /// Torque toward larger angles, Nm.
  double torque_nm(int zone, double angle_rad) const {
    if (zone == 2) return 0.0;
    if (zone == 1 || zone == 3) return back_nm_rad_ * (upper(zone == 1 ? 1 : 2) - angle_rad);
    return s_.stiffness_nm_rad * ((zone == 0 ? s_.least_rad : s_.most_rad) - angle_rad);
  }
  /// Energy that the springs would return, J.
  double stored_j(double angle_rad) const {
    return stored_j(s_.least_rad - angle_rad, low_rad_) +
           stored_j(angle_rad - s_.most_rad, high_rad_);
  }
  /// Sets the present angle: updates the deepest points and returns the energy that was lost, J.
  double settle(double angle_rad) {
    const double before_j = stored_j(angle_rad);
    low_rad_ = settled(s_.least_rad - angle_rad, low_rad_);
    high_rad_ = settled(angle_rad - s_.most_rad, high_rad_);
    return before_j - stored_j(angle_rad);
  }

 private:
  /// Compression at which the torque is 0 on the way back from the deepest point.
  double dent(double deepest_rad) const { return (1.0 - kept_) * deepest_rad; }
  double stored_j(double depth_rad, double deepest_rad) const {
    const double back_rad = std::min(depth_rad, deepest_rad) - dent(deepest_rad);
    if (depth_rad <= 0.0 || back_rad < 0.0) return 0.0;
    const double stored = 0.5 * back_nm_rad_ * back_rad * back_rad;
    if (depth_rad <= deepest_rad) return stored;
    return stored + 0.5 * s_.stiffness_nm_rad * (depth_rad * depth_rad - deepest_rad * deepest_rad);
  }
  static double settled(double depth_rad, double deepest_rad) {
    return depth_rad <= 0.0 ? 0.0 : std::max(depth_rad, deepest_rad);
  }

  AngleStops s_;
  double kept_;                            ///< share of the energy that is returned
  double back_nm_rad_;                     ///< stiffness on the way back
  double low_rad_ = 0.0, high_rad_ = 0.0;  ///< deepest points of the present contacts
};

/// The classic step of fourth order. `rate(state)` gives the rates of all parts as a state;
/// `add(state, k, rate)` adds k times a rate.
template <class State, class Rate>
State runge_kutta(const State& s, double dt_s, Rate&& rate) {
  const State k1 = rate(s);
  State at = s;
  add(at, 0.5 * dt_s, k1);
  const State k2 = rate(at);
  at = s;
  add(at, 0.5 * dt_s, k2);
  const State k3 = rate(at);
  at = s;
  add(at, dt_s, k3);
  const State k4 = rate(at);
  at = s;
  add(at, dt_s / 6.0, k1);
  add(at, dt_s / 3.0, k2);
  add(at, dt_s / 3.0, k3);
  add(at, dt_s / 6.0, k4);
  return at;
}

/// The time at which `beyond(state)` crosses 0 in a step of most_s, at whose end it is `at_b`;
/// regula falsi, Illinois variant.
template <class State, class Flow, class Beyond>
double cross_at(const State& s, double most_s, double at_b, Flow&& flow, Beyond&& beyond) {
  double a = 0.0, b = most_s, at_a = beyond(s), cut = 0.0;
  // A start on the border: begin instead at a point between start and end.
  for (int half = 0; half < 12 && std::abs(at_a) < AngleContact::kNear_rad; ++half) {
    a = 0.5 * (half == 0 ? b : a);
    at_a = beyond(flow(s, a));
    if (at_a * at_b < 0.0) break;
    at_a = 0.0;
  }
  for (int turn = 0; turn < 24; ++turn) {
    if (at_a * at_b >= 0.0) break;
    cut = (a * at_b - b * at_a) / (at_b - at_a);
    const double at_cut = beyond(flow(s, cut));
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

/// Advances `s` by dt_s through the stops that limit angle(state), whose present speed is rad_s.
/// flow(state, zone, seconds) integrates inside one zone of the contact. Returns the energy that
/// the stops took, J.
template <class State, class Flow, class Angle>
double contact_step(AngleContact& contact, State& s, double dt_s, double rad_s, Flow&& flow,
                    Angle&& angle) {
  constexpr int most_cuts = 4;  // a trembling contact continues unsplit
  int zone = contact.zone(angle(s), rad_s);
  double left_s = dt_s;
  State next = flow(s, zone, left_s);
  for (int cuts = 0; cuts < most_cuts && !contact.within(zone, angle(next)); ++cuts) {
    if (std::isnan(angle(next))) break;
    const bool up = zone == 0 || (zone < 4 && angle(next) > contact.upper(zone));
    const double end = up ? contact.upper(zone) : contact.lower(zone);
    const double cut_s = cross_at(
        s, left_s, angle(next) - end,
        [&](const State& from, double t) { return flow(from, zone, t); },
        [&](const State& at) { return angle(at) - end; });
    s = flow(s, zone, cut_s);
    left_s -= cut_s;
    do zone += up ? 1 : -1;
    while (zone > 0 && zone < 4 && contact.upper(zone) <= contact.lower(zone));
    next = flow(s, zone, left_s);
  }
  s = next;
  return contact.settle(angle(s));
}

}  // namespace feltgate::plant
