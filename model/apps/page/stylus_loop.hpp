// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A stylus on three slides, in a hand that a mouse leads. A host knows the world and sends nearest
// planes to the law. Simulates the law's words and counts, without cores, motors and dry friction.
// Documentation: docs/page.md
#pragma once

#include <map>
#include <optional>
#include <string>

#include "apps/page/image_law.hpp"
#include "apps/page/pace.hpp"
#include "sim/axes_loop/plane_host.hpp"
#include "sim/plant/hand.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/plant/rotation.hpp"

namespace feltgate::page {

/// Mechanics of each axis.
struct StylusSlides {
  double mass_kg = 0;
  double friction_ns_m = 0;  ///< viscous
  double capstan_m = 0;      ///< radius of the capstan: force = torque / radius
};

/// The slides of a device file with [slides], which are given as rotation of a capstan.
StylusSlides slides_of(const plant::Parameters& slide);

/// The design for which the law's image is compiled; it need not be built in.
DesignInfo stylus_design();

class StylusLoop {
 public:
  static constexpr double most_n = 3.3;   ///< largest force per axis, vectors/devices/stylus.toml
  static constexpr double reach_m = 0.1;  ///< reach along each axis, to both sides

  /// The pen rests at (0, 0, 0.05) m, and the world is empty.
  /// Throws std::invalid_argument for a broken image.
  StylusLoop(const std::string& image_text, const StylusSlides& slides);

  /// Sets a parameter of the law; touch() sets the values that the host sends. Throws
  /// std::invalid_argument.
  void set(const std::string& parameter, double value);
  /// Changes the host's world, material, rate or age from the next run on. The previous plane holds
  /// until the first new one arrives.
  void touch(const PlaneHostSettings& world);
  /// Places pen and hand at rest at `at_m`.
  void place(plant::Vec3 at_m);
  /// The place to which the hand moves at constant speed during the next advance(). It is moved
  /// into reach; a place that is not finite is ignored.
  void lead(plant::Vec3 to_m);
  /// Runs host and law as often as they fit in the time; the remainder is added to the next call.
  void advance(double seconds);

  plant::Vec3 pen_m() const { return pen_m_; }
  plant::Vec3 velocity_m_s() const { return velocity_m_s_; }
  plant::Vec3 hand_m() const { return hand_m_; }
  /// Force on the pen in the last run, N.
  plant::Vec3 force_n() const { return force_n_; }
  /// Whether the law demanded more than most_n in that run.
  bool limited() const { return limited_; }
  /// Depth of the pen below the world's surface, m; negative outside; 0 without a world.
  double depth_m() const;
  /// The plane that arrived last; nothing if none has arrived.
  std::optional<Plane> plane() const { return host_ ? host_->plane() : std::nullopt; }
  /// Angle between the normal that arrived last and the world's normal at the pen; and age of the
  /// pose of that plane. Both at the end of the last advance(); 0 if no plane has arrived.
  double tilt_rad() const { return tilt_rad_; }
  double age_s() const { return age_s_; }
  /// In a hollow of a smaller radius the pen would swing sideways by itself, pressed as it is now,
  /// m: by the linear loop of docs/page.md#a-mesh with the mean age of a plane and the hand's
  /// mass, spring and damping; 0: in none.
  double steady_hollow_m() const;
  const ImageLaw& law() const { return law_; }
  double time_s() const { return time_s_; }

 private:
  void step(double dt_s, plant::Vec3 hand_m_s);
  void look();

  ImageLaw law_;
  StylusSlides slides_;
  plant::Impedance hand_;
  PlaneHostSettings world_;
  std::optional<PlaneHost> host_;
  Clock host_runs_ = 0;                 ///< the clock of the host: runs since touch()
  std::map<std::string, double> sent_;  ///< values of the plane in the mailbox
  plant::Vec3 pen_m_, velocity_m_s_, hand_m_, wanted_m_, force_n_;
  double tilt_rad_ = 0, age_s_ = 0, time_s_ = 0;
  Pace pace_;
  bool limited_ = false;
};

}  // namespace feltgate::page
