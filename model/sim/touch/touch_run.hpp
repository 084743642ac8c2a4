// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A stroke of the stylus over a mesh: a hand leads the pen, the proxy finds the plane of each pose,
// and the engine renders it, in the closed loop of a scene. Documentation: docs/touch.md
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/axes_loop/axes_run.hpp"
#include "sim/touch/stroke.hpp"

namespace feltgate::touch {

/// A material by its name, as the scenes material_NAME have it: shares of the stiffness that is
/// asked for and of the law's most damping and vibration, the dynamic friction, and a frequency.
struct MaterialPreset {
  const char* name;
  double hardness, damping, friction, vibration, frequency_hz;
};
constexpr MaterialPreset material_presets[] = {
    {"stone", 1, 0.08, 0.2, 0.2, 200},
    {"fabric", 0.3, 0.16, 0.5, 0.2, 30},
    {"water", 0.02, 0, 0, 0, 0},
    {"object", 0.8, 0.1, 0.3, 0, 0},  // what TouchWorld gives each generated one
};
constexpr double most_damping_ns_m = 2, most_vibration_n = 1,
                 most_frequency_hz = 250;  ///< of the law

inline PlaneMaterial material_of(const MaterialPreset& preset, double stiffness_n_m) {
  return {preset.hardness * stiffness_n_m, preset.damping * most_damping_ns_m, preset.friction,
          preset.vibration * most_vibration_n, preset.frequency_hz};
}

/// What a stroke is run with; `host` has material, rate and delay of the planes.
struct TouchRequest {
  ProxySettings proxy;
  bool distance = false;  ///< planes of a signed distance in place of the proxy
  PlaneHostSettings host;
  std::map<std::string, PlaneMaterial> materials;  ///< of parts that have one of their own, by name
  Stroke stroke;
  Stroke mesh_way;  ///< of the mesh, by how much it is moved and turned; empty: it stands
  /// Above 0: from the third point of the stroke on, nothing leads the pen up and down; the hand
  /// presses it with this force.
  double press_n = 0;
};

/// The law that renders its planes.
inline const char* law_of(const TouchRequest& request) {
  if (request.proxy.edges) return "local_edge";
  bool vibrates = request.host.vibration_n > 0;
  for (const auto& [name, m] : request.materials) vibrates = vibrates || m.vibration_n > 0;
  return vibrates ? "local_vibration" : "local_space";
}

/// So long a stroke lasts at least if a plane shall come: the core arms after 10 ms.
inline double shortest_s(const PlaneHostSettings& host) {
  return 0.01 + host.latency_s + host.jitter_s;
}

/// One pose that the host took, and what it found of it.
struct TouchUpdate {
  double time_s = 0;
  Vec3 pen_m;  ///< by the cores' counts
  Touched touched;
  double took_s = 0;  ///< of the real clock
};
/// What is felt at one time.
struct TouchRow {
  double time_s = 0;
  Vec3 pen_m, normal, force_n;  ///< normal in force; the force that the engine asks for
};
struct TouchRun {
  AxesResult result;
  std::vector<TouchUpdate> updates;
  std::vector<TouchRow> rows;  ///< as many a second as planes
};

/// The hand along one axis, in turns of the capstan.
inline plant::Hand hand_of(const Stroke& stroke, double Vec3::*axis, double capstan_m) {
  plant::Hand hand;
  hand.start_rad = stroke.front().at_m.*axis / capstan_m;
  plant::HandPhase& lead = hand.phases.emplace_back();
  lead.kind = plant::HandPhase::Kind::kPrescribed;
  for (std::size_t n = 1; n < stroke.size(); ++n) {
    plant::Segment s;
    s.kind = plant::Segment::Kind::kRamp;
    s.duration_s = stroke[n].time_s - stroke[n - 1].time_s;
    s.to = stroke[n].at_m.*axis / capstan_m;
    lead.profile.push_back(s);
  }
  return hand;
}

/// Lets go of an axis at `from_s` and pulls it with `force_n`.
inline void let_go(plant::Hand& hand, double from_s, double force_n, double capstan_m) {
  hand.phases.back().duration_s = from_s;
  plant::HandPhase& press = hand.phases.emplace_back();
  press.kind = plant::HandPhase::Kind::kTorque;
  plant::Segment s;
  s.kind = plant::Segment::Kind::kMinimumJerk;
  s.duration_s = 0.02;
  s.to = force_n * capstan_m;
  press.profile.push_back(s);
}

/// The planes of a mesh for the poses of a pen, by the proxy or the signed distance. The mesh must
/// outlive it.
class Seeker {
 public:
  /// Errors: std::invalid_argument for a vibration with edges, and those of SignedDistance.
  Seeker(const Mesh& mesh, const TouchRequest& request)
      : mesh_(mesh),
        proxy_(mesh, request.proxy),
        actor_(mesh, request.mesh_way),
        host_(request.host),
        materials_(std::max<std::size_t>(1, mesh.materials.size()), request.host) {
    if (request.distance) distance_.emplace(mesh);
    host_.axes = 3;
    host_.edges = request.proxy.edges;
    host_.moves = !request.mesh_way.empty();
    for (std::size_t n = 0; n < mesh.materials.size(); ++n) {
      const auto own = request.materials.find(mesh.materials[n]);
      if (own != request.materials.end()) materials_[n] = own->second;
    }
    const std::string law = law_of(request);
    host_.vibrates = law == "local_vibration";
    const bool textured = std::any_of(materials_.begin(), materials_.end(),
                                      [](const PlaneMaterial& m) { return m.vibration_n > 0; });
    if (textured && host_.edges) {
      throw std::invalid_argument(
          "the law of two planes has no room for a vibration; leave it or the edges out");
    }
  }

