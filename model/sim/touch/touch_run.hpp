// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A stroke of the stylus over a mesh: a hand leads the pen, the proxy finds the plane of each pose,
// and the engine renders it, in the closed loop of a scene. Documentation: docs/touch.md
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/axes_loop/axes_run.hpp"
#include "sim/touch/touch.hpp"

namespace feltgate::touch {

// Ways of a pen over a mesh, and of a mesh that moves, turns and grows: from files and made here.

struct StrokePoint {
  double time_s = 0;
  Vec3 at_m;
  Vec3 turn_rad{};   ///< of a mesh, about this direction and by its length; a pen has none
  double scale = 1;  ///< of a mesh; it turns and grows about the middle of its box
};
using Stroke = std::vector<StrokePoint>;

/// Where a way is at a time: straight between its points, still before and after.
inline StrokePoint at_time(const Stroke& way, double time_s) {
  const auto next = std::upper_bound(way.begin(), way.end(), time_s,
                                     [](double t, const StrokePoint& p) { return t < p.time_s; });
  if (next == way.begin()) return way.front();
  if (next == way.end()) return way.back();
  const StrokePoint& last = *(next - 1);
  const double share = (time_s - last.time_s) / (next->time_s - last.time_s);
  return {time_s, last.at_m + share * (next->at_m - last.at_m),
          last.turn_rad + share * (next->turn_rad - last.turn_rad),
          last.scale + share * (next->scale - last.scale)};
}

/// The two corners of a mesh's box.
inline std::pair<Vec3, Vec3> box_of(const Mesh& mesh) {
  Vec3 low = mesh.at.front(), high = low;
  for (const Vec3& v : mesh.at) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  return {low, high};
}

/// A mesh that moves, turns and grows: T_world = T_actor T_mesh. The proxy stays in the frame of
/// the mesh, so a surface that comes to the pen pushes it as one that the pen goes to.
class Actor {
 public:
  Actor(const Mesh& mesh, Stroke way) : way_(std::move(way)) {
    const auto [low, high] = box_of(mesh);
    middle_m_ = 0.5 * (low + high);
  }
  /// A point of the device in the frame of the mesh, at a time.
  Vec3 in_mesh(Vec3 at_m, double time_s) const {
    if (way_.empty()) return at_m;
    const StrokePoint pose = at_time(way_, time_s);
    return middle_m_ + 1 / pose.scale * turned(at_m - pose.at_m - middle_m_, -1.0 * pose.turn_rad);
  }
  /// And a point of the mesh in the frame of the device.
  Vec3 in_device(Vec3 in_mesh_m, double time_s) const {
    if (way_.empty()) return in_mesh_m;
    const StrokePoint pose = at_time(way_, time_s);
    return middle_m_ + pose.at_m + pose.scale * turned(in_mesh_m - middle_m_, pose.turn_rad);
  }
  /// How fast that point of the mesh goes from now on, m/s.
  Vec3 velocity_m_s(Vec3 in_mesh_m, double time_s) const {
    constexpr double step_s = 1e-6;
    return 1 / step_s * (in_device(in_mesh_m, time_s + step_s) - in_device(in_mesh_m, time_s));
  }
  /// What the proxy knows, in the frame of the device.
  Touched in_device(Touched t, double time_s) const {
    if (way_.empty()) return t;
    const StrokePoint pose = at_time(way_, time_s);
    for (Vec3* at : {&t.proxy_m, &t.point_m, &t.second_point_m}) *at = in_device(*at, time_s);
    for (Vec3* normal : {&t.normal, &t.second}) *normal = turned(*normal, pose.turn_rad);
    t.depth_m *= pose.scale;
    return t;
  }

