// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What makes a plane of the proxy more than a face: normals between those of the corners, and the
// second plane of a sharp edge; a hash over planes. Documentation: docs/touch.md
#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

#include "sim/backends/fnv1a.hpp"
#include "sim/touch/touch.hpp"

namespace feltgate::touch {

using plant::cross;
using plant::dot;
using plant::length;

Touched Proxy::shaded(Touched t, Vec3 pen_m, const Near& near) const {
  const Triangle& corners = mesh_.triangles[near.triangle];
  const Vec3 a = mesh_.at[corners[0]], ab = mesh_.at[corners[1]] - a, ac = mesh_.at[corners[2]] - a;
  const Vec3 across = cross(ab, ac), to = near.point_m - a;
  const double whole = dot(across, across);
  const double wb = dot(cross(to, ac), across) / whole, wc = dot(cross(ab, to), across) / whole;
  const auto& n = mesh_.normals[near.triangle];
  Vec3 smooth = (1 - wb - wc) * n[0] + wb * n[1] + wc * n[2];
  // Of two sides the proxy is on one. The nearest way to an edge is not across a face.
  const double side = dot(across, at_ - near.point_m) / (std::sqrt(whole) * near.distance_m);
  if (std::abs(side) < 0.5 || !(length(smooth) > 0)) return t;
  smooth = (side < 0 ? -1 : 1) / length(smooth) * smooth;
  // The same height over it.
  const double above_m = dot(t.normal, pen_m - t.point_m);
  t.normal = smooth;
  t.point_m = pen_m - above_m * smooth;
  return t;
}

SharpEdges::SharpEdges(const Mesh& mesh) : mesh_(mesh) {
  struct Side {
    std::uint32_t low, high;
    std::size_t triangle;
    bool up;  ///< from the lower number to the higher
    bool operator<(const Side& o) const {
      return std::tie(low, high, triangle) < std::tie(o.low, o.high, o.triangle);
    }
    bool same_edge(const Side& o) const { return low == o.low && high == o.high; }
  };
  std::vector<Side> sides;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[n][k], b = mesh.triangles[n][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), n, a < b});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t n = 0; n + 1 < sides.size(); ++n) {
    const Side &s = sides[n], &o = sides[n + 1];
    if (!s.same_edge(o)) continue;
    const bool only = (n == 0 || !sides[n - 1].same_edge(s)) &&
                      (n + 2 == sides.size() || !sides[n + 2].same_edge(s));
    // Of more than two faces, or of two that look to different sides, there is no other plane.
    if (!only || s.up == o.up) continue;
    const Vec3 normal = mesh.normal(mesh.triangles[s.triangle]);
    if (std::abs(dot(normal, mesh.normal(mesh.triangles[o.triangle]))) > edge_lean_most) continue;
    double above_m = 0;  // of the corner beyond the edge
    for (const std::uint32_t v : mesh.triangles[o.triangle])
      if (v != s.low && v != s.high) above_m = dot(normal, mesh.at[v] - mesh.at[s.low]);
    lines_.triangles.push_back({s.low, s.high, s.high});
    faces_.push_back({s.triangle, o.triangle});
    convex_.push_back(above_m < 0);
  }
  if (lines_.triangles.empty()) return;
  lines_.at = mesh.at;
  tree_.emplace(lines_);
}

void SharpEdges::add(Touched& t, Vec3 at, double distance_m) const {
  if (!tree_ || t.constraints > 2) return;
  const Near near = tree_->nearest(at);
  const auto& faces = faces_[near.triangle];
  const Vec3 normals[] = {mesh_.normal(mesh_.triangles[faces[0]]),
                          mesh_.normal(mesh_.triangles[faces[1]])};
  const int which =
      std::abs(dot(normals[0], t.normal)) >= std::abs(dot(normals[1], t.normal)) ? 0 : 1;
  const double side = dot(normals[which], t.normal) < 0 ? -1 : 1;
  const Vec3 first = side * normals[which], second = side * normals[1 - which];
  // A ball in the sharpest groove is three of its radii away from the edge.
  const bool at_the_edge = near.distance_m <= (t.constraints == 2 ? 3 : 1 + 1e-6) * distance_m;
  if (at_the_edge) {
    t.normal = first;
    t.point_m = near.point_m;
  } else {
    constexpr double turned = 0.342, flat = 0.940;  // 20 degrees
    const double off_m = std::abs(dot(t.normal, near.point_m - t.point_m));
    if (dot(first, t.normal) < flat || off_m > turned * near.distance_m + 1e-6) return;
    if (std::abs(dot(t.normal, second)) > edge_lean_most) return;
  }
  t.second = second;
  t.second_point_m = near.point_m;
  t.convex = convex_[near.triangle] == (side > 0);
}

std::uint64_t stroke_hash(const Mesh& mesh) {
  Vec3 low = mesh.at.front(), high = low;
  for (const Vec3& v : mesh.at) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const Vec3 middle = 0.5 * (low + high);
  const double reach_m = 0.5 * length(high - low);
  Proxy proxy(mesh, {});
  Fnv1a hash;
  const auto add = [&hash](Vec3 v) {
    for (const double part : {v.x, v.y, v.z}) {
      std::int64_t bits = 0;
      std::memcpy(&bits, &part, sizeof part);
      hash.add(bits);
    }
  };
  for (const bool smooth : {false, true}) {
    proxy.shade(smooth);
    // Around the middle and tumbling, from outside to 0.4 of the reach and out again.
    Vec3 way{1, 0, 0};
    proxy.begin(middle + 1.2 * reach_m * way);
    constexpr int moves = 2000;
    for (int n = 0; n < moves; ++n) {
      way = {0.999 * way.x - 0.04 * way.y, 0.999 * way.y + 0.04 * way.x + 0.011 * way.z,
             0.999 * way.z - 0.011 * way.y};
      way = 1 / length(way) * way;
      const double share = 2.0 * (n < moves / 2 ? n : moves - n) / moves;
      const Touched plane = proxy.move(middle + (1.2 - 0.8 * share) * reach_m * way);
      add(plane.point_m);
      add(plane.normal);
    }
  }
  return hash.value();
}

}  // namespace feltgate::touch
