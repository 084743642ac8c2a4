// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ways of a pen over a mesh, and of a mesh that moves, turns and grows: from files and made here.
// Documentation: docs/touch.md
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/touch/touch.hpp"

namespace feltgate::touch {

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

}  // namespace feltgate::touch
