// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Elastic stops that limit an angle. Energy and passivity: docs/devices/pantograph.md
#pragma once

#include <algorithm>

namespace feltgate::plant {

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

}  // namespace feltgate::plant