  /// The pen is there at the time 0. Errors: those of Proxy::begin().
  void begin(Vec3 pen_m) { proxy_.begin(actor_.in_mesh(pen_m, 0)); }
  /// The plane for a pose; adds what was found to `updates`.
  std::pair<Plane, PlaneMaterial> find(Vec3 pen_m, double time_s,
                                       std::vector<TouchUpdate>& updates) {
    const auto from = std::chrono::steady_clock::now();
    const Vec3 in_mesh = actor_.in_mesh(pen_m, time_s);
    const Touched found = distance_ ? distance_->touched(in_mesh) : proxy_.move(in_mesh);
    const Touched t = actor_.in_device(found, time_s);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - from;
    updates.push_back({time_s, pen_m, t, took.count()});
    return {{t.point_m, t.normal, t.second_point_m, t.second, t.convex,
             actor_.velocity_m_s(found.point_m, time_s)},
            materials_[mesh_.parts[t.triangle]]};
  }
  /// How the planes are sent.
  const PlaneHostSettings& host() const { return host_; }

 private:
  const Mesh& mesh_;
  Proxy proxy_;
  std::optional<SignedDistance> distance_;
  Actor actor_;
  PlaneHostSettings host_;
  std::vector<PlaneMaterial> materials_;
};

/// Runs the stroke in `scene`, one of the stylus with planes; its hand, world, length and
/// expectations are replaced. The law of `options` is law_of() the request. Errors:
/// std::invalid_argument where the stroke begins in the mesh, and those of run_axes().
inline TouchRun run_touch(const Mesh& mesh, const TouchRequest& request, AxesScene scene,
                          AxesRunOptions options, std::int64_t tick_hz) {
  TouchRun run;
  Seeker seeker(mesh, request);
  seeker.begin(request.stroke.front().at_m);
  PlaneHostSettings host = seeker.host();
  host.search = [&](Vec3 pen_m) {
    return seeker.find(pen_m, static_cast<double>(run.updates.size()) / host.rate_hz, run.updates);
  };
  auto& setup = std::get<StylusSetup>(scene.device);
  const double capstan_m = setup.parameters.lever.lever.radius_m;
  setup.hand = {hand_of(request.stroke, &Vec3::x, capstan_m),
                hand_of(request.stroke, &Vec3::y, capstan_m),
                hand_of(request.stroke, &Vec3::z, capstan_m)};
  if (request.press_n > 0) {
    let_go(setup.hand[2], request.stroke.at(2).time_s, -request.press_n, capstan_m);
  }
  scene.plane = host;
  scene.scenario.duration_s = request.stroke.back().time_s;
  scene.scenario.expectations.clear();
  const std::vector<std::string> names = axes_columns(scene);
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const auto columns = [&](const char* x, const char* y, const char* z) {
    return std::array<std::size_t, 3>{column(x), column(y), column(z)};
  };
  const auto pen = columns("pen_x_m", "pen_y_m", "pen_z_m");
  const auto normal = columns("plane_normal_x", "plane_normal_y", "plane_normal_z");
  const auto torque = columns("tau_ref_nm.0", "tau_ref_nm.1", "tau_ref_nm.2");
  options.row_every = std::max(1, static_cast<int>(static_cast<double>(tick_hz) / host.rate_hz));
  options.row = [&](const std::vector<double>& row) {
    const auto of = [&](const std::array<std::size_t, 3>& c) {
      return Vec3{row.at(c[0]), row.at(c[1]), row.at(c[2])};
    };
    run.rows.push_back({row[0], of(pen), of(normal), 1 / capstan_m * of(torque)});
  };
  run.result = run_axes(scene, options);
  return run;
}

/// The value below which `share` of the sorted values are.
inline double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(at, 1, sorted.size()) - 1];
}

}  // namespace feltgate::touch
