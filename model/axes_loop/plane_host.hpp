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
#include "plant/rotation.hpp"

namespace feltgate {

/// [plane] of a scene file. In the plane of two axes z is 0 everywhere.
struct PlaneHostSettings {
  enum class World {
    kFloor,  ///< through `centre_m`; its normal is +y of two axes, +z of three
    kDisc,   ///< felt from outside, as all that follow
    kSphere,
    kCube,  ///< its faces across the axes
  };
  int axes = 2;
  bool sends_force = false;  ///< the force instead of the plane: a word for each axis
  World world = World::kFloor;
  plant::Vec3 centre_m;
  double radius_m = 0;                                       ///< of a cube half its edge
  double stiffness_n_m = 0, damping_ns_m = 0, friction = 0;  ///< what it is made of
  double rate_hz = 1000;
  double latency_s = 0;  ///< from a pose to its plane in the mailbox, at least
  double jitter_s = 0;   ///< and up to so much more, evenly spread
  double lost = 0;       ///< share of the planes that never come
  std::uint64_t seed = 1;
  int line = 0;  ///< of the file
};

/// Reads [plane] for a device with so many axes. Errors: config::ConfigError.
PlaneHostSettings read_plane_host(config::TomlReader table, int axes);

/// A plane: a point of it, and its normal of length 1 out of the material.
struct Plane {
  plant::Vec3 point_m, normal;
};

/// The plane that touches the world where it is nearest to the pen.
Plane nearest_plane(const PlaneHostSettings& world, plant::Vec3 pen_m);
/// Of the spring behind a plane, N.
plant::Vec3 spring_force(const PlaneHostSettings& world, const Plane& plane, plant::Vec3 pen_m);

class PlaneHost {
 public:
  PlaneHost(const PlaneHostSettings& settings, std::int64_t clock_hz);

  /// Errors: config::ConfigError with the scene's path, where the law lacks a mailbox.
  static void check(const PlaneHostSettings& settings, const std::string& path,
                    const SceneLaw& law);

  /// The next clock with something to do.
  Clock next() const;
  /// Does it, with the pen where the cores count it; the words that arrive.
  std::map<std::string, double> act(Clock now, plant::Vec3 counted_m);

  /// The plane that came last, if one has come.
  std::optional<Plane> plane() const {
    return now_ ? std::optional<Plane>(now_->plane) : std::nullopt;
  }

  static std::vector<std::string> names(int axes);
  /// Values of names(): normal in force, its angle from the world's at the pen (with the sign of a
  /// turn about z where there are two axes), age of the pose behind it, change of the spring's
  /// force by an update in the first row after it, else 0.
  void add(Clock now, plant::Vec3 pen_m, std::vector<double>& row);
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  struct Update {
    Clock sampled = 0, at = 0;
    Plane plane;
    plant::Vec3 pen_m;
  };
  Clock clock_of(std::int64_t sample) const;
  std::map<std::string, double> words(const Update& u) const;

  PlaneHostSettings settings_;
  double clock_hz_;
  SplitMix64 random_;
  std::int64_t samples_ = 0, lost_ = 0, arrived_ = 0;
  Clock next_sample_ = 0;
  std::deque<Update> under_way_;  ///< by arrival
  std::optional<Update> now_, before_;
};

}  // namespace feltgate