 private:
  static Vec3 turned(Vec3 v, Vec3 by_rad) {
    const double rad = plant::length(by_rad);
    return rad > 0 ? plant::Quaternion::about(1 / rad * by_rad, rad).turn(v) : v;
  }
  Stroke way_;
  Vec3 middle_m_;
};

/// The highest place of a mesh below a point; nothing where there is none.
inline std::optional<double> height_m(const TriangleTree& tree, Vec3 from_m, double down_m) {
  constexpr double ball_m = 1e-6;
  const double share = tree.free_way(from_m, {0, 0, -down_m}, ball_m);
  if (share >= 1) return std::nullopt;
  return from_m.z - share * down_m - ball_m;
}

/// A stroke over the middle `share` of a mesh from left to right, `depth_m` below what is there as
/// seen from above. It waits above, goes down, over, and up again. Errors: std::invalid_argument
/// where nothing is there.
inline Stroke stroke_over(const Mesh& mesh, const TriangleTree& tree, double depth_m,
                          double speed_m_s, double share = 0.9) {
  constexpr int places = 200;
  constexpr double wait_s = 0.02, above_m = 3e-3;
  const auto [low, high] = box_of(mesh);
  const Vec3 middle = 0.5 * (low + high), wide = 0.5 * share * (high - low);
  const double down_m = high.z - low.z + 2 * above_m;
  std::vector<Vec3> way;
  std::size_t last = 0;
  for (int n = 0; n <= places; ++n) {
    const double x = middle.x + wide.x * (2.0 * n / places - 1);
    const auto z = height_m(tree, {x, middle.y, high.z + above_m}, down_m);
    if (!z && way.empty()) continue;
    // Over a hole it stays as high as it was.
    way.push_back({x, middle.y, z ? *z - depth_m : way.back().z});
    if (z) last = way.size();
  }
  if (way.empty()) {
    throw std::invalid_argument("nothing is under the middle of the mesh; give a stroke: --stroke");
  }
  way.resize(last);
  const double top_m = high.z + above_m;
  const auto over = [top_m](Vec3 at) { return Vec3{at.x, at.y, top_m}; };
  way.insert(way.begin(), over(way.front()));
  way.push_back(over(way.back()));
  Stroke stroke{{0, way.front()}, {wait_s, way.front()}};
  for (std::size_t n = 1; n < way.size(); ++n) {
    const double far_m = plant::length(way[n] - way[n - 1]);
    if (far_m > 0) stroke.push_back({stroke.back().time_s + far_m / speed_m_s, way[n]});
  }
  return stroke;
}

/// A stroke of a CSV file with the columns time_s,x_m,y_m,z_m and a line of their names; with
/// `turns` the way of a mesh, which has columns of turns and scale too. Errors:
/// std::invalid_argument "path:line: what; mend", "path: cannot be read; ..." where there is no
/// file.
inline Stroke read_stroke(const std::string& path, bool turns = false) {
  const std::string columns =
      turns ? "time_s,x_m,y_m,z_m,turn_x_rad,turn_y_rad,turn_z_rad,scale" : "time_s,x_m,y_m,z_m";
  const int count = turns ? 8 : 4;
  constexpr std::size_t most_rows = 100'000;
  constexpr double longest_s = 60, fastest_m_s = 5, most_turn_rad = 1000, most_scale = 10;
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(path + ": cannot be read; check the path");
  std::string text;
  int line = 1;
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument(fmt::format("{}:{}: {}", path, line, what));
  };
  if (!std::getline(file, text)) fail("no row; write rows of " + columns);
  if (!text.empty() && text.back() == '\r') text.pop_back();
  if (text != columns) fail(fmt::format("not the columns {}; name them so", columns));
  Stroke stroke;
  while (std::getline(file, text)) {
    ++line;
    double value[] = {0, 0, 0, 0, 0, 0, 0, 1};
    const char* at = text.c_str();
    const auto at_end = [&](const char* c) { return text.c_str() + text.size() - c; };
    for (int n = 0; n < count; ++n) {
      char* end = nullptr;
      value[n] = std::strtod(at, &end);
      const bool last = n + 1 == count;
      const char follows = last ? '\0' : ',';
      if (end == at || !std::isfinite(value[n]) || (*end != follows && !(last && *end == '\r')) ||
          (last && at_end(end) > (*end == '\r' ? 1 : 0))) {
        fail(fmt::format("not {} numbers; write {}", turns ? "eight" : "four", columns));
      }
      at = end + 1;
    }
    const Vec3 to{value[1], value[2], value[3]};
    if (std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)}) > reach_m) {
      fail(fmt::format("beyond the pen's {} m; stay within", reach_m));
    }
    const Vec3 turn_rad{value[4], value[5], value[6]};
    if (plant::length(turn_rad) > most_turn_rad)
      fail(fmt::format("more than {} rad; turn it less", most_turn_rad));
    if (!(value[7] >= 1 / most_scale && value[7] <= most_scale))
      fail(fmt::format("a scale that is not within 1/{0:g} to {0:g}; 1 leaves the size",
                       most_scale));
    if (!stroke.empty() && value[0] <= stroke.back().time_s)
      fail("time does not go on; sort the rows");
    if (!stroke.empty()) {
      const double far_m = plant::length(to - stroke.back().at_m);
      const double took_s = value[0] - stroke.back().time_s;
      if (far_m > fastest_m_s * took_s * (1 + 1e-9)) {
        fail(fmt::format("{:.3g} mm in {:.3g} ms, faster than {} m/s; take more time", 1e3 * far_m,
                         1e3 * took_s, fastest_m_s));
      }
    }
    stroke.push_back({value[0], to, turn_rad, value[7]});
    if (stroke.back().time_s - stroke.front().time_s > longest_s || stroke.size() > most_rows) {
      fail(fmt::format("longer than {} s or {} rows; make it shorter", longest_s, most_rows));
    }
  }
  if (stroke.size() < 2) fail("fewer than two rows; a stroke has a beginning and an end");
  const double from_s = stroke.front().time_s;
  for (StrokePoint& p : stroke) p.time_s -= from_s;
  return stroke;
}

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

/// The planes of a mesh for the poses of a pen, by the proxy. The mesh must outlive it.
class Seeker {
 public:
  /// Errors: std::invalid_argument for a vibration with edges.
  Seeker(const Mesh& mesh, const TouchRequest& request)
      : mesh_(mesh),
        proxy_(mesh, request.proxy),
        actor_(mesh, request.mesh_way),
        host_(request.host),
        materials_(std::max<std::size_t>(1, mesh.materials.size()), request.host) {
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
    const Touched found = proxy_.move(in_mesh);
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
