// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A host that knows a world and sends the plane of it that is nearest to the pen, or the force at
// the pen, from poses that are old when they arrive. Documentation: docs/devices/local_plane.md
#pragma once

#include <array>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/toml_reader.hpp"
#include "feltgate/encoder_source.hpp"
#include "feltgate/random.hpp"
#include "loop/scene_law.hpp"
#include "plant/pantograph/linkage.hpp"

namespace feltgate {

/// [plane] of a scene file.
struct PlaneHostSettings {
  bool sends_force = false;  ///< the force instead of the plane: two words
  plant::Vec2 centre_m;  ///< of a disc, felt from outside; with radius 0 a point of a flat floor
  double radius_m = 0;   ///< 0: a floor, whose normal is +y
  double stiffness_n_m = 0, damping_ns_m = 0, friction = 0;  ///< what it is made of
  double rate_hz = 1000;
  double latency_s = 0;  ///< from a pose to its plane in the mailbox, at least
  double jitter_s = 0;   ///< and up to so much more, evenly spread
  double lost = 0;       ///< share of the planes that never come
  std::uint64_t seed = 1;
  int line = 0;  ///< of the file
};

/// Reads [plane]. Errors: config::ConfigError.
PlaneHostSettings read_plane_host(config::TomlReader table);

/// A plane: a point of it, and its normal of length 1 out of the material.
struct Plane {
  plant::Vec2 point_m, normal;
};

/// The plane that touches the world where it is nearest to the pen.
Plane nearest_plane(const PlaneHostSettings& world, plant::Vec2 pen_m);
/// Of the spring behind a plane, N.
plant::Vec2 spring_force(const PlaneHostSettings& world, const Plane& plane, plant::Vec2 pen_m);

class PlaneHost {
 public:
  PlaneHost(const PlaneHostSettings& settings, const plant::LinkageGeometry& linkage,
            std::int64_t clock_hz);

  /// Errors: config::ConfigError with the scene's path, where the law lacks a mailbox.
  static void check(const PlaneHostSettings& settings, const std::string& path,
                    const SceneLaw& law);

  /// The next clock with something to do.
  Clock next() const;
  /// Does it, with the angles of the joints as the cores count them; the words that arrive.
  std::map<std::string, double> act(Clock now, const plant::Joints& theta_rad);

  static std::vector<std::string> names();
  /// Values of names(): normal in force, its angle from the world's at the pen, age of the pose
  /// behind it, change of the spring's force by an update in the first row after it, else 0.
  void add(Clock now, plant::Vec2 pen_m, std::vector<double>& row);
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  struct Update {
    Clock sampled = 0, at = 0;
    Plane plane;
    plant::Vec2 pen_m;
  };
  Clock clock_of(std::int64_t sample) const;
  std::map<std::string, double> words(const Update& u) const;

  PlaneHostSettings settings_;
  plant::Linkage linkage_;
  double clock_hz_;
  SplitMix64 random_;
  std::int64_t samples_ = 0, lost_ = 0, arrived_ = 0;
  Clock next_sample_ = 0;
  std::deque<Update> under_way_;  ///< by arrival
  std::optional<Update> now_, before_;
};

}  // namespace feltgate
