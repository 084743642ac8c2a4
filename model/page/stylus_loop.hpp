// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A stylus on three slides in a hand that a mouse leads, on a world that a host knows: nearest
// planes, the law's words and counts, without cores, motors and dry friction.
// Documentation: docs/page.md
#pragma once

#include <map>
#include <optional>
#include <string>

#include "axes_loop/plane_host.hpp"
#include "page/image_law.hpp"
#include "page/pace.hpp"
#include "plant/hand.hpp"
#include "plant/parameters.hpp"
#include "plant/rotation.hpp"

namespace feltgate::page {

/// What moves along each axis.
struct StylusSlides {
  double mass_kg = 0;
  double friction_ns_m = 0;  ///< viscous
  double capstan_m = 0;      ///< radius that makes a torque a force
};

/// Of a device file with [slides]: what it says in turns of a capstan.
StylusSlides slides_of(const plant::Parameters& slide);

/// The design that the law's image is compiled for; no program need have it built in.
DesignInfo stylus_design();

class StylusLoop {
 public:
  static constexpr double most_n = 3.3;   ///< along each axis, of vectors/devices/stylus.toml
  static constexpr double reach_m = 0.1;  ///< along each axis, to both sides

  /// The pen rests at (0, 0, 0.05) m, and nothing is there to touch.
  /// Errors: std::invalid_argument for a broken image.
  StylusLoop(const std::string& image_text, const StylusSlides& slides);

  /// A parameter of the law. What a host sends is touch()'s. Errors: std::invalid_argument.
  void set(const std::string& parameter, double value);
  /// A host with another world, material, rate or age, from the next run on. The plane of before
  /// holds until its first one comes.
  void touch(const PlaneHostSettings& world);
  /// Pen and hand at rest there.
  void place(plant::Vec3 at_m);
  /// Where the hand wants to be when the next advance() ends; it moves there evenly. Drawn into
  /// reach; what is no place is not followed.
  void lead(plant::Vec3 to_m);
  /// Runs host and law as often as fits; the rest of the time waits for the next call.
  void advance(double seconds);

  plant::Vec3 pen_m() const { return pen_m_; }
  plant::Vec3 velocity_m_s() const { return velocity_m_s_; }
  plant::Vec3 hand_m() const { return hand_m_; }
  /// On the pen, in the last run.
  plant::Vec3 force_n() const { return force_n_; }
  /// The law asked for more than most_n then.
  bool limited() const { return limited_; }
  /// Of the pen under the world's surface; outside it below 0. 0 where there is no world.
  double depth_m() const;
  /// What came last; of a host from which nothing has come, nothing.
  std::optional<Plane> plane() const { return host_ ? host_->plane() : std::nullopt; }
  /// Between the normal that came last and the world's at the pen; age of the pose behind it. Both
  /// at the end of the last advance(), 0 where no plane has come.
  double tilt_rad() const { return tilt_rad_; }
  double age_s() const { return age_s_; }
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
  std::map<std::string, double> sent_;  ///< what of it is in the mailbox
  plant::Vec3 pen_m_, velocity_m_s_, hand_m_, wanted_m_, force_n_;
  double tilt_rad_ = 0, age_s_ = 0, time_s_ = 0;
  Pace pace_;
  bool limited_ = false;
};

}  // namespace feltgate::page
