// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A host that knows a world. It sends the plane of the world that is nearest to the pen, or the
// force at the pen; each is computed from a pose that is old on arrival. Documentation:
// docs/devices/pantograph.md
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "feltgate/random.hpp"
#include "sim/loop/scene_law.hpp"
#include "sim/plant/rotation.hpp"

namespace feltgate::config {
class TomlReader;
}

namespace feltgate {

/// A plane: one of its points, and its normal of length 1, which points out of the material. At an
/// edge a second one; its normal is 0 where there is none.
struct Plane {
  plant::Vec3 point_m, normal;
  plant::Vec3 second_point_m{}, second{};
  bool convex = false;         ///< material is where both planes have it, else where either has
  plant::Vec3 velocity_m_s{};  ///< of the surface at the point
  bool edge() const { return plant::length(second) > 0; }
};
/// Within this the force of local_edge turns from one side of a convex edge to the other.
constexpr double edge_round_m = 1e-3;

/// What a plane is made of. Its texture is a vibration of the push, as of the law material.
struct PlaneMaterial {
  double stiffness_n_m = 0, damping_ns_m = 0, friction = 0;
  double vibration_n = 0, frequency_hz = 0;
};

/// [plane] of a scene file. With two axes z is always 0.
struct PlaneHostSettings : PlaneMaterial {
  enum class World {
    kFloor,  ///< through `centre_m`; normal +y for two axes, +z for three
    kDisc,   ///< felt from outside, like all that follow
    kSphere,
    kCube,  ///< its faces are perpendicular to the axes
  };
  int axes = 2;
  bool sends_force = false;  ///< sends the force instead of the plane: one word per axis
  bool edges = false;        ///< sends two planes at an edge, to the law local_edge
  bool moves = false;        ///< sends the planes' velocities too
  bool vibrates = false;     ///< sends the materials' vibrations too
  World world = World::kFloor;
  plant::Vec3 centre_m;
  double radius_m = 0;  ///< for a cube: half its edge
  double rate_hz = 1000;
  double latency_s = 0;  ///< shortest time from a pose to its plane in the mailbox
  double jitter_s = 0;   ///< largest additional time, uniformly distributed
  double lost = 0;       ///< share of the planes that are lost
  std::uint64_t seed = 1;
  int line = 0;  ///< line in the file
  /// A world of its own in place of `world`, no part of a file: called once for each pose that the
  /// host takes, in order.
  std::function<std::pair<Plane, PlaneMaterial>(plant::Vec3 pen_m)> search;
};

/// Reads [plane] for a device with `axes` axes. Errors: config::ConfigError.
PlaneHostSettings read_plane_host(config::TomlReader table, int axes);

/// The plane that touches the world at the point nearest to the pen.
Plane nearest_plane(const PlaneHostSettings& world, plant::Vec3 pen_m);
/// What the host sends of a pose, by the names of the law's mailboxes.
std::map<std::string, double> plane_words(const PlaneHostSettings& world, plant::Vec3 pen_m);
/// And of a pose and the plane that was found for it.
std::map<std::string, double> plane_words(const PlaneHostSettings& world,
                                          const PlaneMaterial& material, const Plane& plane,
                                          plant::Vec3 pen_m);
/// Force of the spring behind a plane, or behind the two of an edge, N.
plant::Vec3 spring_force(const PlaneMaterial& material, const Plane& plane, plant::Vec3 pen_m);

/// The host in a run: takes poses, sends updates late, counts the lost ones.
class PlaneHost {
 public:
  PlaneHost(const PlaneHostSettings& settings, std::int64_t clock_hz);

  /// Errors: config::ConfigError with the scene's path, if the law lacks a mailbox.
  static void check(const PlaneHostSettings& settings, const std::string& path,
                    const SceneLaw& law);

  /// The next clock at which act() has something to do.
  Clock next() const;
  /// Takes the pose and delivers updates due at `now`; `counted_m` is the pen's position by the
  /// cores' counts. Returns the words that arrive.
  std::map<std::string, double> act(Clock now, plant::Vec3 counted_m);

  /// The plane that arrived last, if any.
  std::optional<Plane> plane() const {
    return now_ ? std::optional<Plane>(now_->plane) : std::nullopt;
  }

  static std::vector<std::string> names(int axes);
  /// Appends the values of names(): the normal in force; its angle from the world's normal at the
  /// pen, or from that of the last search (signed as a turn about z if there are two axes); the age
  /// of the pose behind it; the
  /// change of the spring's force by an update, in the first row after it, else 0.
  void add(Clock now, plant::Vec3 pen_m, std::vector<double>& row);
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  struct Update {
    Clock sampled = 0, at = 0;
    Plane plane;
    PlaneMaterial material;
    plant::Vec3 pen_m;
  };
  Clock clock_of(std::int64_t sample) const;

  PlaneHostSettings settings_;
  double clock_hz_;
  SplitMix64 random_;
  std::int64_t samples_ = 0, lost_ = 0, arrived_ = 0;
  Clock next_sample_ = 0;
  std::deque<Update> under_way_;  ///< in order of arrival
  std::optional<Update> now_, before_;
  Plane last_;  ///< of the last pose, arrived or not
};

}  // namespace feltgate
